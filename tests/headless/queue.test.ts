// parsel batch --queue and parsel worker: jobs by way of BullMQ, with workers and Redis killed while they are done.
import { readdirSync, statSync } from 'node:fs';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { Bench, childrenOf, type Ended, until } from './parsel';
import { hasRedis, Redis } from './redis';

if (!hasRedis) process.stdout.write('redis-server is not installed: the tests of the queue are skipped.\n');

let bench: Bench;
beforeAll(() => {
  bench = new Bench();
}, 120_000);
afterAll(() => bench.end());

const jobs = (count: number) =>
  Array.from({ length: count }, (_, i) => ({ id: `job ${i}`, model: i % 10 === 9 ? 'absent.glb' : 'chair.glb' }));

describe('without Redis', () => {
  it.each([
    ['a batch', ['batch', 'two.jsonl', '-o', 'never', '--queue']],
    ['a worker', ['worker']],
  ])('%s says at once that none answers', (_, command) => {
    bench.write('two.jsonl', jobs(2));
    const start = performance.now();
    const { code, said } = bench.run(...command, 'redis://name:secret@127.0.0.1:1');
    expect(performance.now() - start).toBeLessThan(20_000);
    expect(code).toBe(1);
    expect(said).toMatch(/^queue: redis:\/\/…@127\.0\.0\.1:1: no Redis answers there \(.*ECONNREFUSED.*\); start one/);
    expect(said).not.toContain('secret');
  });

  it('nothing is begun, nor a result written of a line that is no job', () => {
    bench.write('bad.jsonl', 'no job\n{"id": "one", "model": "chair.glb"}\n');
    const { code } = bench.run('batch', 'bad.jsonl', '-o', 'unbegun', '--queue', 'redis://127.0.0.1:1');
    expect(code).toBe(1);
    expect(bench.written('unbegun').size).toBe(0);
    const again = bench.run('batch', 'bad.jsonl', '-o', 'unbegun', '--queue', 'redis://127.0.0.1:1');
    expect(again.said).toMatch(/no Redis answers there/); // not that there are results already
  });

  it('an address of something else is refused', () => {
    const { code, said } = bench.run('worker', 'http://127.0.0.1');
    expect(code).toBe(1);
    expect(said).toMatch(/no address of a Redis/);
  });
});

describe.skipIf(!hasRedis)('with Redis', () => {
  let redis: Redis;
  beforeAll(async () => {
    redis = await Redis.start();
  });
  afterAll(() => redis.end());

  it('workers do the jobs of a batch, as it does them itself, and end when they are asked to', async () => {
    bench.write('some.jsonl', [
      ...jobs(10),
      { id: 'wide', model: 'chair.glb', edits: [{ request: 'widen the seat' }], apply: [{}] },
    ]);
    const worker = bench.start('worker', redis.url, '--workers', '2');
    const { code, out } = await bench.start('batch', 'some.jsonl', '-o', 'some', '--queue', redis.url).ended;
    expect(JSON.parse(out)).toMatchObject({ jobs: 11, done: 11, refused: 1 });
    expect(code).toBe(1);
    bench.run('batch', 'some.jsonl', '-o', 'here');
    const alike = (output: string) => bench.results(output).map(({ seconds, ...rest }) => rest);
    expect(alike('some')).toEqual(alike('here'));
    expect(readdirSync(join(bench.folder, 'some/wide')).sort()).toEqual([
      'edited_1.glb',
      'program.json',
      'result.json',
    ]);
    worker.child.kill('SIGINT');
    expect(await worker.ended).toMatchObject({ code: 0 });
    expect(redis.ask('keys', 'bull:parsel:job-*')).toBe('');
  });

  it('says when no worker is there, keeps the jobs when it is ended, and finds them again', async () => {
    bench.write('waiting.jsonl', jobs(5));
    const first = bench.start('batch', 'waiting.jsonl', '-o', 'waiting', '--queue', redis.url);
    await until('the jobs wait', 20, () => redis.ask('llen', 'bull:parsel:wait') === '5');
    first.child.kill('SIGINT');
    const { code, said } = await first.ended;
    expect(code).toBe(130);
    expect(said).toContain('5 jobs stay in the queue');
    const worker = bench.start('worker', redis.url);
    const { out } = await bench.start('batch', 'waiting.jsonl', '-o', 'waiting', '--queue', redis.url, '--resume')
      .ended;
    expect(JSON.parse(out)).toMatchObject({ jobs: 5, done: 5 });
    worker.child.kill('SIGINT');
    await worker.ended;
  });

  it('no more jobs a second are begun than the rate', async () => {
    bench.write('slow.jsonl', jobs(9));
    const worker = bench.start('worker', redis.url, '--rate', '3');
    const { out } = await bench.start('batch', 'slow.jsonl', '-o', 'slow', '--queue', redis.url).ended;
    expect(JSON.parse(out).seconds).toBeGreaterThanOrEqual(2);
    worker.child.kill('SIGINT');
    await worker.ended;
  });

  it('workers and Redis are killed again and again: no result is lost, none is written twice', {
    timeout: 300_000,
  }, async () => {
    const count = Number(process.env.PARSEL_KILL_JOBS ?? 120);
    bench.write('many.jsonl', jobs(count));
    const startWorker = () => bench.start('worker', redis.url, '--workers', '2', '--stalled', '2');
    const batch = bench.start('batch', 'many.jsonl', '-o', 'many', '--queue', redis.url);
    const workers = [startWorker(), startWorker()];
    let ended: Ended | null = null;
    void batch.ended.then((answer) => {
      ended = answer;
    });
    // What a result's file is when it is first seen: its inode, its time, its text.
    const seen = new Map<string, string>();
    const look = () => {
      for (const [key] of bench.written('many')) {
        const { ino, mtimeMs, size } = statSync(join(bench.folder, 'many', key, 'result.json'));
        const now = `${ino} ${mtimeMs} ${size}`;
        expect(seen.get(key) ?? now).toBe(now);
        seen.set(key, now);
      }
      return seen.size;
    };
    const kills = { workers: 0, processes: 0, redis: 0 };
    for (let round = 0; ended === null; ++round) {
      const before = look();
      await until('some more results', 60, () => ended !== null || look() >= Math.min(count, before + count / 8));
      if (ended !== null) break;
      if (round % 3 === 0) {
        const at = (round / 3) % workers.length;
        (workers[at] as (typeof workers)[0]).child.kill('SIGKILL');
        await (workers[at] as (typeof workers)[0]).ended;
        workers[at] = startWorker();
        ++kills.workers;
      } else if (round % 3 === 1) {
        await redis.kill();
        await redis.begin();
        ++kills.redis;
      } else {
        for (const { child } of workers) {
          const [pid] = childrenOf(child.pid as number);
          if (pid !== undefined) process.kill(pid, 'SIGKILL');
          ++kills.processes;
        }
      }
    }
    for (const { child } of workers) child.kill('SIGINT');
    await Promise.all(workers.map((worker) => worker.ended));
    process.stdout.write(`${count} jobs, killed: ${JSON.stringify(kills)}\n`);
    expect(kills.workers).toBeGreaterThan(0);
    expect(kills.redis).toBeGreaterThan(0);

    look();
    const results = bench.results('many');
    expect(results.map(({ id }) => id)).toEqual(jobs(count).map(({ id }) => id));
    for (const { id, error, model } of results) {
      expect(error === undefined, `${id}: ${JSON.stringify(error)}`).toBe(model === 'chair.glb');
    }
    expect([...seen.keys()].sort()).toEqual(results.map(({ id }) => id).sort());
    const { jobs: of, done, refused } = JSON.parse((await batch.ended).out);
    expect({ of, done, refused }).toEqual({ of: count, done: count, refused: count / 10 });
  });
});
