// Groups of the readable evaluator (interpret.ts): their state, how members show it, and how an edit changes it.
import {
  add,
  cornerSign,
  dot,
  item,
  length,
  type Motion,
  mean,
  partAxis,
  subtract,
  sum,
  times,
  translated,
  turn,
  zero,
} from './interpret_points';
import { partIndex } from './part_index';
import {
  type Anchor,
  type Corners,
  isGroup,
  maxInstances,
  type RotationRelation,
  type Shape,
  type TranslationRelation,
  type Vec3,
} from './types';

interface InstancesState {
  readonly instances: readonly Corners[];
  /** The member whose mesh all instances share once the count has changed, else -1. */
  readonly source: number;
}
interface TranslationState extends InstancesState {
  readonly kind: 'translation';
  readonly start: Vec3;
  readonly end: Vec3;
}
interface RotationState extends InstancesState {
  readonly kind: 'rotation';
  readonly centre: Vec3;
  readonly axis: Vec3;
  readonly radius: number;
}
type GroupState = TranslationState | RotationState;

export interface State {
  readonly parts: readonly Corners[];
  /** By relation index; null for relations that are no group. */
  readonly groups: readonly (GroupState | null)[];
}

export function restState(shape: Shape): State {
  const index = partIndex(shape);
  const parts = shape.parts.map((part) => part.corners);
  const groups = shape.relations.map((relation): GroupState | null => {
    if (!isGroup(relation)) return null;
    const instances = relation.parts.map((id) => item(parts, index.get(id)));
    if (relation.kind === 'rotation') {
      const { centre, axis, radius } = relation;
      return { kind: 'rotation', instances, source: -1, centre, axis, radius };
    }
    return { kind: 'translation', instances, source: -1, start: relation.start, end: relation.end };
  });
  return { parts, groups };
}

/** Replaces a group's state and lets its members show it: member k is instance k, or the last there is. */
export function withGroup(shape: Shape, state: State, r: number, group: GroupState): State {
  const index = partIndex(shape);
  const parts = [...state.parts];
  for (const [k, id] of item(shape.relations, r).parts.entries()) {
    parts[index.get(id) ?? -1] = item(group.instances, Math.min(k, group.instances.length - 1));
  }
  return { parts, groups: state.groups.with(r, group) };
}

/** The instances and points of a group whose parent has moved to `parent`. */
export function carryGroup(
  shape: Shape,
  relation: TranslationRelation | RotationRelation,
  group: GroupState,
  parent: Corners,
  carry: Motion,
): GroupState {
  const instances = group.instances.map((corners) => corners.map(carry));
  if (group.kind === 'translation') return { ...group, instances, start: carry(group.start), end: carry(group.end) };
  if (relation.kind !== 'rotation') return group;
  const centre = carry(group.centre);
  const restParent = item(shape.parts, partIndex(shape).get(relation.parent)).corners;
  const restDirection = partAxis(restParent, relation.parent_axis) ?? zero;
  const direction = partAxis(parent, relation.parent_axis);
  const axis = direction ? times(dot(restDirection, relation.axis) < 0 ? -1 : 1, direction) : group.axis;
  const spokes = instances.map((corners) => length(spoke({ centre, axis }, corners)));
  return { ...group, instances, centre, axis, radius: spokes.reduce((a, b) => a + b, 0) / spokes.length };
}

export function changeGroup(
  shape: Shape,
  state: State,
  id: string,
  op: 'change_count' | 'change_delta',
  anchor: Anchor,
  amount: number,
): State {
  const r = shape.relations.findIndex((relation) => relation.id === id);
  const relation = item(shape.relations, r);
  const group = state.groups[r];
  if (!group || !isGroup(relation)) throw new Error('the program was checked for another shape');
  const n = group.instances.length;
  const count = Math.min(maxInstances, Math.max(1, n + Math.floor(amount + 1e-9)));
  if (op === 'change_count' && count === n) return state;
  const parent = partIndex(shape).get(relation.parent) ?? -1;
  const corners = item(state.parts, parent);

  if (group.kind === 'rotation' && relation.kind === 'rotation') {
    if (op === 'change_count') return withGroup(shape, state, r, recountRing(group, count));
    const moved = { ...state, parts: state.parts.with(parent, widenParent(relation, group, corners, amount)) };
    return withGroup(shape, moved, r, widenRing(group, amount));
  }
  if (group.kind === 'translation' && relation.kind === 'translation') {
    const after = op === 'change_count' ? recountRow(relation, group, anchor, count) : spaceRow(group, anchor, amount);
    const first = subtract(after.start, group.start);
    const last = subtract(after.end, group.end);
    const sides = corners.map((corner, k) =>
      add(corner, cornerSign(k, relation.axis) === relation.direction ? last : first),
    );
    return withGroup(shape, { ...state, parts: state.parts.with(parent, sides) }, r, after);
  }
  throw new Error('a group keeps its kind');
}

function spaceRow(group: TranslationState, anchor: Anchor, amount: number): TranslationState {
  const n = group.instances.length;
  if (n === 1) return group;
  const delta = times(1 / (n - 1), subtract(group.end, group.start));
  const fixed = { start: 0, middle: (n - 1) / 2, fit: (n - 1) / 2, end: n - 1 }[anchor];
  const motion = (i: number) => times((i - fixed) * amount, delta);
  return {
    ...group,
    instances: group.instances.map((corners, i) => translated(corners, motion(i))),
    start: add(group.start, motion(0)),
    end: add(group.end, motion(n - 1)),
  };
}

/** All instances become copies of one template; `count` differs from the present one. */
function recountRow(
  relation: TranslationRelation,
  group: TranslationState,
  anchor: Anchor,
  count: number,
): TranslationState {
  const n = group.instances.length;
  const middle = times(0.5, add(group.start, group.end));
  const delta =
    n > 1
      ? times(1 / (n - 1), subtract(group.end, group.start))
      : times(1 / (relation.parts.length - 1), subtract(relation.end, relation.start));
  const position = (i: number) => (n > 1 ? add(group.start, times(i, delta)) : middle);
  const target = (j: number): Vec3 => {
    switch (anchor) {
      case 'start':
        return add(position(0), times(j, delta));
      case 'end':
        return subtract(position(n - 1), times(count - 1 - j, delta));
      case 'middle':
        return add(middle, times(j - (count - 1) / 2, delta));
      case 'fit':
        if (count === 1) return middle;
        return add(group.start, times(j / (count - 1), subtract(group.end, group.start)));
    }
  };
  const t = { start: 0, fit: 0, end: n - 1, middle: Math.floor((n - 1) / 2) }[anchor];
  const template = item(group.instances, t);
  const instances = Array.from({ length: count }, (_, j) => translated(template, subtract(target(j), position(t))));
  const kept = anchor === 'fit';
  return {
    ...group,
    instances,
    source: group.source < 0 ? t : group.source,
    start: kept ? group.start : target(0),
    end: kept ? group.end : target(count - 1),
  };
}

/** The vector from the axis to the centre of an instance. */
function spoke({ centre, axis }: { centre: Vec3; axis: Vec3 }, instance: Corners): Vec3 {
  const out = subtract(mean(instance), centre);
  return subtract(out, times(dot(out, axis), axis));
}

function widenRing(group: RotationState, amount: number): RotationState {
  const instances = group.instances.map((corners) => translated(corners, times(amount, spoke(group, corners))));
  return { ...group, instances, radius: group.radius * (1 + amount) };
}

function widenParent(relation: RotationRelation, group: RotationState, parent: Corners, amount: number): Corners {
  const inPlane = ([0, 1, 2] as const).filter((axis) => axis !== relation.parent_axis);
  return parent.map((corner, k) => {
    const outward = inPlane.map((axis) => times(cornerSign(k, axis), partAxis(parent, axis) ?? zero));
    return add(corner, times(amount * group.radius, sum(outward)));
  });
}

function recountRing(group: RotationState, count: number): RotationState {
  const template = item(group.instances, 0);
  const instances = Array.from({ length: count }, (_, k) =>
    template.map((corner) =>
      add(group.centre, turn(subtract(corner, group.centre), group.axis, (2 * Math.PI * k) / count)),
    ),
  );
  return { ...group, instances, source: Math.max(0, group.source) };
}
