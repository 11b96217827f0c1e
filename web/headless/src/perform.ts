// One job from its text to its result in the folder.
import { mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Fault } from './fault';
import type { Entry } from './manifest';
import type { Pool } from './pool';
import type { JobResult, Store } from './store';

export interface Limits {
  /** MiB a process. */
  readonly memory: number;
  /** A job, wall clock. */
  readonly seconds: number;
  /** Of a job whose process crashes. */
  readonly attempts: number;
}

/** What the core wrote, as far as it is needed here. */
interface Written {
  readonly format: 'parsel/result';
  readonly error?: Fault;
}

/** A result that holds a fault alone. */
export function faultResult(entry: Entry, error: Fault, attempts: number, seconds: number): JobResult {
  const { line, key: id, digest } = entry;
  return { format: 'parsel/result', version: 1, id, line, error, digest, attempts, seconds };
}

/**
 * Does the job and commits its result, which may be that it was refused, crashed or took too long.
 * @param from the folder that relative paths of the job begin at
 * @returns null when the pool was closed meanwhile. @throws Refusal when the folder cannot be written to
 */
export async function perform(
  pool: Pool,
  store: Store,
  entry: Entry,
  from: string,
  limits: Limits,
): Promise<JobResult | null> {
  if (entry.fault !== null) {
    const result = faultResult(entry, entry.fault, 0, 0);
    store.commit(entry, store.aside(), result);
    return result;
  }
  const start = performance.now();
  const seconds = () => Math.round(performance.now() - start) / 1000;
  for (let attempt = 1; ; ++attempt) {
    const folder = store.aside();
    const job = `${folder}.json`;
    try {
      mkdirSync(folder, { recursive: true });
      writeFileSync(job, entry.text);
      const args = ['job', job, '-o', folder, '--from', from];
      const outcome = await pool.run({ args, memory: limits.memory, seconds: limits.seconds });
      if (outcome === 'closed') return null;
      const written = resultIn(folder, outcome);
      if (written === null && outcome !== 'late' && attempt < limits.attempts) continue;
      const { line, key: id, digest } = entry;
      const result =
        written === null
          ? faultResult(entry, faultOf(outcome, limits), attempt, seconds())
          : { ...written, version: 1 as const, id, line, digest, attempts: attempt, seconds: seconds() };
      if (written === null) rmSync(folder, { recursive: true, force: true });
      return store.commit(entry, folder, result) ? result : (store.resultOf(entry) ?? result);
    } finally {
      rmSync(folder, { recursive: true, force: true });
      rmSync(job, { force: true });
    }
  }
}

/** A process that says it has ended, with what it wrote. What a crash left is not looked at. */
function resultIn(folder: string, outcome: unknown): Written | null {
  if (typeof outcome !== 'object' || !('code' in (outcome as object))) return null;
  try {
    const written = JSON.parse(readFileSync(join(folder, 'result.json'), 'utf8')) as Written;
    return written.format === 'parsel/result' ? written : null;
  } catch {
    return null;
  }
}

function faultOf(outcome: unknown, { seconds, memory }: Limits): Fault {
  if (outcome === 'late') {
    const cause = `it took longer than ${seconds} s and was ended`;
    return { stage: 'batch', place: '', cause, fix: 'give it more time with --seconds, or simplify the model' };
  }
  const crash = (outcome as { crash?: string }).crash;
  const cause = crash === undefined ? 'it ended without a result' : `it crashed: ${crash}`;
  const fix = `try a simpler model, or more memory than ${memory} MiB with --memory; if neither helps, please report it`;
  return { stage: 'batch', place: '', cause, fix };
}
