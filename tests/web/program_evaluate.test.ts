// Random programs: the closures and the interpreter share no evaluation code and must agree.
import fc from 'fast-check';
import { describe, expect, it } from 'vitest';
import { type CheckedProgram, checkProgram } from '../../web/src/program/check';
import { compileProgram } from '../../web/src/program/compile';
import { interpretProgram } from '../../web/src/program/interpret';
import type { Program, Shape } from '../../web/src/program/types';
import { worstDifference, writeEvaluator, writeState } from './compare_states';
import { Random, randomProgram, randomShape, randomValues } from './random_program';

function check(program: unknown, shape: Shape): CheckedProgram {
  const checked = checkProgram(program, shape);
  if (!checked.ok) throw new Error(`${checked.error.place}: ${checked.error.cause}`);
  return checked.value;
}
const seed = fc.integer({ min: 0, max: 2 ** 31 - 1 });

describe('random programs', () => {
  it('evaluate alike in both evaluators, whatever was evaluated before', () => {
    fc.assert(
      fc.property(seed, seed, (shapeSeed, programSeed) => {
        const shape = randomShape(shapeSeed);
        const program = check(randomProgram(shape, programSeed), shape);
        const evaluator = compileProgram(program, shape);
        const random = new Random(programSeed);
        for (let i = 0; i < 2; ++i) {
          const values = randomValues(program.program, random);
          evaluator.evaluate(values);
          const expected = writeState(interpretProgram(program, shape, values), shape);
          const { worst, place } = worstDifference(writeEvaluator(evaluator, shape), expected);
          expect(worst, place).toBeLessThanOrEqual(1e-9);
        }
      }),
      { numRuns: 100 },
    );
  }, 30_000);

  it('move only the parts that the evaluator names', () => {
    fc.assert(
      fc.property(seed, (programSeed) => {
        const shape = randomShape(7);
        const program = check(randomProgram(shape, programSeed, { layers: 1, statements: 2, amount: 0.25 }), shape);
        const evaluator = compileProgram(program, shape);
        const rest = evaluator.corners.slice();
        evaluator.evaluate([0.7]);
        for (const [part] of shape.parts.entries()) {
          const range = [24 * part, 24 * part + 24] as const;
          if (evaluator.movingParts.includes(part)) continue;
          expect(evaluator.corners.slice(...range)).toEqual(rest.slice(...range));
        }
      }),
      { numRuns: 100 },
    );
  });
});

describe('at rest', () => {
  it('amounts of zero leave every corner bit for bit where it was', () => {
    fc.assert(
      fc.property(seed, seed, (shapeSeed, programSeed) => {
        const shape = randomShape(shapeSeed);
        const program = randomProgram(shape, programSeed);
        // x1 - x1 is 0 at run time, but no constant that the compiler could leave out.
        const stilled: Program = {
          ...program,
          layers: program.layers.map((layer) => ({
            ...layer,
            statements: layer.statements.map((item) => ('amount' in item ? { ...item, amount: 'x1 - x1' } : item)),
          })),
        };
        const evaluator = compileProgram(check(stilled, shape), shape);
        const rest = evaluator.corners.slice();
        evaluator.evaluate([0.5, 0.25, -0.5]);
        expect(evaluator.corners).toEqual(rest);
        for (const group of evaluator.groups) expect(group?.source ?? -1).toBe(-1);
      }),
      { numRuns: 50 },
    );
  });

  it('an amount that is not finite moves nothing', () => {
    const shape = randomShape(1);
    const statement = { op: 'translate', part: 'part_0', direction: [1, 0, 0], amount: 'sqrt(x1)' };
    const layer = { request: '', parameter: { name: 'x1', min: 0, max: 1, value: 0 }, statements: [statement] };
    const shapeName = { name: '', sha256: '' };
    const program = check({ format: 'parsel/program', version: 1, shape: shapeName, layers: [layer] }, shape);
    const evaluator = compileProgram(program, shape);
    const rest = evaluator.corners.slice();
    evaluator.evaluate([-1]);
    expect(evaluator.corners).toEqual(rest);
  });
});
