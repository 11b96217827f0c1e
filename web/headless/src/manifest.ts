// A manifest: one job a line, as JSON (format parsel/job, core/cli/job_request.h). Here only what a batch needs to know
// of a job is looked at; the core reads the rest.
import { createHash } from 'node:crypto';
import { createReadStream } from 'node:fs';
import { createInterface } from 'node:readline';
import { type Fault, Misuse, Refusal, reasonOf } from './fault';

export interface Entry {
  /** From 1. */
  readonly line: number;
  /** The name of its result's folder: its id, else "line_000012". */
  readonly key: string;
  /** The job as it stands in the manifest. */
  readonly text: string;
  /** Tells whether a result is of this text. */
  readonly digest: string;
  /** Why it cannot be tried. */
  readonly fault: Fault | null;
}

/** Every `of`th line, beginning with number `index` (from 0). */
export interface Slice {
  readonly index: number;
  readonly of: number;
}

const mostBytes = 1 << 20;
const named = /^[\p{L}\p{N}][\p{L}\p{M}\p{N} ._-]*$/u;
const ofALine = /^line_\d+$/;

export const lineKey = (line: number): string => `line_${String(line).padStart(6, '0')}`;

export const digestOf = (text: string): string => createHash('sha256').update(text).digest('hex').slice(0, 16);

/** "3/8". @throws Misuse */
export function sliceOf(text: string | undefined): Slice | null {
  if (text === undefined) return null;
  const [, index, of] = (/^(\d{1,6})\/(\d{1,6})$/.exec(text) ?? []).map(Number);
  if (index === undefined || of === undefined || index >= of) {
    throw new Misuse('--slice takes INDEX/COUNT with INDEX from 0, such as 0/8');
  }
  return { index, of };
}

/** What is wrong with an id; nothing when a folder may be called so on every system. */
function idFault(id: unknown): string | null {
  if (typeof id !== 'string') return 'is no text';
  if (!named.test(id) || /[. ]$/.test(id) || Buffer.byteLength(id) > 120) {
    return 'is not made of letters, digits, blanks, ".", "_" and "-" alone, or is longer than 120 bytes';
  }
  if (ofALine.test(id)) return 'is the name of a line without an id';
  return null;
}

/** Blank lines are none. Every other line is an entry, also one that is no job. @throws Refusal when it cannot be read */
export async function readManifest(path: string, slice: Slice | null = null): Promise<Entry[]> {
  const entries: Entry[] = [];
  const taken = new Map<string, number>();
  let line = 0;
  let count = 0;
  try {
    for await (const raw of createInterface({ input: createReadStream(path), crlfDelay: Number.POSITIVE_INFINITY })) {
      ++line;
      const text = (line === 1 ? raw.replace(/^\uFEFF/, '') : raw).trim();
      if (text === '') continue;
      const entry = entryOf(line, text, taken);
      // The whole manifest is looked at, so that every slice finds the same ids taken.
      if (slice === null || count % slice.of === slice.index) entries.push(entry);
      ++count;
    }
  } catch (error) {
    throw new Refusal({
      stage: 'batch/manifest',
      place: path,
      cause: `the manifest cannot be read (${reasonOf(error)})`,
      fix: 'check the path and its permissions',
    });
  }
  return entries;
}

function entryOf(line: number, text: string, taken: Map<string, number>): Entry {
  const own = { line, key: lineKey(line), text, digest: digestOf(text) };
  const refuse = (place: string, cause: string, fix: string): Entry => ({
    ...own,
    fault: { stage: 'batch/manifest', place: `line ${line}${place}`, cause, fix },
  });
  if (Buffer.byteLength(text) > mostBytes) {
    return refuse('', 'it is longer than 1 MiB', 'put edits and programs into files and give their paths');
  }
  let job: unknown;
  try {
    job = JSON.parse(text);
  } catch (error) {
    return refuse('', `this is no JSON (${reasonOf(error)})`, 'write one JSON object a line');
  }
  if (typeof job !== 'object' || job === null || Array.isArray(job)) {
    return refuse('', 'this is no JSON object', 'write {"model": "chair.glb", …}');
  }
  const { id } = job as { id?: unknown };
  if (id === undefined) return { ...own, fault: null };
  const wrong = idFault(id);
  if (wrong !== null) return refuse(', /id', wrong, 'use another id, or none');
  // Folders that differ in case or composition alone are the same on some systems.
  const folded = (id as string).normalize('NFC').toLowerCase();
  const before = taken.get(folded);
  if (before !== undefined) return refuse(', /id', `line ${before} has the same`, 'give each job an id of its own');
  taken.set(folded, line);
  return { ...own, key: id as string, fault: null };
}
