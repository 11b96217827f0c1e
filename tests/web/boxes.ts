// Boxes as triangles.
import type { Triangles } from '../../web/src/solid/types';
import { boxFaces } from '../e2e/fixture';

/** x, y, z */
export type Vec = readonly [number, number, number];

/** Every face with corners of its own, as in files with flat normals. */
export function boxOf(low: Vec, high: Vec): Triangles {
  const positions: number[] = [];
  const triangles: number[] = [];
  for (const face of boxFaces) {
    const first = positions.length / 3;
    for (const corner of face) positions.push(...[0, 1, 2].map((k) => (corner & (1 << k) ? high : low)[k] as number));
    triangles.push(first, first + 1, first + 2, first, first + 2, first + 3);
  }
  return { positions: Float64Array.from(positions), triangles: Uint32Array.from(triangles) };
}
