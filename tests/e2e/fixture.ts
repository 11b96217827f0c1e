// A small model made here, with what real ones have: a mesh shared by nodes, a node that mirrors, a parent that turns, a
// row of equal parts, prisms that are no boxes. And the edits that the tests make of it.
import type { Layer, Program, Shape, Statement } from '../../web/src/program/types';
import { type Gltf, toGlb } from '../../web/tools/glb.mjs';

type Vec = readonly [number, number, number];

interface MeshData {
  positions: number[];
  normals: number[];
  indices: number[];
}

/** An upright prism with a regular base inside the box of the given size, centred; every face has vertices of its own. */
function prism(sides: number, [w, h, d]: Vec): MeshData {
  const mesh: MeshData = { positions: [], normals: [], indices: [] };
  const turn = sides === 4 ? Math.PI / 4 : 0;
  const stretch = sides === 4 ? Math.SQRT2 : 1;
  const rim = Array.from({ length: sides }, (_, i) => {
    const angle = (2 * Math.PI * i) / sides + turn;
    return [(stretch * Math.cos(angle) * w) / 2, (stretch * Math.sin(angle) * d) / 2] as const;
  });
  const face = (points: readonly Vec[], normal: Vec) => {
    const first = mesh.positions.length / 3;
    for (const point of points) {
      mesh.positions.push(...point);
      mesh.normals.push(...normal);
    }
    for (let i = 1; i + 1 < points.length; i++) mesh.indices.push(first, first + i, first + i + 1);
  };
  for (const [i, [x, z]] of rim.entries()) {
    const [nx, nz] = rim[(i + 1) % sides] as readonly [number, number];
    const [mx, mz] = [(z - nz) * -1, x - nx].map((v) => v / Math.hypot(nx - x, nz - z)) as [number, number];
    face(
      [
        [x, -h / 2, z],
        [x, h / 2, z],
        [nx, h / 2, nz],
        [nx, -h / 2, nz],
      ],
      [mx, 0, mz],
    );
  }
  face(rim.map(([x, z]) => [x, h / 2, z] as const).reverse(), [0, 1, 0]);
  face(
    rim.map(([x, z]) => [x, -h / 2, z] as const),
    [0, -1, 0],
  );
  return mesh;
}

interface NodeData {
  name: string;
  mesh?: number;
  translation?: Vec;
  scale?: Vec;
  rotation?: readonly [number, number, number, number];
  children?: number[];
}

const meshes = [prism(4, [0.5, 0.04, 0.4]), prism(12, [0.04, 0.4, 0.04]), prism(4, [0.03, 0.3, 0.012])];
const nodes: NodeData[] = [
  { name: 'seat', mesh: 0, translation: [0, 0.42, 0] },
  { name: 'leg', mesh: 1, translation: [0.2, 0.2, 0.15] },
  { name: 'leg', mesh: 1, translation: [-0.2, 0.2, 0.15], scale: [-1, 1, 1] },
  { name: 'leg', mesh: 1, translation: [0.2, 0.2, -0.15] },
  { name: 'leg', mesh: 1, translation: [-0.2, 0.2, -0.15] },
  {
    name: 'back',
    translation: [0, 0.43, -0.17],
    rotation: [-Math.sin(0.1), 0, 0, Math.cos(0.1)],
    children: [6, 7, 8, 9, 10],
  },
  ...[-0.2, -0.1, 0, 0.1, 0.2].map((x): NodeData => ({ name: 'slat', mesh: 2, translation: [x, 0.15, 0] })),
];

/** @param rename gives nodes other names */
export function stoolGltf(rename: (name: string) => string = (name) => name): Gltf {
  const views: { byteOffset: number; byteLength: number; buffer: 0 }[] = [];
  const accessors: Record<string, unknown>[] = [];
  const chunks: Buffer[] = [];
  let length = 0;
  const add = (data: Buffer, accessor: Record<string, unknown>) => {
    views.push({ buffer: 0, byteOffset: length, byteLength: data.length });
    accessors.push({ bufferView: views.length - 1, ...accessor });
    const padded = Buffer.concat([data, Buffer.alloc((4 - (data.length % 4)) % 4)]);
    chunks.push(padded);
    length += padded.length;
    return accessors.length - 1;
  };
  const bounds = (positions: number[], pick: (...values: number[]) => number) =>
    [0, 1, 2].map((axis) => Math.fround(pick(...positions.filter((_, i) => i % 3 === axis).map(Math.fround))));
  const gltfMeshes = meshes.map(({ positions, normals, indices }, material) => {
    const count = positions.length / 3;
    const vec3 = { componentType: 5126, type: 'VEC3', count };
    const position = add(Buffer.from(Float32Array.from(positions).buffer), {
      ...vec3,
      min: bounds(positions, Math.min),
      max: bounds(positions, Math.max),
    });
    const normal = add(Buffer.from(Float32Array.from(normals).buffer), vec3);
    const index = add(Buffer.from(Uint16Array.from(indices).buffer), {
      componentType: 5123,
      type: 'SCALAR',
      count: indices.length,
    });
    return { primitives: [{ attributes: { POSITION: position, NORMAL: normal }, indices: index, material }] };
  });
  const colours = [
    [0.3, 0.4, 0.3, 1],
    [0.6, 0.35, 0.15, 1],
    [0.6, 0.35, 0.15, 1],
  ];
  return {
    json: {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: [0, 1, 2, 3, 4, 5] }],
      nodes: nodes.map((node) => ({ ...node, name: rename(node.name) })),
      meshes: gltfMeshes,
      materials: colours.map((baseColorFactor) => ({ pbrMetallicRoughness: { baseColorFactor, metallicFactor: 0 } })),
      accessors,
      bufferViews: views,
      buffers: [{ byteLength: length }],
    },
    binary: Buffer.concat(chunks),
  };
}

/** Corners of each face of a box, by the signs of the box's corners (bit 0: x, 1: y, 2: z), counter-clockwise from outside. */
export const boxFaces = [
  [0, 2, 3, 1],
  [4, 5, 7, 6],
  [0, 1, 5, 4],
  [2, 6, 7, 3],
  [0, 4, 6, 2],
  [1, 3, 7, 5],
] as const;

export const stool = toGlb(stoolGltf());

/** Positions and normals of a part's vertices at rest, in the file's frame, and where its triangles are. */
export function verticesOf(node: number): { positions: Vec[]; normals: Vec[] } {
  const { mesh, translation = [0, 0, 0], scale = [1, 1, 1] } = nodes[node] as NodeData;
  const parent = nodes.find(({ children }) => children?.includes(node));
  const angle = parent?.rotation ? 2 * Math.atan2(parent.rotation[0], parent.rotation[3]) : 0;
  const turned = ([x, y, z]: Vec): Vec => [
    x,
    Math.cos(angle) * y - Math.sin(angle) * z,
    Math.sin(angle) * y + Math.cos(angle) * z,
  ];
  const add = (a: Vec, b: Vec): Vec => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
  const scaled = (a: Vec): Vec => [a[0] * scale[0], a[1] * scale[1], a[2] * scale[2]];
  const { positions, normals } = meshes[mesh as number] as MeshData;
  const triples = (list: number[]) =>
    Array.from({ length: list.length / 3 }, (_, i) => list.slice(3 * i, 3 * i + 3) as unknown as Vec);
  return {
    positions: triples(positions).map((p) =>
      add(turned(add(scaled(p), translation)), parent?.translation ?? [0, 0, 0]),
    ),
    normals: triples(normals).map((n) => turned(scaled(n))), // the scales are ±1
  };
}

const layer = (request: string, name: string, min: number, max: number, statements: Statement[]): Layer => ({
  request,
  parameter: { name, min, max, value: 0 },
  statements,
  relations: [],
});

/** Bends, turns, stretches and counts: layers that move every vertex of the stool in another way. */
export function program(shape: Shape): Program {
  const group = shape.relations.find(({ kind }) => kind === 'translation');
  if (group === undefined) throw new Error('the slats were not found to be a row');
  const whole = [0, 0, 0] as const;
  const why = { kind: 'seed', relations: [] } as const;
  const leg = shape.parts.find(({ node }) => node === 2)?.id ?? '';
  return {
    format: 'parsel/program',
    version: 1,
    shape: { name: shape.name, sha256: shape.sha256 },
    layers: [
      layer('widen the seat', 'x1', -0.5, 0.5, [
        {
          op: 'scale_1d',
          part: 'seat',
          feature: whole,
          origin: { part: 'seat', at: whole },
          direction: [1, 0, 0],
          amount: 'x1',
          why,
        },
      ]),
      layer('tilt a leg', 'x2', -0.6, 0.6, [
        {
          op: 'rotate',
          part: leg,
          feature: whole,
          origin: { part: leg, at: [0, 1, 0] },
          axis: [0, 0, 1],
          amount: 'x2',
          why,
        },
        {
          op: 'shear',
          part: leg,
          feature: whole,
          origin: { part: leg, at: [0, 1, 0] },
          normal: [0, 1, 0],
          direction: [0, 0, 1],
          amount: 'x2',
        },
        { op: 'translate', part: 'seat', feature: [1, 1, 0], direction: [0, 1, 0], amount: 'x2^2/2' },
      ]),
      layer('more slats', 'x3', -4, 40, [
        { op: 'change_count', relation: group.id, anchor: 'middle', amount: 'x3', why },
      ]),
    ],
  };
}
