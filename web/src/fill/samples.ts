// Poisson-disk samples of the part of a surface that lies in a box: no two of them on one side of it are nearer than a radius.

import type { Triangles } from '../solid/types';
import { PointGrid } from './points';
import { normalsOf } from './surface';
import type { Place } from './types';

export interface Box {
  readonly low: readonly number[];
  readonly high: readonly number[];
}

export interface Sample extends Place {
  readonly at: readonly [number, number, number];
  readonly normal: readonly [number, number, number];
}

/** Of candidates to what may be kept of them: more make gaps between samples rarer. */
const candidates = 4;

/** Numbers in [0, 1), the same at every run (Marsaglia's xorshift). */
export function randomNumbers(seed: number): () => number {
  let state = seed | 1;
  return () => {
    state ^= state << 13;
    state ^= state >>> 17;
    state ^= state << 5;
    return (state >>> 0) / 0x100000000;
  };
}

/**
 * By dart throwing, as candidates come.
 * @param accepts whether a place is wanted at all
 */
export function diskSamples(
  part: number,
  surface: Triangles,
  box: Box,
  radius: number,
  accepts: (x: number, y: number, z: number) => boolean,
): Sample[] {
  const random = randomNumbers(part + 1);
  const normals = normalsOf(surface);
  const kept: Sample[] = [];
  const grid = new PointGrid(radius);
  const drawn: Sample[] = [];
  for (let t = 0; t < surface.triangles.length; t += 3) {
    const normal = [normals[t], normals[t + 1], normals[t + 2]] as [number, number, number];
    if (normal.every((x) => x === 0)) continue;
    for (const [weights, area] of piecesInside(surface, t, box)) {
      const expected = (candidates * area) / (radius * radius);
      const count = Math.floor(expected) + (random() < expected % 1 ? 1 : 0);
      for (let i = 0; i < count; i++) {
        const [r, s] = [Math.sqrt(random()), random()];
        const [a, b, c] = weights;
        const mix = (k: 0 | 1 | 2) => (1 - r) * a[k] + r * (1 - s) * b[k] + r * s * c[k];
        const own: Weights = [mix(0), mix(1), mix(2)];
        const at = placeAt(surface, t, own);
        if (accepts(at[0], at[1], at[2])) drawn.push({ part, triangle: t / 3, weights: own, at, normal });
      }
    }
  }
  for (let i = drawn.length - 1; i > 0; i--) {
    const j = Math.floor(random() * (i + 1));
    [drawn[i], drawn[j]] = [drawn[j] as Sample, drawn[i] as Sample];
  }
  for (const sample of drawn) {
    const [nx, ny, nz] = sample.normal;
    const sameSide = (id: number) => {
      const [x, y, z] = (kept[id] as Sample).normal;
      return x * nx + y * ny + z * nz > 0.5;
    };
    if (grid.nearest(...sample.at, sameSide) >= 0) continue;
    grid.add(...sample.at);
    kept.push(sample);
  }
  return kept;
}

/** Where a place is on a surface that may be another state of the one that it was found on. */
export function placeAt(
  { positions, triangles }: Triangles,
  first: number,
  weights: readonly [number, number, number],
): [number, number, number] {
  const a = 3 * (triangles[first] as number);
  const b = 3 * (triangles[first + 1] as number);
  const c = 3 * (triangles[first + 2] as number);
  const mix = (k: number) =>
    weights[0] * (positions[a + k] as number) +
    weights[1] * (positions[b + k] as number) +
    weights[2] * (positions[c + k] as number);
  return [mix(0), mix(1), mix(2)];
}

type Weights = readonly [number, number, number];
type Corners = readonly [Weights, Weights, Weights];

/** What of a triangle lies in a box, as triangles of weights of its corners, with their areas (Sutherland and Hodgman 1974). */
function piecesInside(surface: Triangles, first: number, { low, high }: Box): [Corners, number][] {
  let polygon: Weights[] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  for (let axis = 0; axis < 3; axis++) {
    for (const [side, bound] of [
      [1, low[axis] as number],
      [-1, high[axis] as number],
    ] as const) {
      const inside = polygon.map((w) => side * ((placeAt(surface, first, w)[axis] as number) - bound));
      const next: Weights[] = [];
      for (let i = 0; i < polygon.length; i++) {
        const j = (i + 1) % polygon.length;
        const [a, b] = [polygon[i] as Weights, polygon[j] as Weights];
        const [da, db] = [inside[i] as number, inside[j] as number];
        if (da >= 0) next.push(a);
        if (da >= 0 !== db >= 0) {
          const s = da / (da - db);
          next.push(a.map((x, k) => x + s * ((b[k] as number) - x)) as unknown as Weights);
        }
      }
      polygon = next;
      if (polygon.length < 3) return [];
    }
  }
  const pieces: [Corners, number][] = [];
  for (let i = 1; i + 1 < polygon.length; i++) {
    const piece = [polygon[0], polygon[i], polygon[i + 1]] as unknown as Corners;
    const [a, b, c] = piece.map((w) => placeAt(surface, first, w)) as unknown as [number[], number[], number[]];
    const u = b.map((x, k) => x - (a[k] as number));
    const v = c.map((x, k) => x - (a[k] as number));
    const [u0 = 0, u1 = 0, u2 = 0, v0 = 0, v1 = 0, v2 = 0] = [...u, ...v];
    pieces.push([piece, Math.hypot(u1 * v2 - u2 * v1, u2 * v0 - u0 * v2, u0 * v1 - u1 * v0) / 2]);
  }
  return pieces;
}
