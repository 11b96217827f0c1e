// Points in the local coordinates (u, v, w) of a hexahedron, and back: by these a mesh follows its hexahedron.

import { cross, dot, type Vec } from './vectors';

/** Of the trilinear map at a point: where it is, and its derivatives along u, v and w. */
interface Mapped {
  readonly point: Vec;
  readonly along: readonly [Vec, Vec, Vec];
}

/** @param corners 24 numbers from `start`; bits 0, 1, 2 of a corner's number say on which side of u, v, w it is */
export function mapped(corners: ArrayLike<number>, start: number, local: ArrayLike<number>): Mapped {
  const point: Vec = [0, 0, 0];
  const along: [Vec, Vec, Vec] = [
    [0, 0, 0],
    [0, 0, 0],
    [0, 0, 0],
  ];
  for (let k = 0; k < 8; k++) {
    const side = (axis: number) => (k & (1 << axis) ? 1 : -1);
    const share = (axis: number) => (1 + side(axis) * (local[axis] as number)) / 2;
    const [u, v, w] = [share(0), share(1), share(2)];
    for (let i = 0; i < 3; i++) {
      const at = corners[start + 3 * k + i] as number;
      point[i] = (point[i] as number) + u * v * w * at;
      along[0][i] = (along[0][i] as number) + (side(0) / 2) * v * w * at;
      along[1][i] = (along[1][i] as number) + (side(1) / 2) * u * w * at;
      along[2][i] = (along[2][i] as number) + (side(2) / 2) * u * v * at;
    }
  }
  return { point, along };
}

const mostSteps = 12;

/** Local coordinates of a point, by Newton's method: one step where the hexahedron is a parallelepiped. */
export function localOf(corners: ArrayLike<number>, start: number, point: ArrayLike<number>): Vec {
  const local: Vec = [0, 0, 0];
  for (let step = 0; step < mostSteps; step++) {
    const { point: at, along } = mapped(corners, start, local);
    const [a, b, c] = along;
    const r = at.map((x, i) => (point[i] as number) - x) as Vec;
    const [bc, ca, ab] = [cross(b, c), cross(c, a), cross(a, b)];
    const volume = dot(a, bc);
    if (volume === 0) break; // flat: as near as it gets
    const d = [dot(r, bc) / volume, dot(r, ca) / volume, dot(r, ab) / volume];
    for (let i = 0; i < 3; i++) local[i] = (local[i] as number) + (d[i] as number);
    if (Math.max(...d.map(Math.abs)) < 1e-9) break;
  }
  return local;
}

/** What the renderer turns back into a normal at that place: the normal times the derivatives. A unit vector, or zero. */
export function localNormal(
  corners: ArrayLike<number>,
  start: number,
  local: ArrayLike<number>,
  normal: ArrayLike<number>,
): Vec {
  const own = mapped(corners, start, local).along.map((axis) => dot(axis, normal)) as Vec;
  const length = Math.hypot(...own);
  return length > 0 ? (own.map((x) => x / length) as Vec) : own;
}
