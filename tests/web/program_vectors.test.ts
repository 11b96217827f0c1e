// The vectors that the C++ evaluator is held to as well.
import { readFileSync } from 'node:fs';
import { describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import { compileAmount, compileProgram } from '../../web/src/program/compile';
import { interpretProgram } from '../../web/src/program/interpret';
import { evaluateExpression } from '../../web/src/program/interpret_amount';
import { parseAmount } from '../../web/src/program/parse';
import type { Shape } from '../../web/src/program/types';
import { type WrittenState, worstDifference, writeEvaluator, writeState } from './compare_states';

interface ExpressionVectors {
  cases: { text: string; values: Record<string, number>; value: number | null }[];
  errors: { text: string; column: number }[];
}
interface ProgramVectors {
  shapes: Record<string, Shape>;
  cases: { name: string; shape: string; program: unknown; samples: (WrittenState & { values: number[] })[] }[];
}

function read<T>(name: string): T {
  return JSON.parse(readFileSync(new URL(`../golden/${name}`, import.meta.url), 'utf8')) as T;
}

describe('expression vectors', () => {
  const vectors = read<ExpressionVectors>('expression_vectors.json');

  it.each(vectors.cases.map((item) => [item.text.slice(0, 60), item] as const))('%s', (_, { text, values, value }) => {
    const parsed = parseAmount(text);
    if (!parsed.ok) {
      expect(value).toBeNull();
      return;
    }
    const names = Object.keys(values);
    const closure = compileAmount(parsed.value, names)(Object.values(values));
    const oracle = evaluateExpression(parsed.value, new Map(Object.entries(values)));
    const tolerance = 1e-9 * Math.max(1, Math.abs(value ?? 0));
    for (const result of [closure, oracle]) {
      if (value === null) expect(result).toBeNaN();
      else expect(Math.abs(result - value)).toBeLessThanOrEqual(tolerance);
    }
  });

  it.each(vectors.errors.map((item) => [item.text.slice(0, 60), item] as const))(
    'refuses %s',
    (_, { text, column }) => {
      const parsed = parseAmount(text);
      expect(parsed.ok ? 'accepted' : parsed.error.place).toBe(`column ${column}`);
    },
  );
});

describe('program vectors', () => {
  const vectors = read<ProgramVectors>('program_vectors.json');

  it.each(vectors.cases.map((item) => [item.name, item] as const))('%s', (_, { shape: name, program, samples }) => {
    const shape = vectors.shapes[name] as Shape;
    const checked = checkProgram(program, shape);
    if (!checked.ok) throw new Error(`${checked.error.place}: ${checked.error.cause}`);
    const evaluator = compileProgram(checked.value, shape);
    for (const sample of samples) {
      const expected = { parts: sample.parts, groups: sample.groups };
      evaluator.evaluate(sample.values);
      const closures = worstDifference(writeEvaluator(evaluator, shape), expected);
      expect(closures.worst, closures.place).toBeLessThanOrEqual(1e-9);
      const oracle = worstDifference(
        writeState(interpretProgram(checked.value, shape, sample.values), shape),
        expected,
      );
      expect(oracle.worst, oracle.place).toBeLessThanOrEqual(1e-9);
    }
  });
});
