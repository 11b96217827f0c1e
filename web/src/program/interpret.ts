// The slow, readable evaluator: the oracle that compile.ts is tested against. It follows the tables of
// core/edit/operators.h and core/edit/evaluate.h word by word, on immutable values, and shares no evaluation code with
// the compiler. Never on the slider path.
import type { CheckedProgram } from './check';
import type { Expression } from './parse';
import { partIndex } from './part_index';
import {
  type Anchor,
  type Axis,
  type Corners,
  type DirectionReference,
  type GeometricStatement,
  isGeometric,
  isGroup,
  type LocalTriple,
  maxInstances,
  type PointReference,
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
export interface TranslationState extends InstancesState {
  readonly kind: 'translation';
  readonly start: Vec3;
  readonly end: Vec3;
}
export interface RotationState extends InstancesState {
  readonly kind: 'rotation';
  readonly centre: Vec3;
  readonly axis: Vec3;
  readonly radius: number;
}
export type GroupState = TranslationState | RotationState;

export interface State {
  readonly parts: readonly Corners[];
  /** By relation index; null for relations that are no group. */
  readonly groups: readonly (GroupState | null)[];
}

/** The state at values[i] of layer i's parameter. */
export function interpretProgram({ program, amounts }: CheckedProgram, shape: Shape, values: readonly number[]): State {
  const parameters = new Map(program.layers.map((layer, i) => [layer.parameter.name, values[i] ?? 0]));
  const amountOf = (text: string): number => {
    const expression = amounts.get(text);
    const value = expression ? evaluateExpression(expression, parameters) : Number.NaN;
    return Number.isFinite(value) ? value : 0;
  };
  let state = restState(shape);
  for (const layer of program.layers) {
    const atStart = state;
    for (const statement of layer.statements) {
      if (statement.op === 'keep_fixed') continue;
      const amount = amountOf(statement.amount);
      if (isGeometric(statement)) {
        state = moveCorners(shape, state, statement, pointMotion(shape, atStart, statement, amount));
      } else {
        state = changeGroup(shape, state, statement.relation, statement.op, statement.anchor, amount);
      }
    }
  }
  return state;
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

// ------------------------------------------------------------------------------------------------------ expressions

/** NaN where the expression is undefined or overflows. */
export function evaluateExpression(expression: Expression, parameters: ReadonlyMap<string, number>): number {
  const value = (inner: Expression) => evaluateExpression(inner, parameters);
  switch (expression.kind) {
    case 'number':
      return expression.value;
    case 'parameter':
      return parameters.get(expression.name) ?? Number.NaN;
    case 'negate':
      return -value(expression.operand);
    case 'binary':
      return defined(binary(expression.op, value(expression.left), value(expression.right)));
    case 'call':
      return defined(call(expression.name, expression.arguments.map(value)));
  }
}

function defined(value: number): number {
  return Number.isFinite(value) ? value : Number.NaN;
}

function binary(op: string, a: number, b: number): number {
  if (Number.isNaN(a) || Number.isNaN(b)) return Number.NaN;
  switch (op) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    default:
      return Number.isInteger(b) ? a ** b : notNegative(a) ** b;
  }
}

function call(name: string, list: readonly number[]): number {
  const [a = Number.NaN, b = Number.NaN] = list;
  switch (name) {
    case 'sqrt':
      return Math.sqrt(notNegative(a));
    case 'abs':
      return Math.abs(a);
    case 'floor':
      return Math.floor(a + 1e-9);
    case 'sin':
      return Math.sin(a);
    case 'cos':
      return Math.cos(a);
    case 'tan':
      return Math.tan(a);
    case 'atan2':
      return b < 0 && a <= 0 && a >= 1e-12 * b ? Math.PI : Math.atan2(a, b + 0);
    case 'min':
      return Math.min(...list);
    default:
      return Math.max(...list);
  }
}

/** The noise of expanded forms below 0 is 0. */
function notNegative(value: number): number {
  return value >= -1e-12 && value < 0 ? 0 : value;
}

// --------------------------------------------------------------------------------------------------------- vectors

function item<T>(list: readonly T[], index: number | undefined): T {
  const found = list[index ?? -1];
  if (found === undefined) throw new Error('the program was checked for another shape');
  return found;
}
function map3(f: (i: 0 | 1 | 2) => number): Vec3 {
  return [f(0), f(1), f(2)];
}
const zero: Vec3 = [0, 0, 0];
const add = (a: Vec3, b: Vec3) => map3((i) => a[i] + b[i]);
const subtract = (a: Vec3, b: Vec3) => map3((i) => a[i] - b[i]);
const times = (s: number, a: Vec3) => map3((i) => s * a[i]);
const dot = (a: Vec3, b: Vec3) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const length = (a: Vec3) => Math.hypot(...a);
const cross = (a: Vec3, b: Vec3): Vec3 => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
const sum = (list: readonly Vec3[]) => list.reduce(add, zero);
const mean = (list: readonly Vec3[]) => times(1 / list.length, sum(list));
const translated = (corners: Corners, by: Vec3): Corners => corners.map((corner) => add(corner, by));

/** v turned about a unit axis; Rodrigues. */
function turn(v: Vec3, axis: Vec3, angle: number): Vec3 {
  return sum([
    times(Math.cos(angle), v),
    times(Math.sin(angle), cross(axis, v)),
    times((1 - Math.cos(angle)) * dot(axis, v), axis),
  ]);
}

function cornerSign(k: number, axis: number): -1 | 1 {
  return (k >> axis) & 1 ? 1 : -1;
}
function selects(feature: LocalTriple, k: number): boolean {
  return feature.every((wanted, i) => wanted === 0 || wanted === cornerSign(k, i));
}

/** From the - face centre to the + face centre, unit; null when they coincide. */
function partAxis(corners: Corners, axis: Axis): Vec3 | null {
  const face = (sign: number) => mean(corners.filter((_, k) => cornerSign(k, axis) === sign));
  const between = subtract(face(1), face(-1));
  return length(between) < 1e-12 ? null : times(1 / length(between), between);
}

// ------------------------------------------------------------------------------------------- geometric operators

type Motion = (point: Vec3) => Vec3;

/** What a statement does to one point; its references are read on the state at the start of the layer. */
function pointMotion(shape: Shape, atStart: State, statement: GeometricStatement, a: number): Motion {
  const point = (reference: PointReference) => resolvePoint(shape, atStart, reference);
  const direction = (reference: DirectionReference) => resolveDirection(shape, atStart, reference);
  const nothing: Motion = (p) => p;
  switch (statement.op) {
    case 'translate': {
      const n = direction(statement.direction);
      return n ? (p) => add(p, times(a, n)) : nothing;
    }
    case 'rotate': {
      const o = point(statement.origin);
      const n = direction(statement.axis);
      return n ? (p) => add(o, turn(subtract(p, o), n, a)) : nothing;
    }
    case 'scale_1d': {
      const o = point(statement.origin);
      const n = direction(statement.direction);
      return n ? (p) => add(p, times(a * dot(n, subtract(p, o)), n)) : nothing;
    }
    case 'scale_2d': {
      const o = point(statement.origin);
      const n = direction(statement.normal);
      if (!n) return nothing;
      return (p) => {
        const r = subtract(p, o);
        return add(p, times(a, subtract(r, times(dot(n, r), n))));
      };
    }
    case 'scale_3d': {
      const o = point(statement.origin);
      return (p) => add(p, times(a, subtract(p, o)));
    }
    case 'shear': {
      const o = point(statement.origin);
      const n = direction(statement.normal);
      const d = direction(statement.direction);
      return n && d ? (p) => add(p, times(a * dot(n, subtract(p, o)), d)) : nothing;
    }
  }
}

function resolvePoint(shape: Shape, state: State, reference: PointReference): Vec3 {
  if (!('part' in reference)) return reference;
  const corners = item(state.parts, partIndex(shape).get(reference.part));
  return mean(corners.filter((_, k) => selects(reference.at, k)));
}

function resolveDirection(shape: Shape, state: State, reference: DirectionReference): Vec3 | null {
  if (!('part' in reference)) return times(1 / length(reference), reference);
  return partAxis(item(state.parts, partIndex(shape).get(reference.part)), reference.axis);
}

/** A geometric statement on a real part, on a member of a group, or on a group's parent. */
function moveCorners(shape: Shape, state: State, statement: GeometricStatement, motion: Motion): State {
  const index = partIndex(shape);
  const part = index.get(statement.part);
  const move = (corners: Corners) =>
    corners.map((corner, k) => (selects(statement.feature, k) ? motion(corner) : corner));
  for (const [r, relation] of shape.relations.entries()) {
    if (!isGroup(relation)) continue;
    const group = state.groups[r];
    if (!group) continue;
    if (index.get(relation.parent) === part) {
      const before = item(state.parts, part);
      const after = move(before);
      const whole = statement.feature.every((sign) => sign === 0);
      const carry: Motion = whole ? motion : (point) => add(point, displacementIn(before, after, point));
      const parted = { ...state, parts: state.parts.with(part ?? -1, after) };
      return withGroup(shape, parted, r, carryGroup(shape, relation, group, after, carry));
    }
    const member = relation.parts.findIndex((id) => index.get(id) === part);
    if (member >= 0) {
      const instances = group.instances.with(member, move(item(group.instances, member)));
      return withGroup(shape, state, r, { ...group, instances });
    }
  }
  return { ...state, parts: state.parts.with(part ?? -1, move(item(state.parts, part))) };
}

/** Replaces a group's state and lets its members show it: member k is instance k, or the last there is. */
function withGroup(shape: Shape, state: State, r: number, group: GroupState): State {
  const index = partIndex(shape);
  const parts = [...state.parts];
  for (const [k, id] of item(shape.relations, r).parts.entries()) {
    parts[index.get(id) ?? -1] = item(group.instances, Math.min(k, group.instances.length - 1));
  }
  return { parts, groups: state.groups.with(r, group) };
}

/** The instances and points of a group whose parent has moved to `parent`. */
function carryGroup(
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

// ------------------------------------------------------------------------------------------- trilinear coordinates

/** What the trilinear map of a cage does to a point when its corners move from `before` to `after`. */
function displacementIn(before: Corners, after: Corners, point: Vec3): Vec3 {
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

// ---------------------------------------------------------------------------------------------------------- groups

function changeGroup(
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
