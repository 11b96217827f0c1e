// Small files of the formats that become a GLB, and what of them comes out, for their tests.
import { strToU8, zipSync } from 'fflate';
import { expect } from 'vitest';
import { convert } from '../../web/src/formats/convert';
import { type Format, FormatError } from '../../web/src/formats/model';
import type { Shape } from '../../web/src/program/types';
import { fileLimits, gltfJson } from '../../web/src/session/files';
import { call, loadModule } from './module';

export type Files = Record<string, string | Uint8Array>;
export type Vec = readonly [number, number, number];

export const bytesOf = (content: string | Uint8Array) => (typeof content === 'string' ? strToU8(content) : content);

/** The first file, with the others beside it. */
export async function opened(files: Files, limit: number = fileLimits.bytes) {
  const [[path = '', main = ''] = [], ...others] = Object.entries(files);
  const external = new Map(others.map(([name, content]) => [name, bytesOf(content)]));
  const format = path.slice(path.lastIndexOf('.') + 1).toLowerCase() as Format;
  const { glb, remarks } = await convert({ path, main: bytesOf(main), external }, format, limit);
  return { glb, remarks, gltf: gltfJson(glb) as unknown as Gltf };
}

export interface Gltf {
  nodes: {
    name?: string;
    mesh?: number;
    children?: number[];
    scale?: number[];
    rotation?: number[];
    matrix?: number[];
  }[];
  meshes: { primitives: { attributes: Record<string, number>; material: number; indices?: number }[] }[];
  materials: { name?: string; pbrMetallicRoughness: Record<string, unknown>; alphaMode?: string }[];
  accessors: { count: number; min?: number[]; max?: number[] }[];
  images?: { mimeType: string; bufferView: number }[];
  bufferViews: { byteOffset?: number; byteLength: number }[];
}

const core = await loadModule();
export const shapeOf = (glb: Uint8Array): Shape =>
  call<{ shape: Shape }>(core, 'open', { name: 'model', external: [] }, [new Uint8Array(glb)]).result.shape;
/** Names of the nodes that have a mesh, of each of which the core makes a part. */
export async function namesIn(files: Files): Promise<(string | undefined)[]> {
  const { glb, gltf } = await opened(files);
  const parts = gltf.nodes.filter(({ mesh }) => mesh !== undefined);
  expect(shapeOf(glb).parts.filter(({ node }) => node >= 0).length).toBe(parts.length);
  return parts.map(({ name }) => name);
}
/** The reason why it is refused. */
export const refusal = (files: Files, limit?: number) =>
  opened(files, limit).then(
    () => 'opened',
    (error) => (error instanceof FormatError ? error.message : `no FormatError: ${error}`),
  );

// A box as corners and quadrilaterals, in every format below.
export const quads = [
  [0, 3, 2, 1],
  [4, 5, 6, 7],
  [0, 1, 5, 4],
  [2, 3, 7, 6],
  [1, 2, 6, 5],
  [0, 4, 7, 3],
] as const;
export const cornersOf = ([x, y, z]: Vec, [w, h, d]: Vec): Vec[] =>
  [
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 0, 1],
    [1, 1, 1],
    [0, 1, 1],
  ].map(([a = 0, b = 0, c = 0]) => [x + a * w, y + b * h, z + c * d]);
export const triangles = quads.flatMap(([a, b, c, d]) => [[a, b, c] as const, [a, c, d] as const]);

export const objBox = (first: number, at: Vec, size: Vec) =>
  [
    ...cornersOf(at, size).map((corner) => `v ${corner.join(' ')}`),
    ...quads.map((quad) => `f ${quad.map((corner) => first + corner).join(' ')}`),
  ].join('\n');
export const facet = (corners: readonly Vec[]) =>
  `facet normal 0 0 0\n outer loop\n${corners.map((corner) => `  vertex ${corner.join(' ')}`).join('\n')}\n endloop\nendfacet`;
export const solid = (name: string, at: Vec, size: Vec) => {
  const corners = cornersOf(at, size);
  const facets = triangles.map((triangle) => facet(triangle.map((corner) => corners[corner] as Vec)));
  return `solid ${name}\n${facets.join('\n')}\nendsolid ${name}\n`;
};
export function binaryStl(at: Vec, size: Vec, header = 'made by a test'): Buffer {
  const corners = cornersOf(at, size);
  const file = Buffer.alloc(84 + 50 * triangles.length);
  file.write(header, 0, 'latin1');
  file.writeUInt32LE(triangles.length, 80);
  for (const [i, triangle] of triangles.entries())
    for (const [k, corner] of triangle.entries())
      for (const [axis, value] of (corners[corner] as Vec).entries())
        file.writeFloatLE(value, 84 + 50 * i + 12 + 12 * k + 4 * axis);
  return file;
}
export const ply = (faces: readonly (readonly number[])[] = quads) => {
  const corners = cornersOf([0, 0, 0], [1, 2, 3]);
  return [
    'ply\nformat ascii 1.0\ncomment of a test',
    `element vertex ${corners.length}\nproperty float x\nproperty float y\nproperty float z`,
    'property uchar red\nproperty uchar green\nproperty uchar blue',
    `element face ${faces.length}\nproperty list uchar int vertex_indices\nend_header`,
    ...corners.map((corner) => `${corner.join(' ')} 255 128 0`),
    ...faces.map((face) => `${face.length} ${face.join(' ')}\n`),
  ].join('\n');
};
export const meshXml = (size: Vec, paint = (_: number) => '') =>
  `<mesh><vertices>${cornersOf([0, 0, 0], size)
    .map(([x, y, z]) => `<vertex x="${x}" y="${y}" z="${z}"/>`)
    .join('')}</vertices><triangles>${triangles
    .map(([a, b, c], i) => `<triangle v1="${a}" v2="${b}" v3="${c}"${paint(i)}/>`)
    .join('')}</triangles></mesh>`;
export const threeMf = (resources: string, items: string, attributes = 'unit="millimeter"', others: Files = {}) =>
  zipSync({
    '_rels/.rels': strToU8(
      '<?xml version="1.0"?><Relationships><Relationship Target="/3D/3dmodel.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>',
    ),
    '3D/3dmodel.model': strToU8(
      `<?xml version="1.0"?><!-- a test --><model ${attributes} xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources>${resources}</resources><build>${items}</build></model>`,
    ),
    ...Object.fromEntries(Object.entries(others).map(([name, content]) => [name, bytesOf(content)])),
  });

/** One of each, two boxes where the format has parts. */
export const samples: Record<Format, Files> = {
  obj: {
    'table.obj': `mtllib table.mtl\no top\nusemtl oak\n${objBox(1, [0, 0.7, 0], [1, 0.1, 1])}\no leg\n${objBox(9, [0, 0, 0], [0.1, 0.7, 0.1])}`,
    'table.mtl': 'newmtl oak\nKd 0.5 0.25 0.1\nNs 250\n',
  },
  stl: { 'table.stl': solid('top', [0, 0, 700], [1000, 1000, 100]) + solid('leg', [0, 0, 0], [100, 100, 700]) },
  ply: { 'box.ply': ply() },
  '3mf': {
    'table.3mf': threeMf(
      `<object id="1" name="top">${meshXml([1000, 1000, 100])}</object><object id="2" name="leg">${meshXml([100, 100, 700])}</object>`,
      '<item objectid="1" transform="1 0 0 0 1 0 0 0 1 0 0 700"/><item objectid="2"/>',
    ),
  },
};
export const kinds = Object.keys(samples) as Format[];

/** The box of a shape's corners in metres, y up: least and largest of each axis. */
export function boundsOf(shape: Shape): { min: number[]; max: number[] } {
  const corners = shape.parts.flatMap((part) => part.corners.map((corner) => corner));
  const { centre, scale } = shape.frame;
  const axis = (k: number, pick: (...values: number[]) => number) =>
    Math.round(1e4 * (pick(...corners.map((corner) => corner[k] as number)) * scale + (centre[k] as number))) / 1e4;
  return { min: [0, 1, 2].map((k) => axis(k, Math.min)), max: [0, 1, 2].map((k) => axis(k, Math.max)) };
}
