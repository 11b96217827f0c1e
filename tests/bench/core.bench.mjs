// The core as the page's worker runs it: the WebAssembly module under Node, warm. Abstraction and propagation of the
// gallery's models, of the models given and of furniture (PARSEL_DATA, if set), and the module's memory.
//
//   node tests/bench/core.bench.mjs [MODEL.glb…]            (after ./web/start.sh --build-only)
//
// Prints CSV `benchmark,case,metric,value`; times are medians of five and of the first call, which is the one that a person waits for
// when opening a model; processor time, so that a busy machine does not disturb them.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { loadCore } from '../../web/tools/core.mjs';

/** A module of its own, so that its memory is that of one model; warm, as the worker makes it at start. */
async function fresh() {
  const call = await loadCore();
  call('warm_up', {});
  return call;
}

const print = (benchmark, name, metric, value) => console.log(`${benchmark},${name},${metric},${value}`);
const median = (values) => values.sort((a, b) => a - b)[values.length >> 1];

function milliseconds(run, rounds = 5) {
  const times = [];
  for (let i = 0; i < rounds; ++i) {
    const start = process.cpuUsage();
    run();
    const { user, system } = process.cpuUsage(start);
    times.push((user + system) / 1000);
  }
  return { first: times[0], median: median(times) };
}

/** The same seed as in bench_propagate.cpp: the part that is longest along x, scaled along it. */
function widen({ parts }) {
  const grouped = new Set(parts.flatMap((part) => part.members ?? []));
  let longest = 0;
  let chosen;
  for (const part of parts) {
    if (part.virtual || grouped.has(part.id)) continue;
    const xs = part.corners.map((corner) => corner[0]);
    const extent = Math.max(...xs) - Math.min(...xs);
    if (extent > longest + 1e-9) [longest, chosen] = [extent, part.id];
  }
  const origin = { part: chosen, at: [0, 0, 0] };
  return { seed: [{ op: 'scale_1d', part: chosen, origin, direction: [1, 0, 0], amount: 'x' }] };
}

/** Opens one model in a module of its own and times what can be asked of it. */
async function model(set, name, file, requests, all) {
  const call = await fresh();
  const open = () => call('open', { name, external: [] }, [file]);
  const opening = milliseconds(open);
  const { shape } = open().result;
  print('abstraction wasm', name, 'parts', shape.parts.length);
  print('abstraction wasm', name, 'first ms', opening.first.toFixed(1));
  print('abstraction wasm', name, 'ms', opening.median.toFixed(1));
  print('abstraction wasm', name, 'memory MB', (call('memory', {}).result.bytes / 1e6).toFixed(1));
  for (const { id, edit } of requests(shape)) {
    const { median: time } = milliseconds(() => call('propagate', { edit }));
    print('propagate wasm', `${name}/${id}`, 'ms', time.toFixed(2));
    all[set].push(time);
  }
}

const all = { gallery: [], given: [], furniture: [] };
const gallery = (await fresh())('gallery', {});
for (const [index, entry] of gallery.result.models.entries()) {
  await model('gallery', entry.id, gallery.buffers[index], () => entry.requests, all);
}

for (const path of process.argv.slice(2)) {
  const requests = (shape) => [{ id: 'widen', edit: widen(shape) }];
  await model('given', basename(path, '.glb'), readFileSync(path), requests, all);
}

const furniture = join(process.env.PARSEL_DATA ?? '', 'furniture');
if (process.env.PARSEL_DATA && existsSync(furniture)) {
  for (const file of readdirSync(furniture).sort()) {
    if (!file.endsWith('.glb')) continue;
    const requests = (shape) => [{ id: 'widen', edit: widen(shape) }];
    await model('furniture', file.slice(0, -4), readFileSync(join(furniture, file)), requests, all);
  }
} else {
  console.error('furniture is skipped: PARSEL_DATA is not set');
}

for (const [set, times] of Object.entries(all)) {
  if (times.length === 0) continue;
  print('propagate wasm', set, 'median ms', median(times).toFixed(2));
  print('propagate wasm', set, 'worst ms', Math.max(...times).toFixed(2));
}
