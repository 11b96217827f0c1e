// A model in one piece: a table of five boxes in one mesh, which nobody has named.
import { meshGlb } from '../../web/tools/glb.mjs';
import { boxFaces } from './fixture';

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
  return meshGlb(Float32Array.from(positions), indices);
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
