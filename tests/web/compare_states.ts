// What two evaluators' results differ by: the closures', the interpreter's, and recorded or foreign ones.
import { type Evaluator, groupPointAt } from '../../web/src/program/compile';
import type { State } from '../../web/src/program/interpret_groups';
import type { Corners, Shape, Vec3 } from '../../web/src/program/types';

/** A state as tests/golden/program_vectors.json and `parsel evaluate` write it. What is not named is at rest. */
export interface WrittenState {
  readonly parts: { readonly [part: string]: readonly (readonly number[])[] };
  readonly groups: { readonly [relation: string]: WrittenGroup };
}
export interface WrittenGroup {
  readonly instances: readonly (readonly (readonly number[])[])[];
  readonly source: number;
  readonly start?: readonly number[];
  readonly end?: readonly number[];
  readonly centre?: readonly number[];
  readonly axis?: readonly number[];
  readonly radius?: number;
}

/** Everything of the closures' state in the written form. */
export function writeEvaluator(evaluator: Evaluator, shape: Shape): WrittenState {
  const corners = (from: Float64Array, at: number) =>
    Array.from({ length: 8 }, (_, k) => vector(from, 24 * at + 3 * k));
  const parts = shape.parts.map((part, i) => [part.id, corners(evaluator.corners, i)] as const);
  const groups = evaluator.groups.flatMap((group) => {
    if (!group) return [];
    const instances = Array.from({ length: group.count }, (_, k) => corners(group.instances, k));
    const { points, relation, source } = group;
    const own =
      relation.kind === 'translation'
        ? { start: vector(points, groupPointAt.start), end: vector(points, groupPointAt.end) }
        : {
            centre: vector(points, groupPointAt.centre),
            axis: vector(points, groupPointAt.axis),
            radius: points[groupPointAt.radius] ?? Number.NaN,
          };
    return [[relation.id, { instances, source, ...own }] as const];
  });
  return { parts: Object.fromEntries(parts), groups: Object.fromEntries(groups) };
}

/** Everything of the interpreter's state in the written form. */
export function writeState(state: State, shape: Shape): WrittenState {
  const parts = shape.parts.map((part, i): [string, Corners] => [part.id, state.parts[i] ?? []]);
  const groups = shape.relations.flatMap((relation, i): [string, WrittenGroup][] => {
    const group = state.groups[i];
    return group ? [[relation.id, group]] : [];
  });
  return { parts: Object.fromEntries(parts), groups: Object.fromEntries(groups) };
}

/**
 * The largest difference of any coordinate that `expected` names, infinite when something is missing, not finite or
 * of another count; and where it is.
 */
export function worstDifference(actual: WrittenState, expected: WrittenState): { worst: number; place: string } {
  let found = { worst: 0, place: '' };
  const compare = (a: unknown, b: unknown, place: string): void => {
    if (typeof b === 'number' && typeof a === 'number') {
      const difference = Number.isFinite(a) && Number.isFinite(b) ? Math.abs(a - b) : Number.POSITIVE_INFINITY;
      if (difference > found.worst) found = { worst: difference, place };
    } else if (Array.isArray(a) && Array.isArray(b) && a.length === b.length) {
      for (const [i, item] of b.entries()) compare(a[i], item, `${place}/${i}`);
    } else if (isRecord(a) && isRecord(b)) {
      for (const [key, item] of Object.entries(b)) if (key !== 'kind') compare(a[key], item, `${place}/${key}`);
    } else {
      found = { worst: Number.POSITIVE_INFINITY, place };
    }
  };
  compare(actual, expected, '');
  return found;
}

function isRecord(value: unknown): value is Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}

function vector(from: Float64Array, at: number): Vec3 {
  return [from[at] ?? Number.NaN, from[at + 1] ?? Number.NaN, from[at + 2] ?? Number.NaN];
}
