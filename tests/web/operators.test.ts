// The table of operators (core/edit/operators.json) and what the page makes of it.

import * as v from 'valibot';
import { describe, expect, it } from 'vitest';
import { geometric } from '../../core/edit/operators.json';
import { fieldsOf, geometricOperators, groupOperators, hints, operators } from '../../web/src/program/operators';
import { layerSchema } from '../../web/src/program/schema';
import type { GeometricStatement } from '../../web/src/program/types';

type Operator = GeometricStatement['op'];
type Said<Op extends Operator> = Exclude<
  keyof Extract<GeometricStatement, { op: Op }>,
  'op' | 'part' | 'feature' | 'amount' | 'why'
>;
type Tabled<Op extends Operator> = keyof (typeof geometric)[Op]['fields'];
type Same<A, B> = [A] extends [B] ? ([B] extends [A] ? true : false) : false;
/** Operators whose fields types.ts and the table say differently. */
type Differing = { [Op in Operator]: Same<Said<Op>, Tabled<Op>> extends true ? never : Op }[Operator];
const differing: Record<Differing, true> = {}; // does not compile when there is one

const reads = (statement: unknown) =>
  v.safeParse(layerSchema, {
    request: '',
    parameter: { name: 'x', min: 0, max: 1, value: 0 },
    statements: [statement],
  }).success;
const given = { point: { part: 'seat', at: [0, 1, 0] }, direction: [0, 1, 0] };
const statementOf = (op: Operator): Record<string, unknown> => ({
  op,
  part: 'seat',
  amount: 'x',
  ...Object.fromEntries(Object.entries(fieldsOf(op)).map(([field, kind]) => [field, given[kind]])),
});

describe('the table of operators', () => {
  it('says of each operator the fields that its type has', () => expect(differing).toEqual({}));

  it('holds every operator once', () => {
    expect(new Set(operators).size).toBe(operators.length);
    expect(operators).toEqual([...geometricOperators, ...groupOperators, 'keep_fixed']);
  });

  it.each(geometricOperators)('makes a schema that wants each field of %s and no other', (op) => {
    const whole = statementOf(op);
    expect(reads(whole)).toBe(true);
    for (const field of Object.keys(fieldsOf(op))) {
      const { [field]: _, ...without } = whole;
      expect(reads(without), `without ${field}`).toBe(false);
      expect(reads({ ...whole, [field]: 'up' }), `with a word as ${field}`).toBe(false);
    }
    for (const other of ['origin', 'direction', 'axis', 'normal'].filter((field) => !(field in fieldsOf(op))))
      expect(reads({ ...whole, [other]: other === 'origin' ? given.point : given.direction }), `with ${other}`).toBe(
        false,
      );
  });

  it('names a hint for every operator', () => {
    for (const op of geometricOperators) expect(hints).toContain(geometric[op].hint);
  });
});
