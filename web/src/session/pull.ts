// Pulling at the shape in the view. What is grabbed decides the seed edit; it is propagated once, when the pull begins,
// and from then on the hand moves the slider of the layer that came of it, so that the whole shape follows at every
// frame. Letting go keeps the layer, Escape leaves everything as it was.

import { signal } from '@preact/signals';
import { statementText } from '../program/text';
import type { Axis, LocalTriple, ReflectionRelation, Shape, ShapePart, Statement, Vec3 } from '../program/types';
import { t } from '../texts/texts';
import { withRequest } from './document';
import { activeLayers } from './evaluation';
import { axes, type Measure, measureOf, pointIn } from './measure';
import type { ModelCore } from './model_core';
import { readLayer } from './reading';
import {
  compiled,
  document,
  draft,
  entriesOf,
  entryOf,
  keepDraft,
  onto,
  say,
  settle,
  slide,
  sliderValue,
  useCore,
} from './session';
import { snapped } from './snapping';
import { sentence } from './tasks';

/** A feature of a part that a hand holds; the whole part is moved, a face stretches it. */
export interface Grab {
  readonly part: string;
  /** Parts that get the same edit, each of its own. */
  readonly also: readonly string[];
  readonly feature: LocalTriple;
  /** The global axis along which a part, an edge or a corner goes; a face goes along its own normal. */
  readonly axis: Axis;
  /** The opposite face stays, also where pulling at both sides would keep the shape symmetric. */
  readonly oneSided: boolean;
}

export interface Pull {
  readonly grab: Grab;
  /** Unit vector in the normalised frame. */
  readonly direction: Vec3;
  /** Null until the core has answered. */
  readonly layer: {
    readonly key: number;
    /** Value of the slider when the pull began, and its range. */
    readonly start: number;
    readonly min: number;
    readonly max: number;
    /** How far the feature goes along the direction for each unit of the slider. */
    readonly gain: number;
    readonly measure: Measure | null;
    /** Of the measure when the pull began. */
    readonly before: number;
  } | null;
}
export const pull = signal<Pull | null>(null);

const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const isFace = (feature: LocalTriple) => feature.filter((sign) => sign !== 0).length === 1;

/** From the opposite face to this one, of length 1. */
export function faceNormal(corners: ArrayLike<number>, part: number, feature: LocalTriple): Vec3 {
  const to = pointIn(corners, part, feature);
  const from = pointIn(corners, part, opposite(feature));
  const d = to.map((value, i) => value - (from[i] ?? 0)) as unknown as Vec3;
  const length = Math.hypot(...d) || 1;
  return d.map((value) => value / length) as unknown as Vec3;
}

// Not -sign, which makes -0 of 0.
const opposite = (feature: LocalTriple) => feature.map((sign) => 0 - sign) as unknown as LocalTriple;

/** Whether a mirror symmetry of the shape goes through the middle of a part, across one of its axes. */
function isMirrored(shape: Shape, { corners, axes: own }: ShapePart, axis: Axis): boolean {
  const centre = pointIn(corners.flat(), 0, [0, 0, 0]);
  return mirrorsAcross(shape, own[axis]).some(({ normal, origin }) => {
    const off = centre.map((value, i) => value - (origin[i] ?? 0)) as unknown as Vec3;
    return Math.abs(dot(normal, off)) < 0.01;
  });
}

/** The mirror symmetries whose plane is across a direction. */
function mirrorsAcross({ relations }: Shape, direction: Vec3): readonly ReflectionRelation[] {
  return relations
    .filter((relation) => relation.kind === 'reflection')
    .filter(({ normal }) => Math.abs(dot(normal, direction)) > 0.98);
}

/**
 * What grabbing means. A face stretches its part from the opposite face, or from the centre where the part lies across
 * a mirror plane of the shape: pulling at one side of a seat then widens the chair, and keeps it symmetric.
 */
export function seedOfGrab(shape: Shape, { part: id, feature, axis, oneSided }: Omit<Grab, 'also'>): Statement {
  const amount = 'x';
  const part = shape.parts.find((other) => other.id === id);
  if (part === undefined || !isFace(feature)) {
    return { op: 'translate', part: id, feature, direction: axes[axis] ?? [0, 1, 0], amount };
  }
  const own = feature.findIndex((sign) => sign !== 0) as Axis;
  const at: LocalTriple = !oneSided && isMirrored(shape, part, own) ? [0, 0, 0] : opposite(feature);
  const direction = { part: id, axis: own };
  return { op: 'scale_1d', part: id, feature: [0, 0, 0], origin: { part: id, at }, direction, amount };
}

/** Whether two statements do the same, each by an amount of its own. */
function isSameEdit(a: Statement, b: Statement): boolean {
  const [m, n] = [a, b].map((statement) => statementText({ ...statement, amount: '' } as Statement, { why: false }));
  return m === n;
}

let abort: AbortController | null = null;

/** Begins to pull. Pulling at what the last layer pulls at moves that layer's slider on. Resolves once it follows. */
export async function beginPull(core: ModelCore, grab: Grab, request: string): Promise<boolean> {
  const { model } = document.peek();
  const index = model?.shape.parts.findIndex(({ id }) => id === grab.part) ?? -1;
  const state = compiled.peek();
  if (model === null || index < 0 || state.kind !== 'ready') return false;
  cancelPull();
  const { corners } = state.evaluator;
  const direction = isFace(grab.feature) ? faceNormal(corners, index, grab.feature) : (axes[grab.axis] ?? [0, 1, 0]);
  const begun: Pull = { grab, direction, layer: null };
  pull.value = begun;

  const seed = seedOfGrab(model.shape, grab);
  const all = [seed, ...grab.also.map((part) => seedOfGrab(model.shape, { ...grab, part }))];
  const last = activeLayers(document.peek()).at(-1);
  const seeds = last?.layer.statements.filter(({ why }) => why?.kind === 'seed') ?? [];
  if (last !== undefined && seeds.length === all.length && all.every((one) => seeds.some((s) => isSameEdit(s, one)))) {
    pull.value = { ...begun, layer: follow(last.key, index, grab.feature, direction, seed) };
    return true;
  }
  // What is across the pull cannot stay the mirror image of a side that moves alone.
  const disabled = grab.oneSided ? mirrorsAcross(model.shape, direction).map(({ id }) => id) : [];
  abort = new AbortController();
  const { signal: cancelled } = abort;
  try {
    useCore(core);
    const alone = await core.propagate(model, { seed: all, disabled, hints: {} }, { signal: cancelled });
    const found = await onto(model, alone);
    if (pull.peek() !== begun || document.peek().model !== model) return false;
    const [entry] = entriesOf({ ...found, program: withRequest(found.program, request) }) ?? [];
    if (entry === undefined) throw new Error(t`Nothing came of it`);
    draft.value = entry;
    pull.value = { ...begun, layer: follow(entry.key, index, grab.feature, direction, seed) };
    return true;
  } catch (error) {
    if (pull.peek() !== begun) return false;
    pull.value = null;
    if (!cancelled.aborted) say(sentence(error), 'error');
    return false;
  } finally {
    if (abort?.signal === cancelled) abort = null;
  }
}

/** The layer that the hand moves: how far the grabbed point goes for a step of its slider is read off the shape. */
function follow(key: number, part: number, feature: LocalTriple, direction: Vec3, seed: Statement): Pull['layer'] {
  const state = compiled.peek();
  const entry = entryOf(key);
  const { shape } = document.peek().model ?? {};
  if (state.kind !== 'ready' || !entry || shape === undefined) return null;
  const { min, max } = entry.layer.parameter;
  const start = sliderValue(entry);
  const measure = measureOf(shape, seed);
  const before = measure ? (readLayer(entry, measure, [start])[0] ?? 0) : 0;
  const from = pointIn(state.evaluator.corners, part, feature);
  const step = (max - min) / 1000;
  const there = start + step <= max ? start + step : start - step;
  slide(key, there);
  const to = pointIn(state.evaluator.corners, part, feature);
  slide(key, start);
  const moved = to.map((value, i) => value - (from[i] ?? 0)) as unknown as Vec3;
  return { key, start, min, max, gain: dot(moved, direction) / (there - start), measure, before };
}

/** Moves the grabbed point to a distance from where it was, along the pull's direction; as far as the layer goes. */
export function pullTo(distance: number): void {
  const layer = pull.peek()?.layer;
  if (!layer || Math.abs(layer.gain) < 1e-6) return;
  const entry = entryOf(layer.key);
  const value = Math.min(layer.max, Math.max(layer.min, layer.start + distance / layer.gain));
  slide(layer.key, entry === undefined ? value : snapped(entry, value));
}

/** By keyboard: hundredths of the range, outwards. */
export function pullBy(steps: number): void {
  const layer = pull.peek()?.layer;
  const entry = layer && entryOf(layer.key);
  if (!layer || !entry) return;
  const sign = Math.sign(layer.gain);
  const value = sliderValue(entry);
  const next = snapped(entry, value, steps * sign);
  slide(layer.key, next === value ? value + (steps * sign * (layer.max - layer.min)) / 100 : next);
}

/** Lets go: what was pulled becomes a layer, or the new value of one. Answers its key; null when nothing had moved. */
export function endPull(): number | null {
  const layer = pull.peek()?.layer;
  const pulled = draft.peek();
  if (!layer) {
    cancelPull();
    return null;
  }
  pull.value = null;
  if (pulled === null) settle(layer.key);
  else if (sliderValue(pulled) === layer.start) draft.value = null;
  else return keepDraft();
  return pulled === null ? layer.key : null;
}

/** Leaves everything as it was before the pull. */
export function cancelPull(): void {
  const layer = pull.peek()?.layer;
  abort?.abort();
  abort = null;
  pull.value = null;
  if (draft.peek() !== null) draft.value = null;
  else if (layer) slide(layer.key, layer.start);
}
