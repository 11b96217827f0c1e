// How many times faster than the paper's procedure in SymPy we are, in one run: sympy_baseline.py on the smallest cases
// of the gallery, against the times that bench_propagate has just measured for the same shape and edit.
//   node tests/bench/sympy_ratio.mjs FOLDER SECONDS
// FOLDER holds the gallery (parsel gallery) and figures.csv; every case may take SECONDS. What does not finish by then is
// counted with the time that it has taken, so its ratio is a lower bound.
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const cases = ['floor_lamp/raise', 'bar_stool/widen', 'dining_table/widen'];
const [folder, seconds] = process.argv.slice(2);
const tool = fileURLToPath(new URL('../../build/native-release/core/parsel', import.meta.url));
const baseline = fileURLToPath(new URL('sympy_baseline.py', import.meta.url));
const gallery = JSON.parse(readFileSync(join(folder, 'gallery.json'), 'utf8'));
const figures = readFileSync(join(folder, 'figures.csv'), 'utf8')
  .split('\n')
  .map((line) => line.split(','));

for (const name of cases) {
  const [model, id] = name.split('/');
  const { requests } = gallery.find((entry) => entry.id === model);
  const shape = join(folder, `${model}.json`);
  const edit = join(folder, `${id}.json`);
  writeFileSync(edit, JSON.stringify(requests.find((request) => request.id === id).edit));
  execFileSync(tool, ['inspect', join(folder, `${model}.glb`), '-o', shape]);
  const options = ['--sample', '0', '--seconds', seconds];
  const text = execFileSync('/usr/bin/python3', [baseline, shape, edit, ...options], { encoding: 'utf8' });
  process.stdout.write(text.slice(text.indexOf('\n') + 1));
  const theirs = Number(text.match(/,seconds_measured,(.*)/)[1]);
  const ours = Number(figures.find((row) => row[0] === 'propagate' && row[1] === name && row[2] === 'ms')[3]) / 1000;
  console.log(`sympy_ratio,${name},times faster,${Math.round(theirs / ours)}`);
}
