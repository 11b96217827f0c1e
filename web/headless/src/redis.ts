// BullMQ on Redis, which whoever wants a queue installs beside this package. Only what is used of them is described here.
import { codeOf, Refusal, reasonOf } from './fault';

interface Redis {
  connect(): Promise<void>;
  ping(): Promise<string>;
  disconnect(): void;
  on(event: 'error', listener: (error: Error) => void): void;
}
type RedisOptions = Readonly<Record<string, unknown>>;

/** What a worker needs to know of a job, which is all that the queue holds of it. */
export interface JobData {
  readonly line: number;
  readonly key: string;
  readonly text: string;
  readonly digest: string;
  /** Absolute: where relative paths begin, and the batch's folder. */
  readonly from: string;
  readonly output: string;
  readonly seconds: number;
}

export interface QueuedJob {
  readonly id: string;
  readonly data: JobData;
  readonly failedReason: string;
  readonly attemptsMade: number;
  remove(): Promise<void>;
}

export interface Queue {
  addBulk(jobs: readonly { name: string; data: JobData; opts: object }[]): Promise<unknown>;
  getJob(id: string): Promise<QueuedJob | undefined>;
  getFailed(start: number, end: number): Promise<QueuedJob[]>;
  getWorkersCount(): Promise<number>;
  on(event: 'error', listener: (error: Error) => void): void;
  close(): Promise<void>;
}

export interface QueueWorker {
  on(event: 'error', listener: (error: Error) => void): void;
  on(event: 'failed', listener: (job: QueuedJob | undefined, error: Error) => void): void;
  on(event: 'stalled', listener: (id: string) => void): void;
  close(force?: boolean): Promise<void>;
}

interface Packages {
  readonly Queue: new (name: string, options: object) => Queue;
  readonly Worker: new (name: string, process: (job: QueuedJob) => Promise<unknown>, options: object) => QueueWorker;
  readonly Redis: new (url: string, options: RedisOptions) => Redis;
}

/** The one queue of a Redis; jobs say themselves where they belong. */
export const queueName = 'parsel';

/** Without what only its owner should read. */
export const shownUrl = (url: string): string => url.replace(/\/\/[^@/]*@/, '//…@');

async function packages(): Promise<Packages> {
  // By variables, so that nobody needs the packages who uses no queue: neither a bundler nor a compiler looks for them.
  const [bullmq, ioredis] = ['bullmq', 'ioredis'];
  try {
    const { Queue, Worker } = (await import(bullmq)) as Pick<Packages, 'Queue' | 'Worker'>;
    const { Redis } = (await import(ioredis)) as Pick<Packages, 'Redis'>;
    return { Queue, Worker, Redis };
  } catch (error) {
    throw new Refusal({
      stage: 'queue',
      place: '',
      cause: `the packages of the queue are not there (${reasonOf(error).split('\n')[0]})`,
      fix: 'install them beside this one: npm install bullmq ioredis',
    });
  }
}

export interface Connected extends Packages {
  /** For each Queue or Worker one of its own. It waits for a Redis that goes away, and goes on when it is back. */
  connection(): Redis;
  /** Ends them all; what is still asked of them is dropped. */
  disconnect(): void;
}

/** @throws Refusal when the packages or the Redis are not there */
export async function connect(url: string): Promise<Connected> {
  const all = await packages();
  if (!/^rediss?:\/\/\S+$/.test(url)) {
    throw new Refusal({
      stage: 'queue',
      place: url,
      cause: 'this is no address of a Redis',
      fix: 'write redis://HOST',
    });
  }
  let cause = '';
  const once = { lazyConnect: true, connectTimeout: 5000, maxRetriesPerRequest: 0, retryStrategy: () => null };
  const probe = new all.Redis(url, once);
  probe.on('error', (error) => {
    cause = reasonOf(error) || (codeOf(error) ?? '');
  });
  try {
    await probe.connect();
    await probe.ping();
  } catch (error) {
    throw new Refusal({
      stage: 'queue',
      place: shownUrl(url),
      cause: `no Redis answers there (${cause || reasonOf(error)})`,
      fix: 'start one (redis-server --appendonly yes), or give the address of one that runs',
    });
  } finally {
    probe.disconnect();
  }
  const connections: Redis[] = [];
  return {
    ...all,
    connection() {
      const again = (times: number) => Math.min(times * 100, 2000); // ms
      const redis = new all.Redis(url, { maxRetriesPerRequest: null, retryStrategy: again });
      redis.on('error', () => {}); // it tries again; whoever uses it is told by the queue
      connections.push(redis);
      return redis;
    },
    disconnect() {
      for (const redis of connections) redis.disconnect();
    },
  };
}
