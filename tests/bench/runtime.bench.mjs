// Time of a slider step in the package parsel-runtime: the program evaluated, and handed to the cage of a three.js scene.
//
//   node tests/bench/runtime.bench.mjs            (after `npm ci` in web/)
//
// Prints CSV `benchmark,case,metric,value`. The TypeScript is bundled as for the package, then run by this very Node, which
// draws nothing: what is measured is all the script of a step.
import { mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const { rolldown } = await import(pathToFileURL(join(here, '../../web/node_modules/rolldown/dist/index.mjs')).href);

async function load() {
  const folder = mkdtempSync(join(tmpdir(), 'parsel-bench-'));
  try {
    const input = join(here, 'runtime_bench_entry.ts');
    const bundle = await rolldown({ input, resolve: { modules: [join(here, '../../web/node_modules')] } });
    const file = join(folder, 'bundle.mjs');
    await bundle.write({ file, format: 'esm', codeSplitting: false });
    return await import(pathToFileURL(file).href);
  } finally {
    rmSync(folder, { recursive: true });
  }
}

const print = (name, metric, value) => console.log(`runtime,${name},${metric},${value}`);

/** Microseconds per call, median and least of `rounds` rounds: a busy machine spoils the median only. */
function time(run, calls, rounds = 9) {
  const found = [];
  for (let r = 0; r < rounds; ++r) {
    const start = process.hrtime.bigint();
    for (let i = 0; i < calls; ++i) run(r * calls + i);
    found.push(Number(process.hrtime.bigint() - start) / 1000 / calls);
  }
  found.sort((a, b) => a - b);
  return { median: found[Math.floor(rounds / 2)], least: found[0] };
}

console.log('benchmark,case,metric,value');
for (const { name, prepare } of (await load()).cases) {
  const { parts, kilobytes, times, names, evaluate, slide } = await prepare();
  print(name, 'parts', parts);
  print(name, 'sliders_kB', kilobytes.toFixed(1));
  for (const [step, milliseconds] of Object.entries(times)) print(name, `${step}_ms`, milliseconds.toFixed(2));
  const valueAt = (i) => 0.2 * Math.sin(0.001 * i);
  for (const [metric, run] of [
    ['evaluation_us', (i) => evaluate(valueAt(i))],
    ['slider_step_us', (i) => slide(names[i % names.length], valueAt(i))],
  ]) {
    for (let i = 0; i < 2000; ++i) run(i);
    const { median, least } = time(run, 500);
    print(name, metric, median.toFixed(2));
    print(name, `${metric}_least`, least.toFixed(2));
  }
}
