// The amount grammar: what it accepts, what it refuses and where, and that printing and parsing are inverses.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { compileAmount } from '../../web/src/program/compile';
import { evaluateExpression } from '../../web/src/program/interpret_amount';
import { type Expression, functionNames, isParameterName, parseAmount } from '../../web/src/program/parse';
import { amountText } from '../../web/src/program/text';
import { Random, randomAmount } from './random_program';

function parse(text: string): Expression {
  const parsed = parseAmount(text);
  if (!parsed.ok) throw new Error(`${text}: ${parsed.error.place}: ${parsed.error.cause}`);
  return parsed.value;
}
function evaluate(text: string, values: Record<string, number> = {}): number {
  return evaluateExpression(parse(text), new Map(Object.entries(values)));
}
/** The tree without columns, which printing does not keep. */
function bare(expression: Expression): unknown {
  return JSON.parse(JSON.stringify(expression, (key, value) => (key === 'column' ? undefined : value)));
}

const { expressions } = fc.letrec<{ expressions: Expression; leaf: Expression }>((tie) => ({
  leaf: fc.oneof(
    fc.double({ min: 1e-300, max: 1e6, noNaN: true }).map((value) => ({ kind: 'number', value, column: 0 }) as const),
    fc.constantFrom('x1', 'x2', 'seat_width').map((name) => ({ kind: 'parameter', name, column: 0 }) as const),
  ),
  expressions: fc.oneof(
    { depthSize: 'small', withCrossShrink: true },
    tie('leaf'),
    fc.record({ kind: fc.constant('negate' as const), operand: tie('expressions'), column: fc.constant(0) }),
    fc.record({
      kind: fc.constant('binary' as const),
      op: fc.constantFrom('+' as const, '-' as const, '*' as const, '/' as const, '^' as const),
      left: tie('expressions'),
      right: tie('expressions'),
      column: fc.constant(0),
    }),
    fc
      .tuple(fc.constantFrom(...functionNames), tie('expressions'), tie('expressions'))
      .map(([name, a, b]): Expression => {
        const pair = name === 'atan2' || name === 'min' || name === 'max';
        return { kind: 'call', name, arguments: pair ? [a, b] : [a], column: 0 };
      }),
  ),
}));

describe('parseAmount', () => {
  it.each([
    ['-2^2', -4],
    ['2^-1', 0.5],
    ['2^3^2', 512],
    ['-2^-2', -0.25],
    ['8/2/2', 2],
    ['1-2-3', -4],
    ['2*-3', -6],
    ['--3', 3],
    ['1 - -1', 2],
    ['min(3, 1, 2)', 1],
    ['atan2(1, -1)', (3 * Math.PI) / 4],
    ['sqrt(-1e-13)', 0],
    ['floor(-0.5)', -1],
  ])('%s = %d', (text, value) => {
    expect(evaluate(text)).toBeCloseTo(value, 12);
    expect(compileAmount(parse(text), [])([])).toBeCloseTo(value, 12);
  });

  it('reads back what it prints, with the fewest parentheses that keep the tree', () => {
    fc.assert(
      fc.property(expressions, (tree) => {
        expect(bare(parse(amountText(tree)))).toEqual(bare(tree));
      }),
    );
  });

  it('never throws, and names a column inside the text or just after it', () => {
    const characters = fc.constantFrom(...'0123456789.eE+-*/^(), \tx1_pisqrtZ$é', 'min', 'atan2(', '((', '))');
    fc.assert(
      fc.property(fc.string({ unit: characters, maxLength: 40 }), (text) => {
        const parsed = parseAmount(text);
        if (parsed.ok) return;
        const column = Number(/^column (\d+)$/.exec(parsed.error.place)?.[1]);
        expect(column).toBeGreaterThanOrEqual(1);
        expect(column).toBeLessThanOrEqual(text.length + 1);
        expect(parsed.error.fix).not.toBe('');
      }),
      { numRuns: 1000 },
    );
  });

  it('evaluates alike as closures and by interpretation', () => {
    fc.assert(
      fc.property(fc.integer(), (seed) => {
        const random = new Random(seed);
        const expression = parse(randomAmount(random, ['x1', 'x2'], 1));
        const values = [random.uniform(-1, 1), random.uniform(-1, 1)];
        const oracle = evaluateExpression(
          expression,
          new Map([
            ['x1', values[0] ?? 0],
            ['x2', values[1] ?? 0],
          ]),
        );
        expect(compileAmount(expression, ['x1', 'x2'])(values)).toBeCloseTo(oracle, 12);
      }),
    );
  });

  it('refuses a million parentheses at once', () => {
    const start = performance.now();
    for (const text of [
      '('.repeat(1e6),
      '-'.repeat(1e6),
      `${'sin('.repeat(1000)}x1`,
      '('.repeat(4096),
      '2^'.repeat(2000),
    ]) {
      expect(parseAmount(text).ok).toBe(false);
    }
    expect(performance.now() - start).toBeLessThan(500);
  });

  it('accepts 64 levels and the longest sum', () => {
    expect(evaluate(`${'('.repeat(64)}1${')'.repeat(64)}`)).toBe(1);
    expect(evaluate(`${'1+'.repeat(2047)}1`)).toBe(2048);
  });
});

describe('isParameterName', () => {
  it.each(['x1', 'a', 'seat_width', 'pie', 'sine'])('accepts %s', (name) => expect(isParameterName(name)).toBe(true));
  it.each(['', 'X', '1x', '_x', 'pi', 'sqrt', 'x-y', '__proto__', 'x '])('refuses "%s"', (name) =>
    expect(isParameterName(name)).toBe(false),
  );
});
