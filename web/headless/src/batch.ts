// parsel batch: the jobs of a manifest, done here or by workers that take them from a queue.
import { appendFileSync, mkdirSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { Misuse, Refusal } from './fault';
import { type Interrupt, onInterrupt } from './interrupt';
import { limitsOf, workersOf } from './limits';
import { type Entry, readManifest, sliceOf } from './manifest';
import type { Command, Options } from './options';
import { perform } from './perform';
import { Pool } from './pool';
import { Progress } from './progress';
import { type Batch, throughQueue } from './queue';
import { Store } from './store';

const interrupted = 130;

async function run(options: Options): Promise<number> {
  const [manifest] = options.positional;
  if (manifest === undefined || options.positional.length > 1) throw new Misuse('batch takes one manifest');
  const output = options.values.get('-o');
  if (output === undefined) throw new Misuse('batch needs -o for the folder that it writes to');
  const queue = options.values.get('--queue');
  for (const name of ['--workers', '--memory']) {
    if (queue !== undefined && options.values.has(name)) throw new Misuse(`${name} is for parsel worker, with --queue`);
  }
  const slice = sliceOf(options.values.get('--slice'));
  const limits = limitsOf(options);
  const workers = workersOf(options);
  const entries = await readManifest(manifest, slice);
  const folder = resolve(output);
  mkdirSync(dirname(folder), { recursive: true });
  const store = new Store(folder);
  store.sweep();
  const file = slice === null ? 'results.jsonl' : `results-${slice.index}-of-${slice.of}.jsonl`;
  const results = join(folder, file);
  const todo = remaining(store, entries, options.flags.has('--resume'), output);
  store.collect(entries, file);

  const progress = new Progress(todo.length);
  const batch: Batch = {
    store,
    todo,
    from: resolve(dirname(manifest)),
    limits,
    progress,
    done(result) {
      appendFileSync(results, `${JSON.stringify(result)}\n`);
      progress.add(result.error !== undefined);
    },
  };
  try {
    await (queue === undefined ? here(batch, workers) : throughQueue(batch, queue));
  } finally {
    progress.end();
  }
  const { done, refused } = store.collect(entries, file);
  const { seconds, perSecond } = progress;
  const summary = { jobs: entries.length, done, refused, seconds, perSecond, results };
  process.stdout.write(`${JSON.stringify(summary, null, 1)}\n`);
  if (done < entries.length) return interrupted;
  return refused > 0 ? 1 : 0;
}

/** The jobs that have no result. @throws Refusal when there are results and nobody said to go on from them */
function remaining(store: Store, entries: readonly Entry[], resume: boolean, output: string): Entry[] {
  const todo = entries.filter((entry) => store.resultOf(entry) === null);
  if (!resume && entries.some((entry) => store.isTaken(entry))) {
    throw new Refusal({
      stage: 'batch',
      place: `-o ${output}`,
      cause: 'it holds results of this manifest already',
      fix: 'add --resume to do what is left, or name another folder',
    });
  }
  return todo;
}

/** Does the jobs in processes of this machine, until somebody asks to end. */
async function here(batch: Batch, workers: number): Promise<void> {
  const { store, todo, from, limits, progress } = batch;
  const pool = new Pool();
  let running = 0;
  const interrupt: Interrupt = onInterrupt(
    () =>
      progress.tell(`Finishing the ${running} jobs that run; once more ends at once. --resume does the rest later.`),
    () => pool.close(),
  );
  let next = 0;
  let fault: unknown = null;
  const takeJobs = async () => {
    while (!interrupt.asked && fault === null && next < todo.length) {
      const entry = todo[next++] as Entry;
      ++running;
      try {
        const result = await perform(pool, store, entry, from, limits);
        if (result !== null) batch.done(result);
      } catch (error) {
        fault ??= error; // the folder cannot be written to: so it is with all others
      }
      --running;
    }
  };
  try {
    await Promise.all(Array.from({ length: Math.min(workers, todo.length) }, takeJobs));
  } finally {
    pool.close();
    interrupt.release();
  }
  if (fault !== null) throw fault;
}

export const batch: Command = {
  name: 'batch',
  usage:
    'MANIFEST.jsonl -o DIR [--workers N] [--resume] [--slice INDEX/COUNT] [--seconds 300] [--memory 2048] ' +
    '[--attempts 2] [--queue redis://HOST]',
  summary:
    'Does the jobs of a manifest, one JSON line each (format parsel/job): DIR/<id>/ for each with its files, and ' +
    'DIR/results.jsonl with a line a job. --queue: by the workers of a queue.',
  values: ['-o', '--workers', '--slice', '--seconds', '--memory', '--attempts', '--queue'],
  flags: ['--resume'],
  run,
};
