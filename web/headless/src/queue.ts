// A batch by way of a queue: puts its jobs in and waits for their results in the folder, which workers share with it.
//
// The folder alone tells what is done, not the queue. A job that the queue has lost, with a Redis that forgot it, is put
// in again; one that is done twice wins its place in the folder once (store.ts).
import { setTimeout as wait } from 'node:timers/promises';
import { onInterrupt } from './interrupt';
import { digestOf, type Entry } from './manifest';
import { faultResult, type Limits } from './perform';
import type { Progress } from './progress';
import { connect, type Queue, queueName, shownUrl } from './redis';
import type { JobResult, Store } from './store';

export interface Batch {
  readonly store: Store;
  /** Jobs without a result. */
  readonly todo: readonly Entry[];
  /** Where relative paths of jobs begin, absolute. */
  readonly from: string;
  readonly limits: Limits;
  readonly progress: Progress;
  done(result: JobResult): void;
}

const lookMs = 500;
const chunk = 500;
/** Jobs that are looked for in the queue at a time. */
const looked = 200;
/** A job that is done as often, and has no result here, is done where this folder is not. */
const mostReturns = 20;

/** Puts jobs in; those that are there already stay as they are. */
async function put(queue: Queue, batch: Batch, entries: readonly Entry[]): Promise<void> {
  const { store, from, limits } = batch;
  for (let i = 0; i < entries.length; i += chunk) {
    const jobs = entries.slice(i, i + chunk).map(({ line, key, text, digest }) => ({
      name: 'job',
      data: { line, key, text, digest, from, output: store.folder, seconds: limits.seconds },
      opts: {
        jobId: idOf(store, { key, digest }),
        attempts: 5, // of the queue: a folder that cannot be written to, a worker that was ended
        backoff: { type: 'exponential', delay: 1000 },
        removeOnComplete: true,
        removeOnFail: false,
      },
    }));
    await queue.addBulk(jobs);
  }
}

const idOf = (store: Store, { key, digest }: Pick<Entry, 'key' | 'digest'>): string =>
  `job-${digestOf([store.folder, key, digest].join('\0'))}`;

/** Waits until every job has its result, or somebody asks to end; jobs then stay in the queue. */
export async function throughQueue(batch: Batch, url: string): Promise<void> {
  const { store, progress } = batch;
  const remaining = new Map(batch.todo.map((entry) => [idOf(store, entry), entry]));
  const finish = (id: string, result: JobResult) => {
    remaining.delete(id);
    batch.done(result);
  };
  // Before anything is written: without a Redis nothing is begun.
  const connected = batch.todo.some(({ fault }) => fault === null) ? await connect(url) : null;
  for (const [id, entry] of remaining) {
    if (entry.fault === null) continue;
    const result = faultResult(entry, entry.fault, 0, 0);
    store.commit(entry, store.aside(), result);
    finish(id, result);
  }
  if (connected === null) return;
  const queue = new connected.Queue(queueName, { connection: connected.connection() });
  const troubles = new Troubles(progress, url);
  queue.on('error', (error) => troubles.hear(error));
  const ended = new AbortController();
  const interrupt = onInterrupt(
    () => ended.abort(),
    () => process.exit(130),
  );
  const returns = new Map<string, number>();
  try {
    await put(queue, batch, [...remaining.values()]);
    while (remaining.size > 0 && !interrupt.asked) {
      const names = store.names();
      for (const [id, entry] of remaining) {
        const result = names.has(entry.key) ? store.resultOf(entry) : null;
        if (result !== null) finish(id, result);
      }
      // While Redis is away its commands wait for it: results are looked for meanwhile.
      const wake = wait(lookMs, undefined, { signal: ended.signal }).catch(() => {});
      troubles.busy ??= reconcile(queue, batch, remaining, returns, finish)
        .catch((error) => troubles.hear(error))
        .finally(() => {
          troubles.busy = null;
        });
      await wake;
    }
  } finally {
    interrupt.release();
    await Promise.race([queue.close(), wait(1000)]).catch(() => {});
    connected.disconnect();
  }
  if (interrupt.asked && remaining.size > 0) {
    progress.tell(`${remaining.size} jobs stay in the queue; the same command with --resume waits for them again.`);
  }
}

/** What the queue says of jobs that have no result: those that failed for good get one, those that it lost are put in. */
async function reconcile(
  queue: Queue,
  batch: Batch,
  remaining: ReadonlyMap<string, Entry>,
  returns: Map<string, number>,
  finish: (id: string, result: JobResult) => void,
): Promise<void> {
  const { store, progress } = batch;
  const give = (id: string, entry: Entry, cause: string, fix: string) => {
    const result = faultResult(entry, { stage: 'queue', place: '', cause, fix }, 0, 0);
    if (store.commit(entry, store.aside(), result)) finish(id, result);
  };
  for (const job of await queue.getFailed(0, chunk)) {
    const entry = remaining.get(job.id);
    if (entry === undefined) continue;
    const reason = job.failedReason;
    give(job.id, entry, `workers gave it up: ${reason}`, 'look at the workers, then remove its folder and --resume');
    await job.remove();
  }
  const missing: Entry[] = [];
  for (const [id, entry] of [...remaining].slice(0, looked)) {
    if ((await queue.getJob(id)) !== undefined || store.resultOf(entry) !== null) continue;
    const times = (returns.get(id) ?? 0) + 1;
    returns.set(id, times);
    if (times <= mostReturns) missing.push(entry);
    else give(id, entry, 'it is done over and over, but no result comes', 'let workers share the folder of -o');
  }
  await put(queue, batch, missing);
  const workers = await queue.getWorkersCount();
  progress.say(workers === 0 ? 'no worker: start one with parsel worker redis://HOST' : `${workers} workers`);
}

/** Says once that Redis is away, and once that it is back. */
export class Troubles {
  /** What asks Redis at the moment. */
  busy: Promise<void> | null = null;
  private last = '';
  private quiet: NodeJS.Timeout | undefined;

  constructor(
    private readonly progress: Progress,
    private readonly url: string,
  ) {}

  hear(error: Error): void {
    const text = error.message || String((error as NodeJS.ErrnoException).code);
    if (text !== this.last) this.progress.tell(`queue: ${shownUrl(this.url)}: ${text}; trying again.`);
    this.last = text;
    clearTimeout(this.quiet);
    this.quiet = setTimeout(() => {
      this.last = '';
    }, 10_000);
    this.quiet.unref();
  }
}
