// A GLB whose meshes are the hexahedra of a shape: a model that is known to the last corner.
import type { CageShape, Vec3 } from '../../web/src/program/types';
import { toGlb } from '../../web/tools/glb.mjs';
import { boxFaces } from '../e2e/fixture';

/** The two triangles of each face, by corners. */
const faces = boxFaces.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]);

/** Every second node is moved and scaled, with its mesh taken back by as much; all hang below one more node. */
const place = (node: number) =>
  node % 2 === 0 ? { translation: [0, 0, 0], scale: 1 } : { translation: [1, -2, 3], scale: 4 };

/** @param extra what else is to be in the JSON's root */
export function glbOf(shape: CageShape, extra: Record<string, unknown> = {}): Uint8Array {
  const { centre, scale } = shape.frame;
  const real = shape.parts.filter(({ virtual }) => !virtual);
  const nodeCount = 1 + Math.max(...real.map(({ node }) => node));
  const accessors: Record<string, unknown>[] = [];
  const views: Record<string, unknown>[] = [];
  const chunks: Buffer[] = [];
  let length = 0;
  const add = (data: Buffer, accessor: Record<string, unknown>) => {
    views.push({ buffer: 0, byteOffset: length, byteLength: data.length });
    accessors.push({ bufferView: views.length - 1, ...accessor });
    chunks.push(data);
    length += data.length;
    return accessors.length - 1;
  };
  const indices = add(Buffer.from(Uint32Array.from(faces).buffer), {
    componentType: 5125,
    type: 'SCALAR',
    count: faces.length,
  });
  const primitiveOf = (corners: readonly Vec3[], node: number) => {
    const { translation, scale: own } = place(node);
    const points = corners.map((corner) =>
      corner.map((x, i) => Math.fround(((centre[i] ?? 0) + scale * x - (translation[i] ?? 0)) / own)),
    );
    const bound = (pick: (...values: number[]) => number) =>
      [0, 1, 2].map((i) => pick(...points.map((p) => p[i] ?? 0)));
    const position = add(Buffer.from(Float32Array.from(points.flat()).buffer), {
      componentType: 5126,
      type: 'VEC3',
      count: 8,
      min: bound(Math.min),
      max: bound(Math.max),
    });
    return { attributes: { POSITION: position }, indices, material: 0 };
  };
  const meshes: { primitives: unknown[] }[] = [];
  const nodes: Record<string, unknown>[] = Array.from({ length: nodeCount }, (_, node) => {
    const parts = real.filter((part) => part.node === node).sort((a, b) => a.primitive - b.primitive);
    if (parts.length === 0) return { name: `empty ${node}` };
    meshes.push({ primitives: parts.map(({ corners }) => primitiveOf(corners, node)) });
    const { translation, scale: own } = place(node);
    return { name: `node ${node}`, mesh: meshes.length - 1, translation, scale: [own, own, own] };
  });
  nodes.push({ name: 'all', children: Array.from({ length: nodeCount }, (_, i) => i) });
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [nodeCount] }],
    nodes,
    meshes,
    materials: [{ name: 'wood', pbrMetallicRoughness: { metallicFactor: 0 } }],
    accessors,
    bufferViews: views,
    buffers: [{ byteLength: length }],
    ...extra,
  };
  return new Uint8Array(toGlb({ json, binary: Buffer.concat(chunks) }));
}
