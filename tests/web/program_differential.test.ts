// The TypeScript evaluator against the C++ one on random programs, through `parsel evaluate`.
import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import { compileProgram } from '../../web/src/program/compile';
import type { Shape } from '../../web/src/program/types';
import { findBinary } from './binary';
import { type WrittenState, worstDifference, writeEvaluator } from './compare_states';
import { Random, randomProgram, randomShape, randomValues } from './random_program';

const binary = findBinary();
if (!binary) process.stderr.write('skipped: no `parsel evaluate`; build the command-line tool or set PARSEL_CLI\n');

describe.skipIf(!binary)('random programs in C++ and TypeScript', () => {
  const folder = mkdtempSync(join(tmpdir(), 'parsel-differential-'));
  afterAll(() => rmSync(folder, { recursive: true }));

  function evaluateInCpp(shape: Shape, program: unknown, settings: readonly string[]): WrittenState {
    const files = [join(folder, 'shape.json'), join(folder, 'program.json')] as const;
    writeFileSync(files[0], JSON.stringify(shape));
    writeFileSync(files[1], JSON.stringify(program));
    const options = settings.flatMap((setting) => ['--set', setting]);
    const output = execFileSync(binary ?? '', ['evaluate', ...files, ...options], { encoding: 'utf8' });
    return JSON.parse(output) as WrittenState;
  }

  it.each(Array.from({ length: 25 }, (_, seed) => seed))('seed %d', (seed) => {
    const shape = randomShape(1000 + seed);
    const program = randomProgram(shape, seed);
    const values = randomValues(program, new Random(seed));
    const checked = checkProgram(program, shape);
    if (!checked.ok) throw new Error(`${checked.error.place}: ${checked.error.cause}`);
    const evaluator = compileProgram(checked.value, shape);
    evaluator.evaluate(values);
    const settings = program.layers.map(({ parameter }, i) => `${parameter.name}=${values[i]}`);
    const expected = evaluateInCpp(shape, program, settings);
    expect(Object.keys(expected.parts).length).toBeGreaterThan(0);
    const { worst, place } = worstDifference(writeEvaluator(evaluator, shape), expected);
    expect(worst, place).toBeLessThanOrEqual(1e-9);
  });
});
