// How many plain requests are read without a language model, and what becomes of the others: a table by kind of request.
//
//   node tests/eval/plain.mjs [--parsel TOOL] [--list]        (after a native build of the command-line tool)
//
// taken    it is sure of them
// as said  of these, those whose statements, hints and amount have the very form that was written down beforehand. What
//          comes to the same mesh in another form is no fault; core_tests judges that: -tc="*plain requests*"
// asked    of those that must be asked about, the ones that it is not sure of
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const { values: options } = parseArgs({ options: { parsel: { type: 'string' }, list: { type: 'boolean' } } });
const builds = ['native-release', 'native-debug'].map((preset) => join(root, 'build', preset, 'core', 'parsel'));
const tool = options.parsel ?? builds.find(existsSync);
if (tool === undefined) throw new Error('There is no build of the command-line tool; give one with --parsel.');

const scratch = mkdtempSync(join(tmpdir(), 'parsel-plain-'));
process.on('exit', () => rmSync(scratch, { recursive: true }));
execFileSync(tool, ['gallery', scratch], { stdio: 'ignore' });

const unit = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };
const sides = { left: 'x', right: '-x', up: 'y', down: '-y', front: 'z', back: '-z' };
/** "-y", "up", [0, -1, 0] → the axis, and whether it points down it. */
function axisOf(direction) {
  const text = sides[direction] ?? direction;
  const vector = typeof text === 'string' ? unit[text.replace('-', '')].map((v) => (text[0] === '-' ? -v : v)) : text;
  const axis = vector.findIndex((v) => Math.abs(v) > 0.5);
  return { axis, minus: vector[axis] < 0 };
}

/** A statement without what may differ: its origin and by how much it is scaled. */
function form({ op, part, relation, feature = [0, 0, 0], direction, normal, axis, amount }) {
  const way = direction ?? axis ?? normal;
  const along = way === undefined ? {} : axisOf(way);
  const flips = op === 'translate' || op === 'rotate';
  const minus = amount.startsWith('-') !== (flips && along.minus === true);
  return [op, part ?? relation, feature.join(), along.axis ?? '', minus ? '-' : '+'].join(' ');
}
const forms = (statements) => statements.map(form).sort().join('; ');
const number = (target) => ['by', 'to', 'times'].map((kind) => `${kind} ${target?.[kind]?.toFixed(6)}`).join(' ');

function asSaid({ edits, or = [], hints = {}, target = null }, { edit, plain }) {
  const own = forms(edit.seed);
  const fits = [edits, ...or].some((one) => forms(one) === own);
  return (
    fits &&
    JSON.stringify(Object.entries(hints).sort()) === JSON.stringify(Object.entries(edit.hints).sort()) &&
    number(target) === number(plain.readings[0].target)
  );
}

for (const name of ['plain', 'plain_unseen', 'plain_traps']) {
  const rows = new Map();
  for (const entry of JSON.parse(readFileSync(join(root, 'tests', 'eval', `${name}.json`), 'utf8'))) {
    const { model, request, kind, mentioned = [], ask = false } = entry;
    const mentions = mentioned.flatMap((part) => ['--mention', part]);
    const given = ['read', join(scratch, `${model}.glb`), '--request', request, ...mentions];
    const read = JSON.parse(execFileSync(tool, given, { encoding: 'utf8' }));
    const { sure, reason, unused, readings } = read.plain;
    const key = ask ? 'to be asked about' : kind;
    const row = rows.get(key) ?? { requests: 0, taken: 0, 'as said': 0, asked: 0 };
    const same = sure && !ask && asSaid(entry, read);
    row.requests += 1;
    row.taken += sure ? 1 : 0;
    row['as said'] += same ? 1 : 0;
    row.asked += sure ? 0 : 1;
    rows.set(key, row);
    if (options.list)
      console.log(
        `${sure ? (same ? '=' : '+') : '?'} ${model}: ${request}  |  ${
          sure ? readings[0].words : [reason, ...unused.map((word) => `“${word}”`)].filter(Boolean).join(' ')
        }`,
      );
  }
  const all = [...rows.entries()].filter(([kind]) => kind !== 'to be asked about').map(([, row]) => row);
  const sum = (column) => all.reduce((total, row) => total + row[column], 0);
  rows.set('all plain ones', {
    requests: sum('requests'),
    taken: sum('taken'),
    'as said': sum('as said'),
    asked: sum('asked'),
  });
  console.log(`\n${name}.json`);
  console.table(Object.fromEntries(rows));
}
