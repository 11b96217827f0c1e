// The gate: what a program from outside may be, and how quickly and by what name everything else is refused.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import { errorMessage, type ProgramError } from '../../web/src/program/types';
import { randomProgram, randomShape } from './random_program';

const shape = randomShape(3);
const row = shape.relations.find((relation) => relation.kind === 'translation')?.parts[0] ?? '';

type Json = Record<string, unknown>;
const statement = (fields: Json = {}): Json => ({
  op: 'translate',
  part: 'part_0',
  direction: [1, 0, 0],
  amount: 'x1',
  ...fields,
});
const layerOf = (statements: unknown, fields: Json = {}): Json => ({
  request: '',
  parameter: { name: 'x1', min: -1, max: 1, value: 0 },
  statements,
  ...fields,
});
const programOf = (layers: unknown, fields: Json = {}): Json => ({
  format: 'parsel/program',
  version: 1,
  shape: { name: 'any', sha256: '' },
  layers,
  ...fields,
});
const single = (fields: Json): Json => programOf([layerOf([statement(fields)])]);
const withAmount = (amount: unknown): Json => single({ amount });
const without = (key: string): Json => {
  const rest = statement();
  delete rest[key];
  return programOf([layerOf([rest])]);
};

function refusal(json: unknown): ProgramError {
  const result = checkProgram(json, shape);
  if (result.ok) throw new Error('it was accepted');
  expect(result.error.stage).toBe('program/check');
  expect(result.error.cause).not.toBe('');
  expect(result.error.fix).not.toBe('');
  return result.error;
}

describe('checkProgram accepts', () => {
  it('random programs, and changes nothing but defaults', () => {
    fc.assert(
      fc.property(fc.integer(), (seed) => {
        const program = randomProgram(shape, seed);
        const copy = structuredClone(program);
        const result = checkProgram(program, shape);
        expect(program).toEqual(copy);
        expect(result.ok && result.value.program).toEqual(program);
        expect(result.ok && result.value.program).not.toBe(program);
      }),
    );
  });

  it.each([
    'x1',
    'sqrt(1 - x1^2)',
    'sqrt(x1^2 - 2*x1 + 1)',
    'sqrt(x1^2 - 0.2*x1 + 0.01)',
    '1/(1.001 + x1)',
    'tan(1.5*x1)',
    '(x1^2)^0.5',
    'x1^0',
    'atan2(x1, x1)',
    'floor(x1/3)',
    '1/(x1^2 + 0.000001)',
  ])('the amount %s', (amount) => {
    const result = checkProgram(withAmount(amount), shape);
    expect(result.ok ? '' : errorMessage(result.error)).toBe('');
  });

  it('what is only half there: feature, anchor, reasons and reports have defaults', () => {
    const count = { op: 'change_count', relation: 't1', amount: 'x1', why: { kind: 'seed' } };
    const result = checkProgram(programOf([layerOf([statement(), count])]), shape);
    expect(result.ok && result.value.program.layers[0]?.statements).toMatchObject([
      { feature: [0, 0, 0] },
      { anchor: 'middle', why: { relations: [] } },
    ]);
  });
});

describe('checkProgram refuses', () => {
  const amount = '/layers/0/statements/0/amount';
  const first = '/layers/0/statements/0';
  const cases: [name: string, json: unknown, place: string, cause: RegExp][] = [
    ['null', null, '', /null/],
    ['a list', [], '', /"format" is missing/],
    ['a text', 'parsel/program', '', /parsel/],
    ['another format', programOf([], { format: 'gltf' }), '/format', /not a ParSEL program/],
    ['another version', programOf([], { version: 2 }), '/version', /version 2/],
    ['an unknown key', programOf([], { extra: 1 }), '/extra', /"extra" is unknown/],
    ['a missing key', programOf([{ request: '' }]), '/layers/0', /"parameter" is missing/],
    ['an unknown operator', single({ op: 'explode' }), `${first}/op`, /explode/],
    ['a field of another operator', single({ origin: [0, 0, 0] }), `${first}/origin`, /"origin" is unknown/],
    ['no direction', without('direction'), first, /"direction" is missing/],
    ['a direction without length', single({ direction: [0, 0, 1e-10] }), `${first}/direction`, /length/],
    ['a huge coordinate', single({ direction: [0, 0, 1e7] }), `${first}/direction/2`, /1000000/],
    ['a number that is infinite', single({ direction: [0, 0, Infinity] }), `${first}/direction/2`, /Infinity/],
    ['a number that is none', single({ direction: [0, 0, Number.NaN] }), `${first}/direction/2`, /NaN/],
    ['four coordinates', single({ direction: [0, 0, 1, 0] }), `${first}/direction/3`, /unknown/],
    ['a feature of 2', single({ feature: [0, 0, 2] }), `${first}/feature/2`, /2/],
    ['an unknown part', single({ part: 'wing' }), `${first}/part`, /"wing" is unknown/],
    ['an unknown node', single({ part: 'node:999' }), `${first}/part`, /unknown/],
    ['an unknown referenced part', single({ direction: { part: 'wing', axis: 0 } }), `${first}/direction/part`, /wing/],
    [
      'an unknown relation',
      programOf([layerOf([{ op: 'change_count', relation: 'r9', amount: 'x1' }])]),
      `${first}/relation`,
      /r9/,
    ],
    [
      'a relation that is no group',
      programOf([layerOf([{ op: 'change_delta', relation: 'r1', amount: 'x1' }])]),
      `${first}/relation`,
      /needs a group/,
    ],
    ['an unknown reason', single({ why: { kind: 'seed', relations: ['a9'] } }), `${first}/why/relations/0`, /a9/],
    [
      'an unknown report',
      programOf([layerOf([], { relations: [{ id: 'a9', status: 'held', worst: 0, proof: 'sampled' }] })]),
      '/layers/0/relations/0/id',
      /a9/,
    ],
    [
      'an amount of keep_fixed',
      programOf([layerOf([{ op: 'keep_fixed', part: 'part_0', amount: '0' }])]),
      `${first}/amount`,
      /unknown/,
    ],
    ['a number as amount', withAmount(1), amount, /1/],
    ['an amount that does not parse', withAmount('2*(x1'), `${amount}, column 6`, /ends/],
    ['an unknown parameter', withAmount('x2'), amount, /"x2"/],
    ['the root of a negative number', withAmount('sqrt(x1 + 0.5)'), `${amount}, column 1`, /root of a negative/],
    ['a fractional power of one', withAmount('x1^0.5'), `${amount}, column 3`, /root of a negative/],
    ['a division by zero', withAmount('1/x1'), `${amount}, column 2`, /division by zero/],
    [
      'a division by zero between any samples',
      withAmount('1/(x1 - 0.1234567)'),
      `${amount}, column 2`,
      /division by zero|larger/,
    ],
    ['a negative power of zero', withAmount('x1^-2'), `${amount}, column 3`, /division by zero/],
    ['a constant that is undefined', withAmount('x1 + 0*sqrt(-1)'), `${amount}, column 8`, /root/],
    ['0^0', withAmount('x1 + 0^0'), `${amount}, column 7`, /undefined/],
    ['a pole of tan', withAmount('tan(2*x1)'), `${amount}, column 1`, /infinite|larger/],
    ['what is near a pole', withAmount('tan(1.5707963*x1)'), `${amount}, column 1`, /larger than 1000000/],
    ['what overflows', withAmount('(1e300*(x1 + 2))^2'), `${amount}, column 17`, /infinite/],
    ['what is huge', withAmount('1e7*x1'), `${amount}, column 4`, /larger/],
    ['a hidden overflow', withAmount('min(1, 1e300*1e300)'), `${amount}, column 13`, /infinite/],
    [
      'a count beyond all need',
      programOf([layerOf([{ op: 'change_count', relation: 't1', amount: '2000*x1' }])]),
      `${amount}, column 5`,
      /larger than 1000/,
    ],
    [
      'an instance after a change of count',
      programOf([layerOf([{ op: 'change_count', relation: 't1', amount: 'x1' }, statement({ part: row })])]),
      '/layers/0/statements/1/part',
      /count has been changed/,
    ],
    [
      'a parameter named like a function',
      programOf([layerOf([], { parameter: { name: 'sin', min: 0, max: 1, value: 0 } })]),
      '/layers/0/parameter/name',
      /function/,
    ],
    ['the same parameter twice', programOf([layerOf([]), layerOf([])]), '/layers/1/parameter/name', /twice/],
    [
      'a range without 0',
      programOf([layerOf([], { parameter: { name: 'x1', min: 1, max: 2, value: 1 } })]),
      '/layers/0/parameter',
      /out of order/,
    ],
    [
      'a value out of range',
      programOf([layerOf([], { parameter: { name: 'x1', min: 0, max: 1, value: 2 } })]),
      '/layers/0/parameter',
      /out of order/,
    ],
    ['a long name', single({ part: 'x'.repeat(201) }), `${first}/part`, /200/],
    ['half a character', programOf([layerOf([], { request: '\ud800' })]), '/layers/0/request', /surrogates/],
    ['a class instance', programOf(new Map()), '/layers', /plain JSON/],
  ];
  it.each(cases)('%s', (_, json, place, cause) => {
    const error = refusal(json);
    expect(error.place).toBe(place);
    expect(error.cause).toMatch(cause);
  });

  it.each(['__proto__', 'constructor', 'prototype', 'toString', 'hasOwnProperty'])('the key %s, anywhere', (key) => {
    const evil = (place: string) =>
      JSON.parse(JSON.stringify(single({ here: 1 })).replace(place, `"${key}":{"polluted":1},${place}`));
    for (const place of ['"format"', '"request"', '"name"', '"op"', '"here"']) {
      expect(refusal(evil(place)).cause).toMatch(key === 'prototype' ? /unknown/ : /not allowed/);
    }
    expect(({} as Json).polluted).toBeUndefined();
  });

  it('a million statements, deep nesting and endless amounts, each at once', () => {
    const million = programOf([layerOf(Array.from({ length: 1e6 }, () => statement()))]);
    const deep = JSON.parse(`${'['.repeat(5000)}${']'.repeat(5000)}`) as unknown;
    const cyclic: Json = {};
    cyclic.self = cyclic;
    const wide = programOf(
      Array.from({ length: 100 }, (_, i) =>
        layerOf(
          Array.from({ length: 9999 }, () => statement()),
          { parameter: { name: `x${i}`, min: 0, max: 1, value: 0 } },
        ),
      ),
    );
    const many = programOf([
      layerOf(
        Array.from({ length: 10_000 }, (_, i) => statement({ amount: `${i}${'+sqrt(x1*x1 - x1)'.repeat(200)}` })),
      ),
    ]);
    for (const [json, cause] of [
      [million, /list of 1000000 items/],
      [programOf([deep]), /nested deeper/],
      [programOf([cyclic]), /nested deeper/],
      [wide, /more than 1000000 values/],
      [withAmount('('.repeat(1e6)), /1000000 characters/],
      [withAmount(`${'sin('.repeat(65)}x1${')'.repeat(65)}`), /too deeply/],
      [many, /root of a negative/],
      [
        programOf([
          layerOf(
            Array.from({ length: 9999 }, (_, i) =>
              statement({
                amount: `${i}*(${'0*(sqrt(x1^2 - 2*x1 + 1) + sqrt(x1^2)/(x1^2 - x1 + 0.2501)) + '.repeat(60)}1)`,
              }),
            ),
          ),
        ]),
        /too many or too long|larger/,
      ],
    ] as const) {
      const start = performance.now();
      expect(refusal(json).cause).toMatch(cause);
      expect(performance.now() - start).toBeLessThan(5000);
    }
  }, 60_000);

  it('any JSON at all without a throw', () => {
    fc.assert(
      fc.property(fc.jsonValue(), (json) => {
        expect(checkProgram(json, shape).ok).toBe(false);
      }),
      { numRuns: 300 },
    );
  });

  it('any single value of a program replaced, or accepts it as a program', () => {
    fc.assert(
      fc.property(fc.integer(), fc.nat(), fc.jsonValue(), (seed, index, junk) => {
        const json = JSON.parse(JSON.stringify(randomProgram(shape, seed, { layers: 2, statements: 3, amount: 0.2 })));
        const slots: [Json, string][] = [];
        const walk = (node: unknown): void => {
          if (typeof node !== 'object' || node === null) return;
          for (const key of Object.keys(node)) {
            slots.push([node as Json, key]);
            walk((node as Json)[key]);
          }
        };
        walk(json);
        const [owner, key] = slots[index % slots.length] ?? [json, 'format'];
        owner[key] = junk;
        const result = checkProgram(json, shape);
        if (!result.ok) expect(errorMessage(result.error)).toMatch(/^program\/check: /);
      }),
      { numRuns: 300 },
    );
  });
});
