// parsel worker: takes jobs from a queue and does them, until it is ended.
import { Misuse } from './fault';
import { onInterrupt } from './interrupt';
import { limitsOf, workersOf } from './limits';
import { type Command, type Options, wholeOf } from './options';
import { perform } from './perform';
import { Pool } from './pool';
import { Progress } from './progress';
import { Troubles } from './queue';
import { connect, type QueuedJob, queueName, shownUrl } from './redis';
import { Store } from './store';

/** A job that stalled as often is given up: it takes its workers down with it. */
const mostStalls = 10;

async function run(options: Options): Promise<number> {
  const [url] = options.positional;
  if (url === undefined || options.positional.length > 1) throw new Misuse('worker takes the address of a Redis');
  const limits = limitsOf(options);
  const workers = workersOf(options);
  const stalled = wholeOf(options, '--stalled', 30, 1, 3600) * 1000;
  const rate = wholeOf(options, '--rate', 0, 1, 100_000);
  const { Worker, connection, disconnect } = await connect(url);

  const pool = new Pool();
  const progress = new Progress(null);
  const troubles = new Troubles(progress, url);
  const stores = new Map<string, Store>();
  const storeOf = (folder: string): Store => {
    const store = stores.get(folder) ?? new Store(folder);
    if (!stores.has(folder)) store.sweep();
    stores.set(folder, store);
    return store;
  };
  const work = async ({ data: { line, key, text, digest, from, output, seconds } }: QueuedJob) => {
    const entry = { line, key, text, digest, fault: null };
    const store = storeOf(output);
    // Done before its worker could tell the queue.
    const result = store.resultOf(entry) ?? (await perform(pool, store, entry, from, { ...limits, seconds }));
    if (result === null) throw new Error('its worker was ended');
    progress.add(result.error !== undefined);
  };
  const worker = new Worker(queueName, work, {
    connection: connection(),
    concurrency: workers,
    lockDuration: stalled,
    stalledInterval: stalled,
    maxStalledCount: mostStalls,
    runRetryDelay: 1000,
    ...(rate > 0 ? { limiter: { max: rate, duration: 1000 } } : {}),
  });
  worker.on('error', (error) => troubles.hear(error));
  worker.on('failed', (job, error) => progress.tell(`queue: ${job?.data.key ?? 'a job'}: ${error.message}`));
  worker.on('stalled', (id) => progress.tell(`queue: ${id} stalled and is done again.`));
  progress.tell(`Doing jobs of ${shownUrl(url)}, ${workers} at a time; Ctrl+C finishes what runs and ends.`);

  await new Promise<void>((resolve) => {
    const interrupt = onInterrupt(
      () => {
        progress.tell('Finishing what runs; once more ends at once, and others do it again.');
        void worker.close().then(() => {
          interrupt.release();
          resolve();
        });
      },
      () => {
        pool.close();
        process.exit(130);
      },
    );
  });
  disconnect();
  pool.close();
  progress.end();
  return 0;
}

export const worker: Command = {
  name: 'worker',
  usage: 'redis://HOST [--workers N] [--memory 2048] [--attempts 2] [--rate JOBS_A_SECOND] [--stalled 30]',
  summary:
    'Does the jobs that parsel batch --queue puts into a Redis, on folders that both see. --stalled: after how many ' +
    'seconds without a sign of life of its worker a job goes to another.',
  values: ['--workers', '--memory', '--attempts', '--rate', '--stalled'],
  flags: [],
  run,
};
