// What each operator takes, from the table that the core is compiled with as well. The interfaces of types.ts say it once
// more, for readers; where the two differ, this does not compile.
import { geometric, group, hints as hintTable } from '../../../core/edit/operators.json';
import type { GeometricStatement, GroupStatement, Statement } from './types';

type GeometricOperator = GeometricStatement['op'];
type GroupOperator = GroupStatement['op'];

/** Of a geometric operator: "origin" is a point, "direction", "axis" and "normal" are directions. */
export type OperatorFields = Readonly<Record<string, 'point' | 'direction'>>;

const fields = geometric satisfies Record<GeometricOperator, unknown>;
/** In the order of the table. */
export const geometricOperators: readonly GeometricOperator[] = Object.keys(fields) as (keyof typeof geometric)[];
export const groupOperators: readonly GroupOperator[] = Object.keys(group) as (keyof typeof group)[];
export const operators: readonly Statement['op'][] = [...geometricOperators, ...groupOperators, 'keep_fixed'];

/** Besides its part, feature and amount. */
export function fieldsOf(op: GeometricOperator): OperatorFields {
  return geometric[op].fields as unknown as OperatorFields;
}

/** The field of the one direction that a person chooses; a normal that goes with a direction follows from it. */
export const directionField = (fields: OperatorFields): 'direction' | 'axis' | 'normal' | undefined =>
  (['direction', 'axis', 'normal'] as const).find((field) => field in fields);

export const isGroupOperator = (op: string): op is GroupOperator => Object.hasOwn(group, op);

/** The kinds of edit that another part may be asked for. */
export const hints = Object.keys(hintTable) as (keyof typeof hintTable)[];
export type Hint = (typeof hints)[number];
