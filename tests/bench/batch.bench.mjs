// Throughput of `parsel batch` (web/headless): 1,000 tiny jobs and 200 of a usual kind, with one worker and with two.
//
//   node tests/bench/batch.bench.mjs            (after ./web/start.sh --build-only)
//
// Prints CSV `benchmark,case,metric,value`. "jobs_per_s" is by the wall clock, so it depends on what else the machine does:
// "load" is its load average (1 min) before. "cpu_ms" is processor time a job, of the batch and all its processes.
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { loadavg, tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const tool = fileURLToPath(new URL('../../web/headless/dist/parsel.js', import.meta.url));
const folder = mkdtempSync(join(tmpdir(), 'parsel-bench-'));
const print = (name, metric, value) => console.log(`batch,${name},${metric},${value}`);

/** Processor time of children that have ended, ms. */
function childTime() {
  // utime and stime of waited-for children, in ticks of 10 ms; the name before them may hold blanks.
  const fields = readFileSync('/proc/self/stat', 'utf8').split(') ')[1].split(' ');
  return (Number(fields[13]) + Number(fields[14])) * 10;
}

function run(...args) {
  const { status, stdout, stderr } = spawnSync(process.execPath, [tool, ...args], { cwd: folder, encoding: 'utf8' });
  if (status !== 0) throw new Error(`parsel ${args.join(' ')}: ${stderr}`);
  return stdout;
}

const kinds = {
  'inspect a chair': [1000, () => ({ model: 'chair.glb' })],
  'widen, check and apply': [
    200,
    (i) => ({
      model: ['chair.glb', 'desk.glb', 'bookcase.glb', 'bed.glb'][i % 4],
      edits: [{ request: 'make it wider' }],
      apply: [{}],
    }),
  ],
};
try {
  run('gallery', '.');
  for (const [kind, [count, job]] of Object.entries(kinds)) {
    writeFileSync(
      join(folder, 'jobs.jsonl'),
      Array.from({ length: count }, (_, i) => JSON.stringify(job(i))).join('\n'),
    );
    for (const workers of [1, 2]) {
      const [load] = loadavg();
      const before = childTime();
      const output = `${kind}-${workers}`;
      const { perSecond } = JSON.parse(run('batch', 'jobs.jsonl', '-o', output, '--workers', String(workers)));
      const name = `${count} x ${kind.replaceAll(',', ' and')} / ${workers} worker${workers > 1 ? 's' : ''}`;
      print(name, 'jobs_per_s', perSecond);
      print(name, 'cpu_ms', ((childTime() - before) / count).toFixed(1));
      print(name, 'load', load.toFixed(1));
    }
  }
} finally {
  rmSync(folder, { recursive: true, force: true });
}
