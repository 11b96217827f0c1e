// The gate for JSON that comes from outside: files, links, replies of providers, what lies in the browser's storage. What
// walks JSON afterwards, schemas above all, does so recursively, and would run out of stack on deep nesting.
import type { ProgramError, Result } from './types';

export interface JsonLimits {
  /** UTF-16 code units. */
  readonly length: number;
  /** Arrays and objects that may be open at once. */
  readonly depth: number;
}

/**
 * A program with everything at its limit is smaller, and takes well under a second; no format nests deeper than 16, and
 * glTF with extras hardly more.
 */
export const jsonLimits: JsonLimits = { length: 16 * 2 ** 20, depth: 64 };

/** Reads untrusted JSON. Errors have the stage "json" and the place "character N", 1-based, or none. */
export function parseJson(text: string, limits: JsonLimits = jsonLimits): Result<unknown> {
  if (text.length > limits.length) {
    return refusal(
      '',
      `it is longer than ${Math.floor(limits.length / 2 ** 20)} MB`,
      'split it, or remove parts of it',
    );
  }
  const at = tooDeepAt(text, limits.depth);
  if (at !== null) return refusal(`character ${at + 1}`, `nested deeper than ${limits.depth} levels`, 'flatten it');
  try {
    return { ok: true, value: JSON.parse(text) };
  } catch {
    return refusal('', 'this is no JSON, or it breaks off', 'give the whole file');
  }
}

function refusal(place: string, cause: string, fix: string): { ok: false; error: ProgramError } {
  return { ok: false, error: { stage: 'json', place, cause, fix } };
}

const quote = 0x22;
const backslash = 0x5c;

/** Where a bracket opens one level too many, or null. Counted in the text: nothing is built of it first. */
function tooDeepAt(text: string, most: number): number | null {
  let depth = 0;
  for (let i = 0; i < text.length; i++) {
    const code = text.charCodeAt(i);
    if (code === quote) i = endOfString(text, i);
    else if (code === 0x5b || code === 0x7b) {
      if (++depth > most) return i;
    } else if (code === 0x5d || code === 0x7d) depth--;
  }
  return null;
}

/** Index of the closing quote, or the end of the text. */
function endOfString(text: string, from: number): number {
  for (let i = from + 1; i < text.length; i++) {
    const code = text.charCodeAt(i);
    if (code === backslash) i++;
    else if (code === quote) return i;
  }
  return text.length;
}
