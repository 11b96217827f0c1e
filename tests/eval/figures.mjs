// The project's figures, each from where it was measured: writes OUTPUT/index.html, which leads to the reports, and with
// --readme puts the tables between their marks in README.md, tests/bench/README.md and tests/eval/README.md.
//   node tests/eval/figures.mjs OUTPUT [--readme]
// OUTPUT: the folder that tests/eval/run.sh fills (debian/, furniture/, requests.json). Speed and sizes are the last
// record of tests/bench/results.csv (tests/bench/run.sh --record).
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from '../../web/tools/core.mjs';
import { escaped, pageOf, table } from './html.mjs';

const [output, option] = process.argv.slice(2);
if (output === undefined) throw new Error('usage: node figures.mjs OUTPUT [--readme]');
const read = (name) => {
  const file = join(output, name);
  if (!existsSync(file)) throw new Error(`${file} is missing: run tests/eval/run.sh without arguments first.`);
  return JSON.parse(readFileSync(file, 'utf8'));
};
const debian = read('debian/report.json');
const furniture = existsSync(join(output, 'furniture')) ? read('furniture/report.json') : null;
const requests = read('requests.json');

// ----------------------------------------------------------------------------------------------------- benchmarks

/** The last value of every figure, with the day and commit that it is of. */
const recorded = new Map();
for (const line of readFileSync(join(root, 'tests/bench/results.csv'), 'utf8').trim().split('\n').slice(1)) {
  const [date, commit, machine, benchmark, name, metric, value] = line.split(',');
  recorded.set(`${benchmark},${name},${metric}`, { date, commit, machine, benchmark, name, metric, value });
}
/** A recorded figure, with as many digits as say something. */
function bench(benchmark, name, metric, digits = 2, scale = 1) {
  const found = recorded.get(`${benchmark},${name},${metric}`);
  if (found === undefined)
    throw new Error(`results.csv has no ${benchmark}, ${name}, ${metric}: run tests/bench/run.sh.`);
  return significant(Number(found.value) * scale, digits);
}
const significant = (value, digits = 2) =>
  Number(value.toPrecision(digits)).toLocaleString('en', { maximumFractionDigits: 6 });

// --------------------------------------------------------------------------------------------------------- tables

const share = (part, whole, digits = 1) => `${((100 * part) / whole).toFixed(digits)} %`;
const run = '`tests/bench/run.sh`';
const evaluation = '`tests/eval/run.sh`';
const sympy = 'floor_lamp/raise';
const walls = [5, 10, 20, 50, 100];
const uncertified = ({ relations, certified }) =>
  relations === certified ? 'all certified' : `certified but for ${relations - certified}`;

const numbers = [
  ['what', 'aim', 'measured', 'command'],
  [
    'propagation, WebAssembly under Node, warm: 56 gallery edits, median / worst',
    '20 / 500 ms',
    `${bench('propagate wasm', 'gallery', 'median ms')} / ${bench('propagate wasm', 'gallery', 'worst ms')} ms`,
    run,
  ],
  [
    '… 20 furniture models, widened',
    '20 / 500 ms',
    `${bench('propagate wasm', 'furniture', 'median ms')} / ${bench('propagate wasm', 'furniture', 'worst ms')} ms`,
    'same',
  ],
  [
    'propagation, native: gallery, furniture, median / worst',
    '',
    ['gallery', 'furniture']
      .map((set) => `${bench('propagate', set, 'median ms')} / ${bench('propagate', set, 'worst ms')} ms`)
      .join('; '),
    'same',
  ],
  [
    `… a wall of ${walls.join(', ')} parts, native`,
    '',
    `${walls.map((n) => bench('propagate', `${n} parts`, 'ms')).join(', ')} ms`,
    'same',
  ],
  [
    'the paper’s procedure in SymPy, same shape and edit (floor lamp, raised)',
    '10,000 × slower',
    `more than ${bench('sympy_ratio', sympy, 'times faster')} ×: stopped after ${bench('sympy_baseline', sympy, 'seconds_measured')} s, against ${bench('propagate', sympy, 'ms')} ms`,
    '`tests/bench/run.sh --sympy 60`',
  ],
  [
    'abstraction in the module: 257,000 triangles / 100 parts',
    '1 s',
    `${bench('abstraction wasm', 'shelf_ivar_0678', 'first ms', 2, 1e-3)} / ${bench('abstraction wasm', 'shelf_wall_100', 'first ms', 2, 1e-3)} s`,
    run,
  ],
  [
    'memory of the module with the largest model',
    '',
    `${bench('abstraction wasm', 'shelf_ivar_0678', 'memory MB')} MB`,
    'same',
  ],
  [
    'gallery edits that end where the generator builds the edited model, within 0.5 % of the half-diagonal',
    bench('ablation', 'full', 'gallery edits'),
    bench('ablation', 'full', 'right within 0.5 % of the half-diagonal'),
    'same; `./tests/run.sh`',
  ],
  ...(furniture === null
    ? []
    : [
        [
          `relations held over the whole range: ${furniture.models} furniture models, ${furniture.all.edits} edits`,
          '95 %',
          `${share(furniture.all.held, furniture.all.relations)}, ${uncertified(furniture.all)}`,
          evaluation,
        ],
      ]),
  [
    `… ${debian.models} models of Debian’s sweethome3d-furniture, ${debian.all.edits.toLocaleString('en')} edits`,
    '95 %',
    `${share(debian.all.held, debian.all.relations)}, ${uncertified(debian.all)}`,
    'same',
  ],
  [
    '… failures; edits in which no gap and no overlap is visible',
    '0',
    `${debian.all.failures}; ${share(debian.all.clean, debian.all.edits, 0)}`,
    'same',
  ],
  [
    '… propagation, native: median / 95 % below / worst',
    '',
    `${['median', 'p95', 'worst'].map((which) => significant(debian.all.propagate_ms[which])).join(' / ')} ms`,
    'same',
  ],
  [
    'a slider step with 100 parts: evaluation / all script',
    '0.5 / 2 ms',
    `${bench('page', 'step with 100 parts', 'evaluation_ms')} / ${bench('page', 'step with 100 parts', 'script_ms_with_drawing')} ms`,
    run,
  ],
  [
    'cold start to a moving slider: median (least)',
    '3 s',
    `${bench('page', 'cold start to a moving slider', 'ms', 2, 1e-3)} s (${bench('page', 'cold start to a moving slider', 'ms_least', 2, 1e-3)} s)`,
    'same',
  ],
  ['WebAssembly download, brotli', '1.3 MB', `${bench('page', 'WebAssembly module', 'kB_brotli', 2, 1e-3)} MB`, 'same'],
  [
    'JavaScript before anything shows, gzip',
    '350 kB',
    `${bench('page', 'initial JavaScript', 'kB_gzip', 3)} kB`,
    'same',
  ],
];

/** The rows that the README shows as well, by how they begin. */
const most = [
  'propagation, WebAssembly',
  '… a wall',
  'the paper’s procedure',
  'abstraction',
  'gallery edits',
  'relations held',
  `… ${debian.models} models`,
  'a slider step',
  'cold start',
  'WebAssembly download',
];
const summary = numbers
  .filter(([what], row) => row === 0 || most.some((start) => what.startsWith(start)))
  .map(([what, aim, measured]) => [what, aim, measured]);

const searches = [
  'full',
  'without neighbour edits',
  'without breaking edits',
  'without both',
  'without the second look',
  'without all three',
];
const ablation = [
  ['', 'right', 'mean worst distance', 'gallery relations held (broken)', 'furniture relations held (broken)'],
  ...searches.map((name) => {
    const held = (set) =>
      `${bench('ablation', name, `${set} relations held %`, 3)} % (${bench('ablation', name, `${set} relations broken`)})`;
    const right = bench('ablation', name, 'right within 0.5 % of the half-diagonal');
    return [
      name,
      `${right} of ${bench('ablation', name, 'gallery edits')}`,
      `${bench('ablation', name, 'mean worst distance %')} %`,
      held('gallery'),
      held('furniture'),
    ];
  }),
];

const names = {
  voting: 'three replies, voted (validity: one)',
  'one reply': 'one reply',
  'no examples': '… without worked examples',
  'no thinking': '… without thinking aloud',
  naive: '… without both',
  'one shot': 'the whole program by the language model alone',
  'seed only': 'the voted seed alone, without hints and validity',
  full: 'all of it',
};
const measures = (rows, columns) => [
  ['', ...columns],
  ...Object.entries(rows).map(([name, row]) => [names[name], ...columns.map((column) => row[column].toFixed(2))]),
];
const replies = measures(requests.replies, ['Acc(SE)', 'Acc(R)', 'J(T)', 'Match']);
const programs = measures(requests.programs, ['J(prog)', 'D(geo)', '%Rel', 'meshes']);

// --------------------------------------------------------------------------------------------------------- output

const tables = { numbers, ablation, replies, programs };

const pages = {
  'README.md': { summary },
  'tests/bench/README.md': { numbers, ablation },
  'tests/eval/README.md': { replies, programs },
};
for (const [page, own] of Object.entries(option === '--readme' ? pages : {})) {
  const file = join(root, page);
  let text = readFileSync(file, 'utf8');
  for (const [name, [head, ...rows]] of Object.entries(own)) {
    const [open, close] = [`<!-- figures: ${name} -->\n`, '<!-- end -->'];
    const start = text.indexOf(open);
    const end = text.indexOf(close, start);
    if (start < 0 || end < 0) throw new Error(`${page} has no marks for the table ${name}.`);
    const line = (cells) => `| ${cells.join(' | ')} |\n`;
    const markdown = `${line(head)}|${'---|'.repeat(head.length)}\n${rows.map(line).join('')}`;
    text = text.slice(0, start) + open + markdown + text.slice(end);
  }
  writeFileSync(file, text);
}

const plain = (rows) => rows.map((row) => row.map((cell) => String(cell).replaceAll('`', '')));
const shown = Object.values(tables).map((rows) => {
  const [head, ...body] = plain(rows);
  return `<div class="wide">${table(head, body)}</div>`;
});
const links = ['debian', ...(furniture === null ? [] : ['furniture'])].map(
  (name) => `<li><a href="${name}/report.html">${escaped(name)}: every edit, with pictures</a></li>`,
);
const all = [...recorded.values()].map((row) => [row.benchmark, row.name, row.metric, row.value, row.date, row.commit]);
writeFileSync(
  join(output, 'index.html'),
  pageOf(
    'ParSEL: figures',
    `<ul>${links.join('')}</ul>
<h2>Numbers</h2>${shown[0]}
<h2>What the parts of the search are worth</h2>${shown[1]}
<h2>From words to meshes</h2><p>${requests.rows.length} requests.</p>${shown[2]}${shown[3]}
<h2>Every recorded benchmark</h2><div class="wide">${table(['benchmark', 'case', 'metric', 'value', 'date', 'commit'], all)}</div>`,
  ),
);
process.stdout.write(`${join(output, 'index.html')}\n`);
