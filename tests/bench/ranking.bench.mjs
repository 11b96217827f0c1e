// The paper's own selection (core/family/ranking.h) in WebAssembly, on its chair with 1 % of noise on hand-made variations, which
// are read from PARSEL_DATA: the whole command line, the start of the module included. Needs web/headless/dist (npm run headless).
//
//   PARSEL_DATA=… node tests/bench/ranking.bench.mjs
//
// Prints CSV `benchmark,case,metric,value`; processor time, median of five seeds.
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const data = join(process.env.PARSEL_DATA ?? '', 'reparamcad.json');
if (!existsSync(data)) {
  process.stderr.write('skipped: PARSEL_DATA names no folder with reparamcad.json\n');
  process.exit(0);
}
const { primitives, votes } = JSON.parse(readFileSync(data, 'utf8')).models.chair;
const idOf = (name) => name.replaceAll(/\W/g, '');
const names = primitives.flatMap(({ name }) =>
  ['cx', 'cy', 'cz', 'sx', 'sy', 'sz'].map((what) => `${idOf(name)}.${what}`),
);
const parts = primitives.map(({ name, centre, size }) => {
  const id = idOf(name);
  return { id, label: id, name: id, kind: 'box', centre, size, role: 'add' };
});

/** Standard normal numbers, the same for the same seed (mulberry32, Box–Muller). */
function normal(seed) {
  let state = seed;
  const unit = () => {
    state = (state + 0x6d2b79f5) | 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
  return () => Math.sqrt(-2 * Math.log(1 - unit())) * Math.cos(2 * Math.PI * unit());
}

const work = mkdtempSync(join(tmpdir(), 'parsel-ranking-'));
process.on('exit', () => rmSync(work, { recursive: true }));
const [program, variations] = ['chair.json', 'variations.json'].map((name) => join(work, name));
writeFileSync(program, JSON.stringify({ format: 'parsel/cad', version: 1, name: 'chair', unit: 'm', parts }));
const tool = join(dirname(fileURLToPath(import.meta.url)), '../../web/headless/dist/parsel.js');

const times = [1, 2, 3, 4, 5].map((seed) => {
  const next = normal(seed);
  const noisy = Object.entries(votes[0].variations).map(([name, { parameters, absent }]) => ({
    name,
    values: Object.fromEntries(
      parameters.map((value, i) => [
        names[i],
        names[i].includes('.s') ? Math.max(value + 0.01 * next(), 1e-3) : value + 0.01 * next(),
      ]),
    ),
    absent: absent.map(idOf),
  }));
  writeFileSync(variations, JSON.stringify({ format: 'parsel/variations', version: 1, variations: noisy }));
  const asked = ['family', program, '--variations', variations, '--vocabulary', 'paper', '--select', 'ranking'];
  const script = `const { cpuUsage } = process; process.on('exit', () => process.stderr.write('cpu ' + (cpuUsage().user + cpuUsage().system) + '\\n'));`;
  const { status, stderr } = spawnSync(
    process.execPath,
    ['--import', `data:text/javascript,${encodeURIComponent(script)}`, tool, ...asked, '-o', join(work, 'family.json')],
    { encoding: 'utf8' },
  );
  if (status !== 0) throw new Error(stderr);
  return Number(/cpu (\d+)/.exec(stderr)?.[1]) / 1e6;
});
times.sort((a, b) => a - b);
process.stdout.write(`ranking wasm,chair with noise,median s,${times[2].toFixed(2)}\n`);
process.stdout.write(`ranking wasm,chair with noise,worst s,${times[4].toFixed(2)}\n`);
