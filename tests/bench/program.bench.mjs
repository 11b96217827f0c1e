// Time and allocation of the slider path: a 100-part, 200-statement program evaluated on every frame.
//
//   node --expose-gc tests/bench/program.bench.mjs            (after `npm ci` in web/)
//
// Prints CSV `benchmark,case,metric,value`. The TypeScript is bundled as for the page, then run by this very Node.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { PerformanceObserver } from 'node:perf_hooks';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const { rolldown } = await import(pathToFileURL(join(here, '../../web/node_modules/rolldown/dist/index.mjs')).href);

async function load() {
  const folder = mkdtempSync(join(tmpdir(), 'parsel-bench-'));
  try {
    const entry = join(here, 'program_bench_entry.ts');
    const bundle = await rolldown({ input: entry, resolve: { modules: [join(here, '../../web/node_modules')] } });
    const file = join(folder, 'bundle.mjs');
    await bundle.write({ file, format: 'esm' });
    return await import(pathToFileURL(file).href);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const print = (name, metric, value) => console.log(`program,${name},${metric},${value}`);

function median(values) {
  return values.sort((a, b) => a - b)[Math.floor(values.length / 2)];
}

/** Microseconds per call, median and least of `rounds` rounds of `calls` calls: a busy machine spoils the median only. */
function time(run, calls, rounds = 9) {
  const found = [];
  for (let r = 0; r < rounds; ++r) {
    const start = process.hrtime.bigint();
    for (let i = 0; i < calls; ++i) run(r * calls + i);
    found.push(Number(process.hrtime.bigint() - start) / 1000 / calls);
  }
  return { median: median(found), least: Math.min(...found) };
}

/**
 * Bytes allocated per call, on the JS heap and in array buffers. It counts only if no collection came in between, so the
 * number of collections is returned as well and must be 0.
 */
async function bytes(run, calls) {
  let collections = 0;
  const observer = new PerformanceObserver((list) => {
    collections += list.getEntries().length;
  });
  global.gc();
  observer.observe({ entryTypes: ['gc'] });
  const before = process.memoryUsage();
  for (let i = 0; i < calls; ++i) run(i);
  const after = process.memoryUsage();
  await new Promise((resolve) => setTimeout(resolve, 20));
  observer.disconnect();
  const grown = after.heapUsed - before.heapUsed + after.arrayBuffers - before.arrayBuffers;
  return { perCall: grown / calls, collections };
}

const { cases } = await load();
console.log('benchmark,case,metric,value');
for (const { name, prepare } of cases) {
  const { evaluator, layers, statements, parts, checkTime, compileTime } = prepare();
  const values = new Float64Array(layers);
  const frame = (i) => {
    for (let j = 0; j < layers; ++j) values[j] = Math.sin(0.001 * i + j);
    evaluator.evaluate(values);
  };
  const firstStart = process.hrtime.bigint();
  frame(0);
  const first = Number(process.hrtime.bigint() - firstStart) / 1000;
  print(name, 'parts', parts);
  print(name, 'statements', statements);
  print(name, 'check_ms', checkTime.toFixed(3));
  print(name, 'compile_ms', compileTime.toFixed(3));
  print(name, 'first_evaluation_us', first.toFixed(1));
  for (let i = 0; i < 5000; ++i) frame(i);
  const { median: typical, least } = time(frame, 1000);
  print(name, 'evaluation_us', typical.toFixed(2));
  print(name, 'evaluation_us_least', least.toFixed(2));
  if (!global.gc) continue;
  // 1e5 evaluations, fewer of the slow ones.
  const calls = Math.min(100_000, Math.ceil(1e7 / typical));
  const { perCall, collections } = await bytes(frame, calls);
  print(name, 'bytes_per_evaluation', perCall.toFixed(3));
  print(name, 'collections_meanwhile', collections);
}
if (!global.gc) console.error('run with --expose-gc for bytes per evaluation');
