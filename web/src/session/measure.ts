// Lengths for people: the size of the whole and of parts, and what a layer's slider changes, in the model's metres.

import type { Evaluator } from '../program/compile';
import { type Axis, isGeometric, isGroup, type Shape, type Statement, type Vec3 } from '../program/types';
import { number } from '../texts/texts';
import type { LengthUnit } from './document';

/** Width (x), height (y) and depth (z) in metres. */
export type Size = readonly [number, number, number];

/** Of a part's hexahedron, or (null) of the whole shape with all instances. */
export function sizeOf(shape: Shape, { corners, groups }: Evaluator, part: number | null): Size {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  const include = (from: ArrayLike<number>, start: number, end: number) => {
    for (let i = start; i < end; i++) {
      const axis = (i - start) % 3;
      low[axis] = Math.min(low[axis] as number, from[i] as number);
      high[axis] = Math.max(high[axis] as number, from[i] as number);
    }
  };
  if (part !== null) include(corners, part * 24, part * 24 + 24);
  else {
    for (const [i, { virtual }] of shape.parts.entries()) if (!virtual) include(corners, i * 24, i * 24 + 24);
    for (const group of groups) if (group) include(group.instances, 0, group.count * 24);
  }
  const { scale } = shape.frame;
  return [0, 1, 2].map((i) => ((high[i] as number) - (low[i] as number)) * scale) as unknown as Size;
}

/** A point of a hexahedron, by its local coordinates −1 … 1, among flat corners (part × 24). */
export function pointIn(corners: ArrayLike<number>, part: number, [u, v, w]: Vec3): Vec3 {
  const point: [number, number, number] = [0, 0, 0];
  for (let k = 0; k < 8; k++) {
    const weight = ((1 + (k & 1 ? u : -u)) * (1 + (k & 2 ? v : -v)) * (1 + (k & 4 ? w : -w))) / 8;
    for (let i = 0; i < 3; i++) point[i] = (point[i] ?? 0) + weight * (corners[part * 24 + 3 * k + i] ?? 0);
  }
  return point;
}

/** Lengths between the middles of opposite faces: what a tape measure along the part reads, however it is turned. */
function edgesOf(shape: Shape, corners: ArrayLike<number>, part: number): Size {
  return [0, 1, 2].map((axis) => {
    const d = [0, 0, 0];
    for (let k = 0; k < 8; k++) {
      for (let i = 0; i < 3; i++) {
        d[i] = (d[i] as number) + ((k & (1 << axis) ? 1 : -1) * (corners[part * 24 + k * 3 + i] as number)) / 4;
      }
    }
    return Math.hypot(...d) * shape.frame.scale;
  }) as unknown as Size;
}

/** What a slider changes, read off the state: "width of seat", 0.46 m. */
export interface Measure {
  /** What is measured: the id of a part, or null for the whole. */
  readonly part: string | null;
  readonly what: 'width' | 'height' | 'depth' | 'angle' | 'distance' | 'count' | 'spacing';
  /**
   * In metres, radians or pieces. Turns and moves are those from the part's corners (24 numbers) at 0 of the slider, so
   * that what other edits do to it does not count.
   */
  readonly read: (evaluator: Evaluator, zero: ArrayLike<number>) => number;
}

/**
 * Reads a measure at values `at` of one slider, number `index`, while the others stand at `values`; then puts everything
 * back. Turns and moves have the slider's sign.
 */
export function readAt(
  shape: Shape,
  { part: id, what, read }: Measure,
  evaluator: Evaluator,
  values: readonly number[],
  index: number,
  at: readonly number[],
): number[] {
  let standing = Number.NaN;
  const move = (value: number) => {
    if (value !== standing) evaluator.evaluate(values.map((other, i) => (i === index ? value : other)));
    standing = value;
  };
  move(0);
  const part = shape.parts.findIndex((one) => one.id === id);
  const zero = evaluator.corners.slice(part * 24, part * 24 + 24);
  const isSigned = what === 'angle' || what === 'distance';
  const readings = at.map((value) => {
    move(value);
    return read(evaluator, zero) * (isSigned ? Math.sign(value) : 1);
  });
  move(values[index] ?? 0);
  return readings;
}

const sizeWords = ['width', 'height', 'depth'] as const;

/**
 * The quantity that tells best what the layer's first statement does. Lengths follow the part's own edges, named after
 * the global axis that each is most along.
 */
export function measureOf(shape: Shape, seed: Statement | undefined): Measure | null {
  if (seed === undefined) return null;
  if (seed.op === 'change_count' || seed.op === 'change_delta') {
    const index = shape.relations.findIndex(({ id }) => id === seed.relation);
    const relation = shape.relations[index];
    if (relation === undefined || !isGroup(relation)) return null;
    const count = (evaluator: Evaluator) => evaluator.groups[index]?.count ?? 0;
    if (seed.op === 'change_count') return { part: relation.parent, what: 'count', read: count };
    return { part: relation.parent, what: 'spacing', read: (evaluator) => spacing(shape, evaluator, index) };
  }
  if (!isGeometric(seed)) return null;
  const part = partIndexOf(shape, seed.part);
  const rest = shape.parts[part];
  if (rest === undefined) return null;
  const id = rest.id;
  if (seed.op === 'rotate') {
    return { part: id, what: 'angle', read: ({ corners }, zero) => turn(zero, corners, part * 24) };
  }
  const moving = seed.op === 'translate' || seed.op === 'shear';
  const whole = seed.feature.every((sign) => sign === 0);
  if (moving && (whole || seed.op === 'shear')) {
    return {
      part: id,
      what: 'distance',
      read: ({ corners }, zero) => largestMove(zero, corners, part * 24) * shape.frame.scale,
    };
  }
  const axis = moving ? faceAxis(seed.feature) : changedAxis(shape, seed, part);
  return {
    part: id,
    what: sizeWords[mostAlong(rest.axes[axis])] ?? 'width',
    read: ({ corners }) => edgesOf(shape, corners, part)[axis],
  };
}

function partIndexOf(shape: Shape, id: string): number {
  const index = shape.parts.findIndex((part) => part.id === id);
  return index >= 0 ? index : shape.parts.findIndex((part) => `node:${part.node}` === id);
}

const faceAxis = (feature: readonly number[]): Axis =>
  Math.max(
    0,
    feature.findIndex((sign) => sign !== 0),
  ) as Axis;

/** The local axis that a scale stretches most. */
function changedAxis(shape: Shape, seed: Statement, part: number): Axis {
  const axes = shape.parts[part]?.axes;
  if (axes === undefined || seed.op === 'scale_3d') return 0;
  const reference = seed.op === 'scale_1d' ? seed.direction : seed.op === 'scale_2d' ? seed.normal : null;
  const direction = reference !== null && 'part' in reference ? axes[reference.axis] : (reference ?? [1, 0, 0]);
  const along = axes.map((axis) => Math.abs(axis[0] * direction[0] + axis[1] * direction[1] + axis[2] * direction[2]));
  const best = along.indexOf(Math.max(...along));
  // What grows in two directions is said to become wider, or, across its width, higher.
  return (seed.op === 'scale_2d' ? (best === 0 ? 1 : 0) : best) as Axis;
}

/** Along + of each axis: to its left, up, forwards. */
export const axes: readonly [Vec3, Vec3, Vec3] = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

export function mostAlong(axis: readonly number[]): Axis {
  const sizes = axis.map(Math.abs);
  return sizes.indexOf(Math.max(...sizes)) as Axis;
}

/** The angle between the part's edges now and then, the largest of the three; unsigned. */
function turn(rest: ArrayLike<number>, corners: Float64Array, at: number): number {
  let largest = 0;
  for (const bit of [1, 2, 4]) {
    let [dot, a2, b2] = [0, 0, 0];
    for (let i = 0; i < 3; i++) {
      const a = (rest[bit * 3 + i] as number) - (rest[i] as number);
      const b = (corners[at + bit * 3 + i] as number) - (corners[at + i] as number);
      dot += a * b;
      a2 += a * a;
      b2 += b * b;
    }
    largest = Math.max(largest, Math.acos(Math.min(1, Math.max(-1, dot / Math.sqrt(a2 * b2)))));
  }
  return largest;
}

function largestMove(rest: ArrayLike<number>, corners: Float64Array, at: number): number {
  let largest = 0;
  for (let i = 0; i < 24; i += 3) {
    const move = [0, 1, 2].map((j) => (corners[at + i + j] as number) - (rest[i + j] as number));
    largest = Math.max(largest, Math.hypot(...move));
  }
  return largest;
}

/** Distance of the centres of the first two instances. */
function spacing(shape: Shape, evaluator: Evaluator, relation: number): number {
  const group = evaluator.groups[relation];
  if (!group || group.count < 2) return 0;
  const d = [0, 0, 0];
  for (let i = 0; i < 24; i++) {
    const difference = (group.instances[24 + i] as number) - (group.instances[i] as number);
    d[i % 3] = (d[i % 3] as number) + difference / 8;
  }
  return Math.hypot(...d) * shape.frame.scale;
}

const trimmed = (value: number, digits: number) =>
  number(value, 0, digits, false).replace(/^-0$/, '0').replace(/^-/, '−');

const lengthFactors: Readonly<Record<LengthUnit, { factor: number; digits: number }>> = {
  m: { factor: 1, digits: 3 },
  cm: { factor: 100, digits: 1 },
  mm: { factor: 1000, digits: 1 },
  in: { factor: 1 / 0.0254, digits: 2 },
};

/** The unit in which lengths about as large as `metres` are shown unless one was chosen, and how many digits. */
function lengthUnit(metres: number, chosen?: LengthUnit): { unit: LengthUnit; factor: number; digits: number } {
  if (chosen !== undefined) return { unit: chosen, ...lengthFactors[chosen] };
  const size = Math.abs(metres);
  if (size >= 3) return { unit: 'm', factor: 1, digits: 2 };
  if (size >= 0.02 || size === 0) return { unit: 'cm', factor: 100, digits: 1 };
  return { unit: 'mm', factor: 1000, digits: size < 1e-3 ? 3 : 1 };
}

/** What decides the unit of two values that are shown beside each other. */
export const larger = (a: number, b: number): number => Math.max(Math.abs(a), Math.abs(b));

/** Lengths in metres, all in one unit, without it, and the unit. */
export function formatLengths(
  size: readonly number[],
  chosen?: LengthUnit,
): { readonly lengths: readonly string[]; unit: LengthUnit } {
  const { unit, factor, digits } = lengthUnit(Math.max(...size), chosen);
  const shown = chosen === undefined ? Math.min(digits, 1) || digits : digits;
  return { lengths: size.map((metres) => trimmed(metres * factor, shown)), unit };
}

/** A value of a measure with its unit: the chosen one, else one that suits `like`, so that before and after read alike. */
export function formatMeasure(what: Measure['what'], value: number, like = value, chosen?: LengthUnit): string {
  if (what === 'angle') return `${trimmed((value * 180) / Math.PI, 1)}°`;
  if (what === 'count') return number(value);
  const { unit, factor, digits } = lengthUnit(like, chosen);
  return `${trimmed(value * factor, digits)} ${unit}`;
}

/** What someone typed for a measure: "54", "54 cm", "0.54m", "21 in", "12°". Null when it is no number. */
export function parseMeasure(what: Measure['what'], text: string, like: number, chosen?: LengthUnit): number | null {
  const match = /^\s*([-+]?[\d.,]+)\s*(m|cm|mm|in|"|″|°|deg)?\s*$/.exec(text.replace('−', '-'));
  const number = Number((match?.[1] ?? '').replace(',', '.'));
  if (match === null || !Number.isFinite(number)) return null;
  if (what === 'angle') return (number * Math.PI) / 180;
  if (what === 'count') return number;
  const said = match[2] === '"' || match[2] === '″' ? 'in' : match[2];
  const factor = lengthFactors[said as LengthUnit]?.factor ?? lengthUnit(like, chosen).factor;
  return number / factor;
}
