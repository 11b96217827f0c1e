// A model in one piece: a table of five boxes in one mesh, which nobody has named.
import { boxFaces, toGlb } from './fixture';

type Vec = readonly [number, number, number];

/** @param boxes centre and full size of each, in metres */
export function oneMesh(boxes: readonly (readonly [Vec, Vec])[]): Buffer {
  const positions: number[] = [];
  const indices: number[] = [];
  for (const [centre, size] of boxes) {
    const first = positions.length / 3;
    for (let k = 0; k < 8; k++) {
      for (let i = 0; i < 3; i++) positions.push((centre[i] ?? 0) + ((k >> i) & 1 ? 0.5 : -0.5) * (size[i] ?? 0));
    }
    for (const [a, b, c, d] of boxFaces) indices.push(...[a, b, c, a, c, d].map((k) => first + k));
  }
  const bound = (pick: (...values: number[]) => number) =>
    [0, 1, 2].map((i) => pick(...positions.filter((_, k) => k % 3 === i).map(Math.fround)));
  const points = Buffer.from(Float32Array.from(positions).buffer);
  const corners = Buffer.from(Uint32Array.from(indices).buffer);
  const json = {
    asset: { version: '2.0' },
    scene: 0,
    scenes: [{ nodes: [0] }],
    nodes: [{ mesh: 0 }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    accessors: [
      {
        bufferView: 0,
        componentType: 5126,
        type: 'VEC3',
        count: positions.length / 3,
        min: bound(Math.min),
        max: bound(Math.max),
      },
      { bufferView: 1, componentType: 5125, type: 'SCALAR', count: indices.length },
    ],
    bufferViews: [
      { buffer: 0, byteOffset: 0, byteLength: points.length },
      { buffer: 0, byteOffset: points.length, byteLength: corners.length },
    ],
    buffers: [{ byteLength: points.length + corners.length }],
  };
  return toGlb({ json, binary: Buffer.concat([points, corners]) });
}

const leg = (x: number, z: number): readonly [Vec, Vec] => [
  [x, 0.35, z],
  [0.05, 0.7, 0.05],
];

/** A table with a knob of 8 mm on its top. */
export const tableInOnePiece = oneMesh([
  [
    [0, 0.72, 0],
    [1.2, 0.04, 0.8],
  ],
  leg(-0.55, -0.35),
  leg(0.55, -0.35),
  leg(-0.55, 0.35),
  leg(0.55, 0.35),
  [
    [0, 0.744, 0],
    [0.008, 0.008, 0.008],
  ],
]);
