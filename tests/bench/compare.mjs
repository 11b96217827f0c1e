// Compares figures with the last ones recorded on this kind of machine, and records them when asked to.
//   node tests/bench/compare.mjs FIGURES.csv [--record]
// results.csv: date,commit,machine,benchmark,case,metric,value. Times and memory ("ms", "us", "MB") that changed by more
// than a quarter are shown; a busy machine changes them too, so nothing fails.
import { execFileSync } from 'node:child_process';
import { appendFileSync, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { cpus } from 'node:os';
import { fileURLToPath } from 'node:url';

const results = fileURLToPath(new URL('results.csv', import.meta.url));
const [file, option] = process.argv.slice(2);
const machine = `${cpus().length} x ${cpus()[0].model}`.replaceAll(',', ' ');
const rows = (path) =>
  readFileSync(path, 'utf8')
    .split('\n')
    .filter(Boolean)
    .map((line) => line.split(','));

const last = new Map();
if (existsSync(results)) {
  for (const [, commit, where, ...figure] of rows(results).slice(1)) {
    if (where === machine) last.set(figure.slice(0, 3).join(','), { commit, value: Number(figure[3]) });
  }
}
const figures = rows(file).filter((row) => row.length === 4);
for (const [benchmark, name, metric, value] of figures) {
  const before = last.get([benchmark, name, metric].join(','));
  if (!before || !/\b(ms|us|MB)\b/.test(metric)) continue;
  const ratio = Number(value) / before.value;
  if (Math.abs(Math.log(ratio)) < Math.log(1.25) || Number(value) + before.value < 0.02) continue;
  console.log(`${benchmark} ${name} ${metric}: ${before.value} (${before.commit}) -> ${value}, x ${ratio.toFixed(2)}`);
}
console.log(`${figures.length} figures${last.size === 0 ? ', no earlier ones of this kind of machine' : ''}.`);

if (option === '--record') {
  const commit = execFileSync('git', ['rev-parse', '--short', 'HEAD'], { encoding: 'utf8' }).trim();
  const date = new Date().toISOString().slice(0, 10);
  if (!existsSync(results)) writeFileSync(results, 'date,commit,machine,benchmark,case,metric,value\n');
  appendFileSync(results, figures.map((figure) => `${[date, commit, machine, ...figure].join(',')}\n`).join(''));
}
