// Text that somebody typed, read and checked, with every refusal placed in the text itself.
import { type CheckedProgram, checkProgram } from './check';
import { parseProgramText } from './text_parse';
import type { ProgramError, Result, Shape } from './types';

/** A refusal with the place in words and as line and column, 1-based. */
export interface TextError extends ProgramError {
  readonly line: number;
  readonly column: number;
}

export function checkProgramText(
  text: string,
  shape: Shape,
): Result<CheckedProgram> | { readonly ok: false; readonly error: TextError } {
  const parsed = parseProgramText(text);
  const checked = parsed.ok ? checkProgram(parsed.value, shape) : parsed;
  if (checked.ok) return checked;
  const { line, column } = parsed.ok ? locate(text, checked.error.place) : readPlace(checked.error.place);
  return { ok: false, error: { ...checked.error, place: `line ${line}, column ${column}`, line, column } };
}

function readPlace(place: string): { line: number; column: number } {
  const [line = 1, column = 1] = (place.match(/\d+/g) ?? []).map(Number);
  return { line, column };
}

/** Where a place of checkProgram(), "/layers/0/statements/3/amount, column 5", stands in the text. */
function locate(text: string, place: string): { line: number; column: number } {
  const [pointer = '', within] = place.split(', column ');
  const [layer, list, item, field = list === 'parameter' ? item : undefined] = pointer.split('/').slice(2);
  const line = lineOf(text, Number(layer), list ?? '', Number(item));
  const content = text.split('\n')[line - 1] ?? '';
  const named = field === 'amount' ? content.indexOf('amount=') + 'amount='.length : content.indexOf(`${field}=`);
  const start = field === 'part' || field === 'relation' ? content.indexOf('"') : named;
  const indent = content.length - content.trimStart().length;
  return { line, column: (start < 0 ? indent : start) + (within === undefined ? 1 : Number(within)) };
}

function lineOf(text: string, layer: number, list: string, item: number): number {
  const counts = { statements: -1, relations: -1 };
  let [entries, layers, last] = [0, -1, 1];
  for (const [i, content] of text.split('\n').entries()) {
    const word = /^\s*(\w+)/.exec(content)?.[1];
    if (word === undefined) continue;
    entries += 1;
    if (entries <= 2) continue; // what it is, and of which shape
    if (word === 'layer') {
      layers += 1;
      if (layers === layer) last = i + 1;
      counts.statements = counts.relations = -1;
      continue;
    }
    const kind = word === 'relation' ? 'relations' : 'statements';
    counts[kind] += 1;
    if (layers === layer && kind === list && counts[kind] === item) return i + 1;
  }
  return last;
}
