// A ruler between two points of the model, which go with their parts as sliders move them.
import { computed, signal } from '@preact/signals';
import type { Vec3 } from '../program/types';
import { pointIn } from './measure';
import { compiled, document, step } from './session';

/** A point of a part, in its hexahedron: −1 … 1. */
export interface RulerPoint {
  readonly part: string;
  readonly at: Vec3;
}

/** Null while nothing is measured; else the points that were set, two at most. */
export const ruler = signal<readonly RulerPoint[] | null>(null);

/** Nearer to an end or the middle of a side than this share of its half length, a point is taken to be there. */
const near = 0.07;
const settled = (value: number) => [-1, 0, 1].find((mark) => Math.abs(value - mark) <= near) ?? value;

/** Sets the next point; a third one begins anew. */
export function setPoint(part: string, at: Vec3): void {
  const points = ruler.peek();
  if (points === null) return;
  const point = { part, at: at.map(settled) as unknown as Vec3 };
  ruler.value = points.length >= 2 ? [point] : [...points, point];
}

export function toggleRuler(): void {
  ruler.value = ruler.peek() === null && document.peek().model !== null ? [] : null;
}

export interface Measured {
  /** In the normalised frame. */
  readonly points: readonly Vec3[];
  /** In metres, and along x, y and z; null with one point. */
  readonly length: { readonly whole: number; readonly along: readonly [number, number, number] } | null;
}

/** Where the points are now; null while nothing is measured, or a part of it is gone. */
export const measured = computed((): Measured | null => {
  step.value; // reads the evaluator below, which is no signal
  const state = compiled.value;
  const set = ruler.value;
  const shape = document.value.model?.shape;
  if (set === null || shape === undefined || state.kind !== 'ready') return null;
  const points = set.map(({ part, at }) => {
    const index = shape.parts.findIndex(({ id }) => id === part);
    return index < 0 ? null : pointIn(state.evaluator.corners, index, at);
  });
  const [from, to] = points;
  if (points.some((point) => point === null)) return { points: [], length: null };
  if (!from || !to) return { points: from ? [from] : [], length: null };
  const along = [0, 1, 2].map((i) => Math.abs((to[i] ?? 0) - (from[i] ?? 0)) * shape.frame.scale);
  return {
    points: [from, to],
    length: { whole: Math.hypot(...along), along: along as [number, number, number] },
  };
});
