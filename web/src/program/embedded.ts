// Sliders inside a GLB: `extras.parsel` of the file's root holds `parsel/sliders` v1 (sliders.ts). The JSON is spliced as
// text, so that nothing else of it changes, and what is taken out again leaves the bytes that there were before.
//
// Rejected: an extension of our own. Validators report one that they do not know, and tools that rewrite files drop it.
// Extras are by the specification for applications to use; they pass every validator, and three.js hands them on as
// `gltf.userData`.
import { jsonLimits, parseJson } from './json';
import type { ReadSliders, Sliders } from './sliders';
import { readSliders } from './sliders';
import type { ProgramError, Result } from './types';

const key = 'parsel';
const magic = 0x46546c67; // "glTF"
const jsonChunk = 0x4e4f534a; // "JSON"
const space = 0x20;

function refused(place: string, cause: string, fix: string): { ok: false; error: ProgramError } {
  return { ok: false, error: { stage: 'program/embedded', place, cause, fix } };
}

/** A GLB taken apart: the text of its JSON, and the chunks behind it as they are. */
interface Glb {
  readonly text: string;
  readonly json: Readonly<Record<string, unknown>>;
  readonly rest: Uint8Array;
}

function takeApart(glb: Uint8Array): Result<Glb> {
  const view = new DataView(glb.buffer, glb.byteOffset, glb.byteLength);
  if (glb.length < 20 || view.getUint32(0, true) !== magic) {
    return refused('byte 0', 'this is no GLB', 'give the bytes of a .glb file');
  }
  const version = view.getUint32(4, true);
  if (version !== 2) return refused('byte 4', `GLB version ${version} is unknown`, 'export the file as glTF 2.0');
  const end = 20 + view.getUint32(12, true);
  if (view.getUint32(16, true) !== jsonChunk || end > glb.length) {
    return refused('byte 12', 'the JSON chunk is missing or breaks off', 'export the file again');
  }
  const text = new TextDecoder().decode(glb.subarray(20, end)).replace(/[\0 ]+$/, '');
  const read = parseJson(text, { ...jsonLimits, length: Number.POSITIVE_INFINITY });
  if (!read.ok) return { ok: false, error: { ...read.error, stage: 'program/embedded' } };
  const json = read.value;
  if (!isObject(json)) return refused('byte 20', 'the JSON chunk holds no object', 'export the file again');
  return { ok: true, value: { text, json, rest: glb.subarray(end) } };
}

function putTogether(text: string, rest: Uint8Array): Uint8Array {
  const bytes = new TextEncoder().encode(text);
  const padded = Math.ceil(bytes.length / 4) * 4;
  const glb = new Uint8Array(20 + padded + rest.length).fill(space, 20, 20 + padded);
  const view = new DataView(glb.buffer);
  for (const [i, value] of [magic, 2, glb.length, padded, jsonChunk].entries()) view.setUint32(4 * i, value, true);
  glb.set(bytes, 20);
  glb.set(rest, 20 + padded);
  return glb;
}

/** The file with sliders in it, in place of those that it may have had. */
export function embedSliders(glb: Uint8Array, sliders: Sliders): Result<Uint8Array> {
  const bare = withoutSliders(glb);
  const apart = bare.ok ? takeApart(bare.value) : bare;
  if (!apart.ok) return apart;
  const { text, json, rest } = apart.value;
  const record = `${JSON.stringify(key)}:${JSON.stringify(sliders)}`;
  const { extras } = json;
  if (extras === undefined) return { ok: true, value: putTogether(insert(text, 0, `"extras":{${record}}`), rest) };
  if (!isObject(extras)) {
    return refused('/extras', 'the extras of the file are no object, so nothing can be added to them', 'remove them');
  }
  const start = memberOf(text, 0, 'extras')?.value ?? 0;
  return { ok: true, value: putTogether(insert(text, start, record), rest) };
}

/** The file as it was before sliders were put in; itself when it has none. */
export function withoutSliders(glb: Uint8Array): Result<Uint8Array> {
  const apart = takeApart(glb);
  if (!apart.ok) return apart;
  const { text, json, rest } = apart.value;
  const { extras } = json;
  if (!isObject(extras) || !(key in extras)) return { ok: true, value: glb };
  const isAlone = Object.keys(extras).length === 1;
  const start = isAlone ? 0 : (memberOf(text, 0, 'extras')?.value ?? 0);
  return { ok: true, value: putTogether(remove(text, start, isAlone ? 'extras' : key), rest) };
}

/** The sliders in a file, checked; null when it has none. */
export function slidersIn(glb: Uint8Array): Result<ReadSliders | null> {
  const apart = takeApart(glb);
  return apart.ok ? slidersInJson(apart.value.json) : apart;
}

/** The same of glTF's JSON, or of what three.js makes of its root. */
export function slidersInJson(json: { readonly extras?: unknown }): Result<ReadSliders | null> {
  const { extras } = json;
  if (!isObject(extras) || !(key in extras)) return { ok: true, value: null };
  const read = readSliders(extras[key]);
  if (read.ok) return read;
  return { ok: false, error: { ...read.error, place: `/extras/${key}${read.error.place}` } };
}

const isObject = (value: unknown): value is Readonly<Record<string, unknown>> =>
  typeof value === 'object' && value !== null && !Array.isArray(value);

// --------------------------------------------------------------------------------------------- JSON that parses, as text

/** Where a member of an object stands: its key, its value, and what is behind that. */
interface Member {
  readonly key: number;
  readonly value: number;
  readonly end: number;
}

/** A member of the object that begins at or behind `start`; the last of its name, which is the one that JSON.parse takes. */
function memberOf(text: string, start: number, name: string): Member | undefined {
  let found: Member | undefined;
  let at = blank(text, text.indexOf('{', start) + 1);
  while (text[at] === '"') {
    const keyEnd = valueEnd(text, at);
    const value = blank(text, blank(text, keyEnd) + 1);
    const end = valueEnd(text, value);
    if (JSON.parse(text.slice(at, keyEnd)) === name) found = { key: at, value, end };
    at = blank(text, end);
    if (text[at] === ',') at = blank(text, at + 1);
  }
  return found;
}

/** Puts a member first into the object that begins at or behind `start`. */
function insert(text: string, start: number, member: string): string {
  const at = text.indexOf('{', start) + 1;
  const comma = text[blank(text, at)] === '}' ? '' : ',';
  return text.slice(0, at) + member + comma + text.slice(at);
}

/** Takes a member out, with one comma beside it. */
function remove(text: string, start: number, name: string): string {
  const member = memberOf(text, start, name);
  if (member === undefined) return text;
  const behind = blank(text, member.end);
  if (text[behind] === ',') return text.slice(0, member.key) + text.slice(behind + 1);
  const before = text.slice(0, member.key).trimEnd();
  return (before.endsWith(',') ? before.slice(0, -1) : before) + text.slice(member.end);
}

function blank(text: string, at: number): number {
  let end = at;
  while (end < text.length && ' \t\r\n'.includes(text[end] as string)) end++;
  return end;
}

/** Behind the value that begins at `start`. */
function valueEnd(text: string, start: number): number {
  let depth = 0;
  for (let at = start; at < text.length; at++) {
    const character = text[at] as string;
    if (character === '"') {
      at = stringEnd(text, at) - 1;
    } else if (character === '{' || character === '[') {
      depth++;
    } else if (character === '}' || character === ']') {
      if (depth === 0) return at; // of a number or word, before the bracket that closes its object
      depth--;
    } else if (depth > 0 || !',: \t\r\n'.includes(character)) {
      continue;
    } else {
      return at;
    }
    if (depth === 0) return at + 1;
  }
  return text.length;
}

/** Behind the string that begins at `start`. */
function stringEnd(text: string, start: number): number {
  let at = start + 1;
  while (text[at] !== '"') at += text[at] === '\\' ? 2 : 1;
  return at + 1;
}
