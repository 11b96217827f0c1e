// The measured requests as a page: the table of the variants, where readings and where the search were wrong, and every
// request with pictures at rest, where it was judged, and at the slider's end.
//   node tests/eval/judged_requests.mjs paper --json FILE && node tests/eval/paper/report.mjs FILE [--out FOLDER]
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { draw, frameOf, png } from '../draw.mjs';
import { escaped, pageOf, table } from '../html.mjs';
import { openResults } from './frames.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { out: { type: 'string' } } });
const [file] = positionals;
if (file === undefined) throw new Error('usage: node report.mjs FILE [--out FOLDER]');
const side = 260;
const shown = ['voted', 'one go'];
const names = ['one go', 'seed only', 'one reply', 'few calls', 'voted', 'other reading'];

const { set, summary, pairs } = await openResults(file);
const out = values.out ?? fileURLToPath(new URL(`../../output/eval/${set}`, import.meta.url));
mkdirSync(join(out, 'pictures'), { recursive: true });

const percent = (share) => `${(100 * share).toFixed(1)} %`;
const rows = names.flatMap((name) => {
  const figures = summary[name];
  if (!figures) return [];
  return [
    [
      name,
      figures.requests,
      `${figures.met} (${percent(figures['met, share'])})`,
      percent(figures.predicates),
      percent(figures['relations kept']),
      percent(figures['clean edits']),
    ],
  ];
});

function verdictOf(name, result) {
  if (!result) return '';
  const lost = result.lost?.length ? `; relations lost: ${result.lost.join(', ')}` : '';
  const why = result.why ? `: ${result.why}` : '';
  return `<li><b>${name}</b> ${result.good} of ${result.of}${escaped(why)}${escaped(lost)}</li>`;
}

const figures = [];
for (const [n, { row, rest, at }] of pairs.entries()) {
  process.stderr.write(`\rpictures ${n + 1} of ${pairs.length}\x1b[K`);
  const pictures = [['at rest', rest]];
  for (const name of shown) {
    const { program, slider } = row[name] ?? {};
    if (!program) continue;
    const { max } = program.layers[0].parameter;
    pictures.push([`${name}, slider ${slider.toFixed(2)}`, await at(name, slider)]);
    pictures.push([`${name}, its end ${max.toFixed(2)}`, await at(name, max)]);
  }
  const images = pictures.map(([words, nodes], i) => {
    const picture = `pictures/${row.index}_${i}.png`;
    writeFileSync(join(out, picture), png(draw(nodes, frameOf([rest, nodes]), side), side, side));
    return `<img src="${picture}" alt="${escaped(words)}" title="${escaped(words)}" style="width:19%">`;
  });
  const blamed = row.blame ? ` — ${row.blame}` : '';
  figures.push(
    `<figure><figcaption><b>${row.index} ${escaped(row.model)}</b> ${escaped(row.request)}${escaped(blamed)}</figcaption>${images.join(' ')}<ul>${names.map((name) => verdictOf(name, row[name])).join('')}</ul></figure>`,
  );
}
process.stderr.write('\n');

const head = ['variant', 'requests', 'met', 'predicates', 'relations kept', 'clean edits'];
const body = `<div class="wide">${table(head, rows)}</div><p>Of each: at rest; ${shown.join(', then ')}, where it is judged and at the slider's end.</p>${figures.join('')}`;
writeFileSync(join(out, 'report.html'), pageOf(`Requests: ${set}`, body));
writeFileSync(join(out, 'report.json'), `${JSON.stringify({ set, summary }, null, 1)}\n`);
process.stdout.write(`${join(out, 'report.html')}\n`);
