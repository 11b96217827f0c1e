// A seed edit as a form holds it: one value for every field that some operator has, so that changing the operator
// forgets nothing.
import { directionField, fieldsOf, isGroupOperator } from '../program/operators';
import {
  type Anchor,
  type DirectionReference,
  type GeometricStatement,
  isGroup,
  type LocalTriple,
  type PointReference,
  type Shape,
  type Statement,
} from '../program/types';
import { axes, mostAlong } from '../session/measure';

export type Operator = Statement['op'];

export interface SeedChoice {
  readonly op: Operator;
  /** Id; empty while none is chosen. */
  readonly part: string;
  readonly feature: LocalTriple;
  /** Direction, axis or normal, whichever the operator takes. */
  readonly direction: DirectionReference;
  /** Of an operator that takes both; null: what goes with the direction. */
  readonly normal: DirectionReference | null;
  readonly origin: PointReference;
  readonly anchor: Anchor;
  /** Closed form in x; null: what is usual for the operator. */
  readonly amount: string | null;
}

export const firstChoice: SeedChoice = {
  op: 'translate',
  part: '',
  feature: [0, 0, 0],
  direction: axes[0],
  normal: null,
  origin: { part: '', at: [0, 0, 0] },
  anchor: 'fit', // more of them where they stand: at the ends they would hang in the air
  amount: null,
};

/** The row or ring that a part is an instance of, or stands for. */
export const groupOfPart = (shape: Shape, part: string) =>
  shape.relations.filter(isGroup).find((relation) => relation.parent === part || relation.parts.includes(part));

/** Whether a form has all that the edit needs. */
export const isWhole = (shape: Shape, { op, part }: SeedChoice): boolean =>
  part !== '' && (!isGroupOperator(op) || groupOfPart(shape, part) !== undefined);

/** The same edit of another part: what was told by the old part is told by the new one. */
export function withPart(shape: Shape, choice: SeedChoice, part: string): SeedChoice {
  const isOld = (reference: object) => 'part' in reference && reference.part === choice.part;
  return {
    ...choice,
    part,
    op: isGroupOperator(choice.op) && groupOfPart(shape, part) === undefined ? 'translate' : choice.op,
    origin: isOld(choice.origin) ? { ...choice.origin, part } : choice.origin,
    direction: isOld(choice.direction) ? { ...choice.direction, part } : choice.direction,
    normal: choice.normal !== null && isOld(choice.normal) ? { ...choice.normal, part } : choice.normal,
  };
}

/** @param choice whole */
export function seedOf(shape: Shape, choice: SeedChoice): Statement {
  const { op, part, feature, direction, origin, anchor } = choice;
  const amount = choice.amount ?? 'x';
  if (op === 'keep_fixed') return { op, part };
  if (isGroupOperator(op)) {
    const relation = groupOfPart(shape, part)?.id ?? '';
    // x is about ±0.35 and a count is rounded down: whole instances need a larger factor
    if (op === 'change_count') return { op, relation, anchor, amount: choice.amount ?? '10*x' };
    return { op, relation, anchor: anchor === 'fit' ? 'middle' : anchor, amount };
  }
  const fields = fieldsOf(op);
  const own = directionField(fields);
  // Slants along the direction, more so higher up; what slants upwards does so from front to back.
  const upwards = 'part' in direction ? direction.axis === 1 : mostAlong(direction) === 1;
  const seed = {
    op,
    part,
    feature,
    ...('origin' in fields ? { origin } : {}),
    ...('normal' in fields ? { normal: choice.normal ?? axes[upwards ? 2 : 1] } : {}),
    ...(own === undefined ? {} : { [own]: direction }),
    amount,
  };
  return seed as GeometricStatement; // with the fields that the table gives the operator
}

/** The form of a seed edit: seedOf() gives it back. */
export function choiceOf(shape: Shape, seed: Statement): SeedChoice {
  if ('relation' in seed) {
    const { op, anchor, amount } = seed;
    const part = shape.relations.filter(isGroup).find(({ id }) => id === seed.relation)?.parent ?? '';
    return { ...firstChoice, op, part, origin: { part, at: [0, 0, 0] }, anchor, amount };
  }
  const { op, part } = seed;
  const choice = { ...firstChoice, op, part, origin: { part, at: [0, 0, 0] } as const };
  if (seed.op === 'keep_fixed') return choice;
  const { feature, amount } = seed;
  const given: Readonly<Record<string, unknown>> = { ...seed };
  const own = directionField(fieldsOf(seed.op));
  return {
    ...choice,
    feature,
    amount,
    ...('origin' in seed ? { origin: seed.origin } : {}),
    ...(own === undefined ? {} : { direction: given[own] as DirectionReference }),
    ...('normal' in seed && own !== 'normal' ? { normal: seed.normal } : {}),
  };
}
