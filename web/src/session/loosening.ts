// How far a slider can go before a relation that an edit does not keep comes apart.
import { checkProgram } from '../program/check';
import { compileProgram, type Evaluator } from '../program/compile';
import { movedParts } from '../program/edited';
import { byThemselves } from '../program/rest';
import { isGroup, type Layer, type Shape, type ShapeRelation } from '../program/types';
import { emptyProgram } from './document';
import { type Measure, measureOf, pointIn, readAt } from './measure';

/** What is held is off by no more, normalised: the deltas of core/base/tolerance.h, with one and with both parts edited. */
const slackOneEdited = 0.0144;
const slackBothEdited = 0.0433;
const samples = 96;

export interface Loosening {
  /** What the slider reads where the relation comes apart, downwards and upwards of rest; null where it does not. */
  readonly below: number | null;
  readonly above: number | null;
  /** The slider's values there. */
  readonly belowAt: number | null;
  readonly aboveAt: number | null;
  /** At rest. */
  readonly rest: number;
  readonly measure: Measure;
}

const found = new WeakMap<Layer, Map<ShapeRelation, Loosening | null>>();

/** Of a layer on its own; null for groups, for a layer without a measure, and for what never comes apart. */
export function looseningOf(shape: Shape, layer: Layer, relation: ShapeRelation): Loosening | null {
  const known = found.get(layer) ?? new Map<ShapeRelation, Loosening | null>();
  found.set(layer, known);
  if (!known.has(relation)) known.set(relation, search(shape, layer, relation));
  return known.get(relation) ?? null;
}

/** Where on the slider the first of the relations that an edit does not keep comes apart, to both sides of 0. */
export function cleanEnds(shape: Shape, layer: Layer): { readonly min: number; readonly max: number } {
  let { min, max } = layer.parameter;
  for (const { id, status } of layer.relations) {
    const relation = status === 'broken' ? shape.relations.find((other) => other.id === id) : undefined;
    const found = relation === undefined ? null : looseningOf(shape, layer, relation);
    min = Math.max(min, found?.belowAt ?? min);
    max = Math.min(max, found?.aboveAt ?? max);
  }
  return { min, max };
}

function search(shape: Shape, layer: Layer, relation: ShapeRelation): Loosening | null {
  const seed = layer.statements.find(({ why }) => why?.kind === 'seed') ?? layer.statements[0];
  const measure = measureOf(shape, seed);
  const checked = checkProgram({ ...emptyProgram(shape), layers: byThemselves([layer]) }, shape);
  if (isGroup(relation) || measure === null || !checked.ok) return null;
  const evaluator = compileProgram(checked.value, shape);
  const off = deviation(shape, relation);
  const moved = movedParts(shape, layer.statements);
  const bothEdited = relation.kind !== 'ground' && relation.parts.every((id) => moved.has(id));
  const slack = bothEdited ? slackBothEdited : slackOneEdited;
  const groups = groupsOfInstances(shape, relation);
  const { min, max } = layer.parameter;
  const reading = (value: number) => readAt(shape, measure, evaluator, [0], 0, [value])[0] ?? 0;
  const firstBeyond = (end: number): number | null => {
    for (let i = 1; i <= samples; i++) {
      evaluator.evaluate([(end * i) / samples]);
      // Once the number of instances changes, they are copies at places of their own: there is nothing to come apart.
      if (groups.some(([group, count]) => evaluator.groups[group]?.count !== count)) continue;
      if (off(evaluator) > slack) return (end * i) / samples;
    }
    return null;
  };
  const [belowAt, aboveAt] = [firstBeyond(min), firstBeyond(max)];
  if (belowAt === null && aboveAt === null) return null;
  const [below, above] = [belowAt, aboveAt].map((at) => (at === null ? null : reading(at))) as [
    number | null,
    number | null,
  ];
  return { below, above, belowAt, aboveAt, rest: reading(0), measure };
}

/** Index and number of instances of the groups that a relation's parts are instances of. */
function groupsOfInstances(shape: Shape, { parts }: ShapeRelation): readonly (readonly [number, number])[] {
  return [...shape.relations.entries()].flatMap(([i, group]) =>
    isGroup(group) && parts.some((id) => group.parts.includes(id)) ? [[i, group.parts.length] as const] : [],
  );
}

/** Largest coordinate by which a relation is off, against what it is at rest. */
function deviation(shape: Shape, relation: Exclude<ShapeRelation, { kind: 'translation' | 'rotation' }>) {
  const [a = 0, b = 0] = relation.parts.map((id) => shape.parts.findIndex((part) => part.id === id));
  const differences = (corners: ArrayLike<number>): number[] => {
    // The height alone.
    if (relation.kind === 'ground') return relation.local.map((local) => pointIn(corners, a, local)[1] ?? 0);
    if (relation.kind !== 'reflection') {
      return relation.local_a.flatMap((local, i) => {
        const to = pointIn(corners, b, relation.local_b[i] ?? local);
        return pointIn(corners, a, local).map((value, axis) => value - (to[axis] ?? 0));
      });
    }
    const { origin, normal, corner_map } = relation;
    return corner_map.flatMap((from, k) => {
      const at = [0, 1, 2].map((axis) => corners[a * 24 + from * 3 + axis] ?? 0);
      const beyond = at.reduce((sum, value, axis) => sum + (value - (origin[axis] ?? 0)) * (normal[axis] ?? 0), 0);
      return at.map((value, axis) => value - 2 * beyond * (normal[axis] ?? 0) - (corners[b * 24 + k * 3 + axis] ?? 0));
    });
  };
  const rest = differences(shape.parts.flatMap((part) => part.corners.flat()));
  return ({ corners }: Evaluator) =>
    Math.max(...differences(corners).map((value, i) => Math.abs(value - (rest[i] ?? 0))));
}
