// The slow, readable evaluator: the oracle that compile.ts is tested against. It follows the tables of
// core/edit/operators.h and core/edit/evaluate.h word by word, on immutable values, and shares no evaluation code with
// the compiler. Never on the slider path.
import type { CheckedProgram } from './check';
import { evaluateExpression } from './interpret_amount';
import { carryGroup, changeGroup, restState, type State, withGroup } from './interpret_groups';
import {
  add,
  displacementIn,
  dot,
  item,
  length,
  type Motion,
  mean,
  partAxis,
  selects,
  subtract,
  times,
  turn,
} from './interpret_points';
import { partIndex } from './part_index';
import {
  type Corners,
  type DirectionReference,
  type GeometricStatement,
  isGeometric,
  isGroup,
  type PointReference,
  type Shape,
  type Vec3,
} from './types';

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

// ------------------------------------------------------------------------------------------- geometric operators

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
