// What every format of this folder passes before anything is done with it: bounds on what a schema should walk, then the
// schema, whose first complaint is put in words.
import * as v from 'valibot';
import { cut, shortened } from './cut';
import { limits } from './schema';
import type { ProgramError, Result } from './types';

/** A format, as refusals speak of it. */
export interface Format {
  /** Folder and step that refuse: "program/check". */
  readonly stage: string;
  /** "program" */
  readonly what: string;
  /** "parsel/program" */
  readonly name: string;
}

/** No list of any format is longer; which is which is seen by the schema. */
const longestList = Math.max(limits.statements, limits.reports);

/** A copy of untrusted JSON, if the schema accepts it. The place of an error is a JSON pointer. */
export function readFormat<T>(json: unknown, schema: v.GenericSchema<unknown, T>, format: Format): Result<T> {
  const tooMuch = findExcess(json, format);
  if (tooMuch) return { ok: false, error: tooMuch };
  const parsed = v.safeParse(schema, json, { abortEarly: true });
  return parsed.success
    ? { ok: true, value: parsed.output }
    : { ok: false, error: fromIssue(parsed.issues[0], format) };
}

/** RFC 6901. */
export function pointer(...path: readonly (string | number)[]): string {
  return path.map((key) => `/${cut(String(key), 80).replaceAll('~', '~0').replaceAll('/', '~1')}`).join('');
}

/** Quotes a name from the input for a message, at a length that fits one. */
export function quote(text: string): string {
  return JSON.stringify(shortened(text, 60));
}

/** What no schema should be asked to walk: too many values, too deep, not JSON, or keys that reach into prototypes. */
function findExcess(json: unknown, { stage, what }: Format): ProgramError | null {
  const refusal = (place: string, cause: string, fix: string): ProgramError => ({ stage, place, cause, fix });
  let values = 0;
  const walk = (value: unknown, path: readonly (string | number)[]): ProgramError | null => {
    if (++values > limits.jsonValues) {
      return refusal('', `the ${what} has more than ${limits.jsonValues} values`, 'split it or remove statements');
    }
    if (typeof value !== 'object' || value === null) return null;
    if (path.length >= limits.jsonDepth) {
      return refusal(pointer(...path), `nested deeper than ${limits.jsonDepth} levels`, 'flatten it');
    }
    if (Array.isArray(value)) {
      if (value.length > longestList) {
        return refusal(
          pointer(...path),
          `a list of ${value.length} items`,
          `use at most ${limits.statements} statements and ${limits.reports} reports`,
        );
      }
      return firstFault(value.entries(), path);
    }
    const prototype: unknown = Object.getPrototypeOf(value);
    if (prototype !== Object.prototype && prototype !== null) {
      return refusal(pointer(...path), 'not a plain JSON object', 'give the result of JSON.parse');
    }
    return firstFault(Object.entries(value), path);
  };
  const firstFault = (
    entries: Iterable<[string | number, unknown]>,
    path: readonly (string | number)[],
  ): ProgramError | null => {
    for (const [key, item] of entries) {
      if (typeof key === 'string' && key in Object.prototype) {
        return refusal(pointer(...path, key), `the key ${quote(key)} is not allowed`, 'remove it');
      }
      const fault = walk(item, [...path, key]);
      if (fault) return fault;
    }
    return null;
  };
  return walk(json, []);
}

/** The first thing that the schema found, in words. */
function fromIssue(issue: v.BaseIssue<unknown>, { stage, what, name }: Format): ProgramError {
  const refusal = (place: string, cause: string, fix: string): ProgramError => ({ stage, place, cause, fix });
  const path = (issue.path ?? []).map((item) => item.key as string | number);
  const place = pointer(...path);
  const key = quote(String(path.at(-1) ?? ''));
  const last = issue.path?.at(-1);
  if (issue.expected === 'never') return refusal(place, `the key or item ${key} is unknown here`, 'remove it');
  if (last?.origin === 'key') return refusal(pointer(...path.slice(0, -1)), `the key ${key} is missing`, 'add it');
  const top = path.join('/');
  if (top === 'format') return refusal(place, `not a ParSEL ${what}`, `give a file of format "${name}"`);
  if (top === 'version') {
    return refusal(place, `version ${clip(issue.received)} is unknown`, 'use version 1, or a newer ParSEL');
  }
  if (issue.kind === 'validation') return refusal(place, clip(issue.message, 200), 'change it accordingly');
  return refusal(
    place,
    `${clip(issue.received)} is not accepted`,
    `write ${clip(issue.expected ?? 'something else', 200)}`,
  );
}

function clip(text: string, length = 80): string {
  return shortened(text, length);
}
