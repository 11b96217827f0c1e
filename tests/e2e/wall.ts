// Models of boxes, and a wall of drawers: as many parts as wanted, each under a name of its own, each touching its neighbours.
import { toGlb } from '../../web/tools/glb.mjs';
import { boxFaces } from './fixture';

const cube = [-1, 1].flatMap((z) => [-1, 1].flatMap((y) => [-1, 1].map((x) => [x, y, z] as const)));
interface Box {
  readonly name: string;
  /** Centre and size, in metres. */
  readonly translation: readonly number[];
  readonly scale: readonly number[];
}

/** Boxes along the axes, each a node of its own; they share a mesh. */
export function boxes(nodes: readonly Box[]): Buffer {
  const corners = Float32Array.from(cube.flatMap(([x, y, z]) => [x / 2, y / 2, z / 2]));
  const indices = Uint16Array.from(boxFaces.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]));
  const binary = Buffer.concat([Buffer.from(corners.buffer), Buffer.from(indices.buffer)]);
  return toGlb({
    json: {
      asset: { version: '2.0' },
      scene: 0,
      scenes: [{ nodes: nodes.map((_, i) => i) }],
      nodes: nodes.map((node) => ({ ...node, mesh: 0 })),
      meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
      accessors: [
        { bufferView: 0, componentType: 5126, type: 'VEC3', count: 8, min: [-0.5, -0.5, -0.5], max: [0.5, 0.5, 0.5] },
        { bufferView: 1, componentType: 5123, type: 'SCALAR', count: indices.length },
      ],
      bufferViews: [
        { buffer: 0, byteOffset: 0, byteLength: corners.byteLength },
        { buffer: 0, byteOffset: corners.byteLength, byteLength: indices.byteLength },
      ],
      buffers: [{ byteLength: binary.length }],
    },
    binary,
  });
}

/** @param columns,rows of drawers, of 20 × 10 × 30 cm each; they are called "drawer 1a", "drawer 2a", … */
export function wall(columns: number, rows: number): Buffer {
  return boxes(
    Array.from({ length: columns * rows }, (_, i) => ({
      name: `drawer ${i + 1}a`,
      translation: [((i % columns) - (columns - 1) / 2) * 0.2, (Math.floor(i / columns) + 0.5) * 0.1, 0],
      scale: [0.2, 0.1, 0.3],
    })),
  );
}
