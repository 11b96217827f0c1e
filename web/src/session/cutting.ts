// The plane that parts are about to be cut by: along which direction it stands, and where.

import { computed, signal } from '@preact/signals';
import type { Plane } from '../carve/steps';
import type { Shape, Vec3 } from '../program/types';
import { m, type Sentence } from '../texts/texts';
import { keysOf, planeInFile } from './carving';
import { selected } from './session';
import { realParts } from './several';

/** A direction that a cut can stand across, in the normalised frame, of length 1. */
export interface CutDirection {
  readonly id: string;
  /** Said with `t`, of the part's own axis `own`. */
  readonly label: Sentence;
  readonly own?: number;
  readonly normal: Vec3;
}

export interface Cutting {
  readonly shape: Shape;
  /** Id of the direction. */
  readonly across: string;
  /** Where on the way through the parts, from 0 to 1. */
  readonly share: number;
}

/** Null while nothing is being cut. */
export const cutting = signal<Cutting | null>(null);

const global: readonly CutDirection[] = [
  { id: 'x', label: m`Left from right`, normal: [1, 0, 0] },
  { id: 'y', label: m`Top from bottom`, normal: [0, 1, 0] },
  { id: 'z', label: m`Front from back`, normal: [0, 0, 1] },
];
/** A part's own axis that is nearer than this (cosine, 3°) to one of the model's is no direction of its own. */
const sameWay = 0.9986;

const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** The model's three, and those of the first part where it is turned. */
export function cutDirections(shape: Shape, ids: readonly string[]): readonly CutDirection[] {
  const [first] = realParts(shape, ids);
  const part = shape.parts.find(({ id }) => id === first);
  const own = (part?.axes ?? []).filter((axis) => global.every(({ normal }) => Math.abs(dot(axis, normal)) < sameWay));
  return [
    ...global,
    ...own.map((normal, i) => ({ id: `own ${i}`, label: m`Across its own axis {0}`, own: i + 1, normal })),
  ];
}

/** The plane as it stands: through which point, across which direction, how far the parts reach about it. */
export const cutPlane = computed(() => {
  const state = cutting.value;
  if (state === null) return null;
  const { shape, across, share } = state;
  const real = new Set(realParts(shape, selected.value));
  const corners = shape.parts.filter(({ id }) => real.has(id)).flatMap((part) => part.corners);
  const directions = cutDirections(shape, selected.value);
  const direction = directions.find(({ id }) => id === across) ?? directions[0];
  if (corners.length === 0 || direction === undefined) return null;
  const { normal } = direction;
  const along = corners.map((corner) => dot(corner, normal));
  const [least, most] = [Math.min(...along), Math.max(...along)];
  const offset = least + share * (most - least);
  const middle = [0, 1, 2].map((axis) => {
    const values = corners.map((corner) => corner[axis] ?? 0);
    return (Math.min(...values) + Math.max(...values)) / 2;
  }) as unknown as Vec3;
  const off = offset - dot(middle, normal);
  const origin: Vec3 = [middle[0] + off * normal[0], middle[1] + off * normal[1], middle[2] + off * normal[2]];
  const reach = Math.max(...corners.map((corner) => Math.hypot(...corner.map((x, i) => x - (middle[i] ?? 0)))));
  return { direction, directions, least, most, offset, origin, reach };
});

/** Begins in the middle of the longest extent. */
export function beginCut(shape: Shape): void {
  const real = new Set(realParts(shape, selected.peek()));
  const corners = shape.parts.filter(({ id }) => real.has(id)).flatMap((part) => part.corners);
  const extent = [0, 1, 2].map((axis) => {
    const values = corners.map((corner) => corner[axis] ?? 0);
    return Math.max(...values) - Math.min(...values);
  });
  cutting.value = { shape, across: global[extent.indexOf(Math.max(...extent))]?.id ?? 'x', share: 0.5 };
}

export const endCut = (): void => {
  cutting.value = null;
};

export function moveCut(share: number): void {
  const state = cutting.peek();
  if (state !== null) cutting.value = { ...state, share: Math.min(0.99, Math.max(0.01, share)) };
}

export function turnCut(across: string): void {
  const state = cutting.peek();
  if (state !== null) cutting.value = { ...state, across, share: 0.5 };
}

/** The step that cuts what is selected where the plane stands; null when nothing is being cut. */
export function cutStep(): { readonly kind: 'cut'; readonly parts: readonly string[]; readonly plane: Plane } | null {
  const [state, plane] = [cutting.peek(), cutPlane.peek()];
  if (state === null || plane === null) return null;
  const parts = keysOf(state.shape, selected.peek());
  return { kind: 'cut', parts, plane: planeInFile(state.shape, plane.direction.normal, plane.offset) };
}
