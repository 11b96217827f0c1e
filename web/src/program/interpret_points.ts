// Points and cages of the readable evaluator (interpret.ts): vectors, a cage's corners and axes, trilinear coordinates.
import type { Axis, Corners, LocalTriple, Vec3 } from './types';

export function item<T>(list: readonly T[], index: number | undefined): T {
  const found = list[index ?? -1];
  if (found === undefined) throw new Error('the program was checked for another shape');
  return found;
}
function map3(f: (i: 0 | 1 | 2) => number): Vec3 {
  return [f(0), f(1), f(2)];
}
export const zero: Vec3 = [0, 0, 0];
export const add = (a: Vec3, b: Vec3) => map3((i) => a[i] + b[i]);
export const subtract = (a: Vec3, b: Vec3) => map3((i) => a[i] - b[i]);
export const times = (s: number, a: Vec3) => map3((i) => s * a[i]);
export const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const length = (a: Vec3) => Math.hypot(...a);
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const sum = (list: readonly Vec3[]) => list.reduce(add, zero);
export const mean = (list: readonly Vec3[]) => times(1 / list.length, sum(list));
export const translated = (corners: Corners, by: Vec3): Corners => corners.map((corner) => add(corner, by));

export type Motion = (point: Vec3) => Vec3;

/** v turned about a unit axis; Rodrigues. */
export function turn(v: Vec3, axis: Vec3, angle: number): Vec3 {
  return sum([
    times(Math.cos(angle), v),
    times(Math.sin(angle), cross(axis, v)),
    times((1 - Math.cos(angle)) * dot(axis, v), axis),
  ]);
}

export function cornerSign(k: number, axis: number): -1 | 1 {
  return (k >> axis) & 1 ? 1 : -1;
}
export function selects(feature: LocalTriple, k: number): boolean {
  return feature.every((wanted, i) => wanted === 0 || wanted === cornerSign(k, i));
}

/** From the - face centre to the + face centre, unit; null when they coincide. */
export function partAxis(corners: Corners, axis: Axis): Vec3 | null {
  const face = (sign: number) => mean(corners.filter((_, k) => cornerSign(k, axis) === sign));
  const between = subtract(face(1), face(-1));
  return length(between) < 1e-12 ? null : times(1 / length(between), between);
}

// ------------------------------------------------------------------------------------------- trilinear coordinates

/** What the trilinear map of a cage does to a point when its corners move from `before` to `after`. */
export function displacementIn(before: Corners, after: Corners, point: Vec3): Vec3 {
  const u = localCoordinates(before, point);
  return sum(after.map((corner, k) => times(weight(u, k), subtract(corner, item(before, k)))));
}

function weight(u: Vec3, k: number): number {
  return ((1 + cornerSign(k, 0) * u[0]) * (1 + cornerSign(k, 1) * u[1]) * (1 + cornerSign(k, 2) * u[2])) / 8;
}

/** Newton's method from the affine guess; without convergence the guess, and where that is singular the centre. */
function localCoordinates(cage: Corners, point: Vec3): Vec3 {
  const guess = newtonStep(cage, point, zero);
  if (!guess) return zero;
  let u = guess;
  for (let i = 0; i < 32; ++i) {
    const step = newtonStep(cage, point, u);
    if (!step) return guess;
    u = add(u, step);
    if (step.every((component) => Math.abs(component) <= 1e-12)) return u;
  }
  return guess;
}

/** Null when the map's Jacobian is singular at u. */
function newtonStep(cage: Corners, point: Vec3, u: Vec3): Vec3 | null {
  const image = sum(cage.map((corner, k) => times(weight(u, k), corner)));
  // The map is linear in each coordinate, so a difference over the whole cage is the exact derivative.
  const column = (axis: Axis) => {
    const at = (value: number) => map3((i) => (i === axis ? value : u[i]));
    return sum(cage.map((corner, k) => times((weight(at(1), k) - weight(at(-1), k)) / 2, corner)));
  };
  const [a, b, c] = [column(0), column(1), column(2)];
  const residual = subtract(point, image);
  const determinant = dot(a, cross(b, c));
  if (!(Math.abs(determinant) > 1e-18)) return null;
  return times(1 / determinant, [dot(residual, cross(b, c)), dot(a, cross(residual, c)), dot(a, cross(b, residual))]);
}
