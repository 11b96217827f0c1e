// What the core writes the page reads: their limits are the same numbers.
import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { checkProgram } from '../../web/src/program/check';
import { limits } from '../../web/src/program/schema';
import { programText } from '../../web/src/program/text';
import { maxTextLength, parseProgramText } from '../../web/src/program/text_parse';
import type { Program, RelationReport } from '../../web/src/program/types';
import { twoBoxes } from './box_shapes';

const header = readFileSync(fileURLToPath(new URL('../../core/edit/program.h', import.meta.url)), 'utf8');
/** The constant of that name in ProgramLimits. */
const inCore = (name: string) => {
  const found = new RegExp(`\\b${name} = ([\\d'.e]+);`).exec(header);
  return Number(found?.[1]?.replaceAll("'", ''));
};

describe('limits of programs', () => {
  it.each([
    ['layers', limits.layers],
    ['statements', limits.statements],
    ['reports', limits.reports],
    ['why_relations', limits.reasons],
    ['name_bytes', limits.nameLength],
    ['request_bytes', limits.requestLength],
    ['parameter_bytes', limits.parameterLength],
    ['coordinate', limits.coordinate],
    ['text_bytes', maxTextLength],
  ])('%s is the same in the core and on the page', (name, value) => {
    expect(inCore(name)).toBe(value);
  });

  it('a layer with as many reports as the core writes is read, as JSON and as text, and no longer one', () => {
    const report: RelationReport = { id: 'a1', status: 'held', worst: 0.012345678901234, proof: 'certified' };
    const program = (reports: number): Program => ({
      format: 'parsel/program',
      version: 1,
      shape: { name: 'boxes', sha256: '' },
      layers: [
        {
          request: '',
          parameter: { name: 'x1', min: -0.35, max: 0.35, value: 0 },
          statements: [],
          relations: Array.from({ length: reports }, () => report),
        },
      ],
    });
    expect(checkProgram(program(limits.reports), twoBoxes).ok).toBe(true);
    expect(checkProgram(program(limits.reports + 1), twoBoxes).ok).toBe(false);
    const text = programText(program(limits.reports));
    expect(parseProgramText(text).ok).toBe(true);
    expect(parseProgramText(`${text}  relation "a1": held, worst 0, certified\n`).ok).toBe(false);
  }, 60_000); // four times a hundred thousand reports
});
