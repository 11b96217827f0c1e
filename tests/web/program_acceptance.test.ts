// One rule for what is accepted and one for whole numbers: programs that are hard for both, through both.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import { compileProgram } from '../../web/src/program/compile';
import type { Program, Shape, Statement } from '../../web/src/program/types';
import { findBinary } from './binary';
import { type WrittenState, worstDifference, writeEvaluator } from './compare_states';
import { Random, randomShape } from './random_program';

const binary = findBinary();
if (!binary) process.stderr.write('skipped: no `parsel evaluate`; build the command-line tool or set PARSEL_CLI\n');

const shape = randomShape(1);

function programOf(statement: Statement, ...ranges: readonly [min: number, max: number][]): Program {
  const layers = ranges.map(([min, max], i) => ({
    request: '',
    parameter: { name: `x${i + 1}`, min, max, value: 0 },
    statements: i === ranges.length - 1 ? [statement] : [],
    relations: [],
  }));
  return { format: 'parsel/program', version: 1, shape: { name: shape.name, sha256: shape.sha256 }, layers };
}
const moving = (amount: string): Statement => ({
  op: 'translate',
  part: 'part_0',
  feature: [0, 0, 0],
  direction: [1, 0, 0],
  amount,
});
const counting = (amount: string): Statement => ({ op: 'change_count', relation: 't1', anchor: 'start', amount });

/** Texts over the whole grammar, from tame to absurd, of parameters x1 and x2. */
function randomAmount(random: Random, depth = 3): string {
  const numbers = [
    '0',
    '1',
    '2',
    '3',
    '0.05',
    '0.1',
    '1/3',
    '1e-9',
    '1e-12',
    '1e5',
    '0.5',
    '2.5',
    '1e-300',
    'pi',
    '1e308',
  ];
  if (depth === 0 || random.below(6) === 0) {
    return random.below(3) === 0 ? random.pick(numbers) : random.pick(['x1', 'x1', 'x2']);
  }
  const inner = () => randomAmount(random, depth - 1);
  const unary = ['sqrt', 'abs', 'floor', 'sin', 'cos', 'tan'];
  switch (random.below(9)) {
    case 0:
      return `${random.pick(unary)}(${inner()})`;
    case 1:
      return `${random.pick(['min', 'max', 'atan2'])}(${inner()}, ${inner()})`;
    case 2:
      return `(${inner()})^${random.pick(['2', '3', '-1', '0.5', '(1/3)', '1.5', '-2'])}`;
    case 3:
      return `(${inner()})/(${inner()})`;
    case 4:
      return `-(${inner()})`;
    default:
      return `(${inner()})${random.pick(['+', '-', '*'])}(${inner()})`;
  }
}

describe.skipIf(!binary)('C++ and the page', () => {
  const folder = mkdtempSync(join(tmpdir(), 'parsel-acceptance-'));
  afterAll(() => rmSync(folder, { recursive: true }));
  writeFileSync(join(folder, 'shape.json'), JSON.stringify(shape));

  /** The state, or why there is none. */
  function inCpp(program: Program, values: readonly number[]): WrittenState | string {
    writeFileSync(join(folder, 'program.json'), JSON.stringify(program));
    const settings = program.layers.flatMap(({ parameter }, i) => ['--set', `${parameter.name}=${values[i]}`]);
    const files = [join(folder, 'shape.json'), join(folder, 'program.json')];
    try {
      const output = execFileSync(binary ?? '', ['evaluate', ...files, ...settings], {
        encoding: 'utf8',
        stdio: ['ignore', 'pipe', 'pipe'],
        maxBuffer: 1 << 28,
      });
      return JSON.parse(output) as WrittenState;
    } catch (thrown) {
      return (thrown as { stderr: string }).stderr;
    }
  }
  function inPage(program: Program, of: Shape, values: readonly number[]): WrittenState | string {
    const checked = checkProgram(program, of);
    if (!checked.ok) return checked.error.cause;
    const evaluator = compileProgram(checked.value, of);
    evaluator.evaluate(values);
    return writeEvaluator(evaluator, of);
  }
  /** Both refuse, or both give the same to `tolerance`; whether they accept. */
  function expectEqual(program: Program, values: readonly number[], tolerance = 1e-9): boolean {
    const text = program.layers.at(-1)?.statements.map((statement) => 'amount' in statement && statement.amount);
    const place = `${text} over ${program.layers.map(({ parameter }) => [parameter.min, parameter.max])} at ${values}`;
    const [cpp, page] = [inCpp(program, values), inPage(program, shape, values)];
    if (typeof cpp === 'string' || typeof page === 'string') {
      expect(
        typeof page,
        `${place}: C++ ${JSON.stringify(cpp).slice(0, 300)}, page ${JSON.stringify(page).slice(0, 300)}`,
      ).toBe(typeof cpp);
      return false;
    }
    const { worst, place: part } = worstDifference(page, cpp);
    expect(worst, `${place}, ${part}`).toBeLessThanOrEqual(tolerance);
    return true;
  }

  it('count alike at and around every multiple, at the ends and at 0', { timeout: 300_000 }, () => {
    for (const amount of ['x1/0.05', 'floor(x1/0.05)', '20*x1']) {
      const program = programOf(counting(amount), [-0.1, 0.5]);
      for (let k = -2; k <= 10; ++k) {
        const marks = [k * 0.05, Number((k * 0.05).toFixed(2)), k / 20];
        for (const x of [...new Set(marks)]) {
          const near = [x, x - 2e-10, x * (1 + 2 ** -52), x - 1e-7, x + 1e-7].filter((v) => v >= -0.1 && v <= 0.5);
          for (const value of near) expect(expectEqual(program, [value])).toBe(true);
        }
        const state = inPage(program, shape, [Math.min(0.5, Number((k * 0.05).toFixed(2)))]) as WrittenState;
        const atRest = inPage(program, shape, [0]) as WrittenState;
        const count = (of: WrittenState) => Object.values(of.groups)[0]?.instances.length ?? 0;
        expect(count(state), `${amount} at ${k} marks`).toBe(Math.max(1, count(atRest) + k));
      }
    }
  });

  it.each([
    ['1e-9/(x1-1/3)', false],
    ['1e-9/(x1-0.123456789)', false],
    ['1e-9/(x1-1/3)^2', false],
    ['x1/x1', false],
    ['sin(x1)/x1', false],
    ['(x1-0.1)/(x1*x1-0.01)', false],
    ['1e-12*tan(pi*x1/0.6)', false],
    ['0*x1^-1', false],
    ['1/(x1-x2)', false],
    ['1e7*x1', false],
    ['1e-9/((x1-1/3)^2+1e-12)', true],
    ['1/(x1*x1+1e-6)', true],
    ['sqrt(x1*x1)', true],
    ['sqrt((x1-0.1)*(x1-0.1))', true],
    ['(x1+1)^x1', true],
    ['atan2(x1, -1)', true],
    ['atan2(x1-x1, -1)', true],
    ['1e-308*x1/100', true],
    ['1e-300*x1*1e-300/1e-300', true],
  ] as const)('%s over ±0.35: %s', (amount, accepted) => {
    const two = amount.includes('x2');
    const program = two
      ? programOf(moving(amount), [-0.35, 0.35], [-0.35, 0.35])
      : programOf(moving(amount), [-0.35, 0.35]);
    for (const x of [-0.35, 0, 0.1, 0.3, 0.35, 5e-324, -0]) {
      expect(expectEqual(program, two ? [x, 0.2] : [x])).toBe(accepted);
    }
  });

  it('a count of more than a thousand is refused', () => {
    expect(expectEqual(programOf(counting('3000*x1'), [0, 0.5]), [0.1])).toBe(false);
    expect(expectEqual(programOf(counting('1000*x1'), [0, 1]), [0.1])).toBe(true);
  });

  it('accept the same of 600 random programs, and move alike', { timeout: 600_000 }, () => {
    const random = new Random(7);
    let accepted = 0;
    for (let i = 0; i < 600; ++i) {
      const range = (): [number, number] => {
        const size = random.pick([1e-6, 0.35, 1, 10, 1000, 1e5]);
        return [-size * random.pick([0, 0.5, 1]), size];
      };
      const ranges = [range(), range()] as const;
      const amount = randomAmount(random, 1 + random.below(3));
      const statement = random.below(5) === 0 ? counting(amount) : moving(amount);
      const values = ranges.map(([min, max]) => random.pick([0, min, max, random.uniform(min, max)]));
      // Amounts go up to 1e6, where the last place is 1e-10, and what a quotient amplifies more.
      if (expectEqual(programOf(statement, ...ranges), values, 1e-6)) accepted += 1;
    }
    expect(accepted).toBeGreaterThan(200);
    expect(accepted).toBeLessThan(550);
  });
});
