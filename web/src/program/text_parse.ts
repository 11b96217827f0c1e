// Reads the text form of programs (see text.ts) into the JSON form, which check.ts then judges: only the form of the text
// is decided here, not what it means. The C++ reader is core/edit/program_text_read.cpp.
import { isGroupOperator, operators } from './operators';
import { limits } from './schema';
import type { Result } from './types';

/** Longest text, in characters. */
export const maxTextLength = 8 * 1024 * 1024;

/** Text → JSON for checkProgram(). Errors have the place "line L, column C", 1-based. */
export function parseProgramText(text: string): Result<unknown> {
  if (text.length > maxTextLength) return refusal(1, 1, 'the text is longer than 8 MiB', 'split the program');
  const reader = new Reader();
  let number = 0;
  for (const whole of text.split('\n')) {
    number += 1;
    const line = new Line(whole);
    if (line.ended()) continue;
    try {
      reader.read(line);
    } catch (thrown) {
      if (!(thrown instanceof TextProblem)) throw thrown;
      return refusal(number, thrown.at + 1, thrown.message, thrown.fix);
    }
  }
  const program = reader.finish();
  if (program) return { ok: true, value: program };
  return refusal(
    number,
    1,
    'the text ends before its shape',
    'start with "parsel program 1", then shape "name" "sha256"',
  );
}

function refusal(line: number, column: number, cause: string, fix: string): Result<never> {
  return { ok: false, error: { stage: 'program/text', place: `line ${line}, column ${column}`, cause, fix } };
}

/** Unwinds the reader of a line; never leaves this file. */
class TextProblem extends Error {
  constructor(
    readonly at: number,
    cause: string,
    readonly fix: string,
  ) {
    super(cause);
  }
}

/** Tokens of one line. */
class Line {
  private position = 0;

  constructor(private readonly text: string) {}

  fail(at: number, cause: string, fix: string): never {
    throw new TextProblem(at, cause, fix);
  }

  /** Where the next token starts. */
  at(): number {
    while (' \t\r'.includes(this.text[this.position] ?? '.')) this.position += 1;
    return this.position;
  }

  /** Nothing but blanks or a comment is left. */
  ended(): boolean {
    return this.at() === this.text.length || this.text[this.position] === '#';
  }

  take(character: string): boolean {
    if (this.text[this.at()] !== character) return false;
    this.position += 1;
    return true;
  }

  expect(character: string): void {
    if (!this.take(character)) this.fail(this.at(), `"${character}" is missing here`, 'insert it');
  }

  /** A run of letters, digits and _; empty when there is none. */
  word(): string {
    return this.match(/[A-Za-z0-9_]*/y) ?? '';
  }

  expectWord(wanted: string): void {
    const at = this.at();
    if (this.word() !== wanted) this.fail(at, `"${wanted}" is missing here`, 'insert it');
  }

  number(): number {
    const at = this.at();
    const token = this.match(/[-+.0-9eE]+/y) ?? '';
    if (token === '' || !Number.isFinite(Number(token)))
      this.fail(at, 'there should be a number', 'write one, as in -0.35');
    return Number(token);
  }

  /** Numbers in parentheses, or without when `open` has been taken before. */
  numbers(count: number): number[] {
    const list = [this.number()];
    while (list.length < count) {
      this.expect(',');
      list.push(this.number());
    }
    this.expect(')');
    return list;
  }

  string(): string {
    const at = this.at();
    const token = this.match(/"(?:[^"\\]|\\.)*"/y);
    try {
      if (token !== null) return JSON.parse(token) as string;
    } catch {
      // An unknown escape or a control character: refused below.
    }
    return this.fail(at, 'there should be a name in double quotes, as in JSON', 'write it as in "seat"');
  }

  /** Up to the "," or ")" that ends the field; parentheses inside are matched. */
  amount(): string {
    const start = this.at();
    let open = 0;
    for (; this.position < this.text.length && this.text[this.position] !== '#'; ++this.position) {
      const character = this.text[this.position] ?? '';
      if (open === 0 && (character === ',' || character === ')')) break;
      if (character === '(') open += 1;
      if (character === ')') open -= 1;
    }
    return this.text.slice(start, this.position).trim();
  }

  private match(pattern: RegExp): string | null {
    pattern.lastIndex = this.at();
    const found = pattern.exec(this.text)?.[0] ?? null;
    if (found !== null) this.position += found.length;
    return found;
  }
}

type Fields = Record<string, unknown>;

class Reader {
  private lines = 0;
  private statements = 0;
  private shape: Fields = {};
  private readonly layers: { request: string; parameter: Fields; statements: Fields[]; relations: Fields[] }[] = [];

  /** One line that is not blank. */
  read(line: Line): void {
    if (this.lines === 0) this.header(line);
    else if (this.lines === 1) this.readShape(line);
    else this.entry(line);
    if (!line.ended())
      line.fail(line.at(), 'there should be nothing more on this line', 'remove it or put # before it');
    this.lines += 1;
  }

  finish(): Fields | null {
    if (this.lines < 2) return null;
    return { format: 'parsel/program', version: 1, shape: this.shape, layers: this.layers };
  }

  private header(line: Line): void {
    const at = line.at();
    if (line.word() !== 'parsel' || line.word() !== 'program') {
      line.fail(at, 'this is not the text of a program', 'start with "parsel program 1"');
    }
    const versionAt = line.at();
    if (line.number() !== 1) line.fail(versionAt, 'this version is unknown', 'use version 1, or a newer ParSEL');
  }

  private readShape(line: Line): void {
    line.expectWord('shape');
    this.shape = { name: line.string(), sha256: line.string() };
  }

  private entry(line: Line): void {
    const at = line.at();
    const word = line.word();
    const layer = this.layers.at(-1);
    if (word === 'layer') {
      if (this.layers.length === limits.layers) line.fail(at, `more than ${limits.layers} layers`, 'split the program');
      this.layers.push(this.layer(line));
    } else if (word !== 'relation' && !(operators as readonly string[]).includes(word)) {
      line.fail(at, `"${word}" is no operator`, `start the line with layer, relation, ${operators.join(', ')}`);
    } else if (!layer) {
      line.fail(at, 'a layer must come first', 'write layer "…": x1 = 0 in [-0.35, 0.35]');
    } else if (word === 'relation') {
      if (layer.relations.length === limits.reports)
        line.fail(at, `more than ${limits.reports} reports`, 'remove some');
      layer.relations.push(this.report(line));
    } else {
      this.statements += 1;
      if (this.statements > limits.statements) {
        line.fail(at, `more than ${limits.statements} statements`, 'split the program');
      }
      layer.statements.push(this.statement(line, word));
    }
  }

  private layer(line: Line): (typeof this.layers)[number] {
    const request = line.string();
    line.expect(':');
    const name = line.word();
    line.expect('=');
    const value = line.number();
    line.expectWord('in');
    line.expect('[');
    const min = line.number();
    line.expect(',');
    const max = line.number();
    line.expect(']');
    return { request, parameter: { name, min, max, value }, statements: [], relations: [] };
  }

  private report(line: Line): Fields {
    const id = line.string();
    line.expect(':');
    const status = line.word();
    line.expect(',');
    line.expectWord('worst');
    const worst = line.number();
    line.expect(',');
    const proof = line.word();
    if (line.ended()) return { id, status, worst, proof };
    line.expectWord('at');
    return { id, status, worst, proof, samples: line.number() };
  }

  /** Fields that the operator does not take are left to the schema, which refuses them by name. */
  private statement(line: Line, op: string): Fields {
    line.expect('(');
    const fields: Fields = { op, [isGroupOperator(op) ? 'relation' : 'part']: line.string() };
    while (line.take(',')) {
      const at = line.at();
      const key = line.word();
      if (Object.hasOwn(fields, key)) line.fail(at, `"${key}" is given twice`, 'remove one');
      line.expect('=');
      fields[key] = this.field(line, key, at);
    }
    line.expect(')');
    if (line.ended()) return fields;
    line.expectWord('because');
    const kind = line.word();
    const relations: string[] = [];
    if (!line.ended()) {
      do relations.push(line.string());
      while (line.take(','));
    }
    return { ...fields, why: { kind, relations } };
  }

  private field(line: Line, key: string, at: number): unknown {
    switch (key) {
      case 'amount':
        return line.amount();
      case 'anchor':
        return line.word();
      case 'feature':
        line.expect('(');
        return line.numbers(3);
      case 'origin':
      case 'direction':
      case 'axis':
      case 'normal':
        return this.reference(line, key === 'origin');
      default:
        return line.fail(
          at,
          `the field "${key}" is unknown`,
          'use amount, origin, direction, axis, normal, feature, anchor',
        );
    }
  }

  private reference(line: Line, isPoint: boolean): unknown {
    const at = line.at();
    const wanted = isPoint ? 'point' : 'axis';
    const word = line.word();
    if (word !== '' && word !== wanted) {
      line.fail(
        at,
        `"${word}" is not known here`,
        `write (x, y, z) or ${wanted}("part", ${isPoint ? '0, 1, 0' : '0'})`,
      );
    }
    line.expect('(');
    if (word === '') return line.numbers(3);
    const part = line.string();
    line.expect(',');
    return isPoint ? { part, at: line.numbers(3) } : { part, axis: line.numbers(1)[0] };
  }
}
