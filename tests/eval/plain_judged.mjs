// Plain requests on other people's models, judged by what comes of them: predicates on the edited file (predicates.mjs),
// written down before any request was read.
//
//   node tests/eval/plain_judged.mjs [--parsel TOOL] [--only TEXT] [--held-out | --all | --unseen] [--list]
//
// Models: the gallery's, $PARSEL_DATA/furniture, and Debian's (furniture.sh: in $PARSEL_CACHE, else ~/.cache/parsel); those
// that are not there are left out, and counted. A third of plain_judged.json is held out: it was not looked at while words and
// rules were mended the first time, but was the second; plain_judged_unseen.json (--unseen) was written after that.
// --only: models or requests with this text.
//
// taken    the reader is sure
// right    of these, all predicates hold where the request says (10 cm), else at 0.2 of the slider; at its end for counts.
//          A size has changed when it did so by 0.01 half-diagonals or by a twentieth of itself
// clean    of these, the program breaks no relation that the edit does not give up
// asked    of those that cannot be known or done, the ones that it is not sure of
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { homedir, tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { judge, readNodes } from './predicates.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const text = { type: 'string' };
const flag = { type: 'boolean' };
const { values: options } = parseArgs({
  options: { parsel: text, only: text, 'held-out': flag, all: flag, unseen: flag, list: flag },
});
const builds = ['native-release', 'native-debug'].map((preset) => join(root, 'build', preset, 'core', 'parsel'));
const tool = options.parsel ?? builds.find(existsSync);
if (tool === undefined) throw new Error('There is no build of the command-line tool; give one with --parsel.');

const scratch = mkdtempSync(join(tmpdir(), 'parsel-judged-'));
process.on('exit', () => rmSync(scratch, { recursive: true }));
const file = (name) => join(scratch, name);
const run = (...given) =>
  execFileSync(tool, given, { encoding: 'utf8', maxBuffer: 1 << 28, stdio: ['ignore', 'pipe', 'pipe'] });
run('gallery', scratch);

const cache = process.env.PARSEL_CACHE ?? join(homedir(), '.cache', 'parsel');
const folders = [
  scratch,
  process.env.PARSEL_DATA ? join(process.env.PARSEL_DATA, 'furniture') : null,
  join(cache, 'eval', 'models'),
];
const pathOf = (model) =>
  folders
    .filter(Boolean)
    .map((folder) => join(folder, `${model}.glb`))
    .find(existsSync);

const opened = new Map();
/** {path, shape, rest}, the shape also as a file; null when the model is not there. */
async function open(model) {
  if (!opened.has(model)) {
    const path = pathOf(model);
    if (path === undefined) opened.set(model, null);
    else {
      run('inspect', path, '-o', file(`${model}.shape.json`));
      const shape = JSON.parse(readFileSync(file(`${model}.shape.json`), 'utf8'));
      opened.set(model, {
        path,
        shape,
        shapePath: file(`${model}.shape.json`),
        rest: await readNodes(readFileSync(path)),
      });
    }
  }
  return opened.get(model);
}

const axes = { width: 0, height: 1, depth: 2 };
/** What a target is about, of corners: the whole's size, a part's edge or how far it went, in the file's unit; null for
 * counts, angles and the like. */
function measureOf({ part, what }, scale, start) {
  const distance = (a, b) => Math.hypot(...[0, 1, 2].map((k) => a[k] - b[k])) * scale;
  if (part === null && what in axes) {
    return (parts) => {
      const along = Object.values(parts).flatMap((corners) => corners.map((corner) => corner[axes[what]]));
      return (Math.max(...along) - Math.min(...along)) * scale;
    };
  }
  if (what in axes) return (parts) => distance(parts[part][0], parts[part][2 ** axes[what]]);
  return what === 'distance' ? (parts) => distance(parts[part][0], start[part][0]) : null;
}

let core = null;
/** Beyond its end the page stretches a slider as far as all holds (web/src/session/extend.ts); as it does, to file. */
async function stretched(program, path, to) {
  core ??= await loadCore();
  core('open', { name: program.shape.name, external: [] }, [readFileSync(path)]);
  const extended = core('extend', { program, layer: 0, to }).result.program;
  writeFileSync(file('program.json'), JSON.stringify(extended));
  return extended;
}

/** Where the slider must stand for the target: the secant method from where the seed alone puts it. */
async function sliderAt(target, { path, shape, shapePath }, program) {
  const stateAt = (x) => JSON.parse(run('evaluate', shapePath, file('program.json'), '--set', `x1=${x}`)).parts;
  let { max } = program.layers[0].parameter;
  if (target.x > max) ({ max } = (await stretched(program, path, 1.3 * target.x)).layers[0].parameter);
  const within = (x) => Math.min(max, Math.max(0, x));
  const start = stateAt(0);
  const measure = measureOf(target, shape.frame.scale, start);
  if (measure === null) return within(target.x);
  const rest = measure(start);
  const wanted = target.to ?? (target.times === undefined ? rest + target.by : rest * target.times);
  let [before, was] = [0, rest];
  let x = within(target.x);
  for (let round = 0; round < 6; ++round) {
    const is = measure(stateAt(x));
    if (Math.abs(is - wanted) < 1e-5 || is === was) break;
    const next = within(x + ((wanted - is) * (x - before)) / (is - was));
    [before, was, x] = [x, is, next];
  }
  return x;
}

async function verdict(model, { predicates }, { edit, plain }) {
  writeFileSync(file('edit.json'), JSON.stringify(edit));
  const { path, shapePath, rest } = model;
  try {
    run('propagate', shapePath, file('edit.json'), '-o', file('program.json'));
  } catch (error) {
    return { right: false, clean: false, why: `refused: ${String(error.stderr).trim().split('\n')[0]}` };
  }
  const program = JSON.parse(readFileSync(file('program.json'), 'utf8'));
  const { max } = program.layers[0].parameter;
  const { target } = plain.readings[0];
  const counts = edit.seed.some(({ op }) => op === 'change_count');
  const slider = target ? await sliderAt(target, model, program) : counts ? max : Math.min(0.2, max);
  run('apply', path, file('program.json'), '--set', `x1=${slider}`, '--force', '-o', file('edited.glb'));
  const now = await readNodes(readFileSync(file('edited.glb')));
  const wrong = predicates
    .map((predicate) => ({ predicate, ...judge(predicate, rest, now, 1 / 20) }))
    .filter(({ ok }) => !ok);
  const lost = program.layers[0].relations.filter(({ status }) => status === 'broken').map(({ id }) => id);
  return {
    right: wrong.length === 0,
    clean: lost.length === 0,
    why: [
      ...wrong.map(({ predicate, why }) => `${JSON.stringify(predicate)} ${why}`),
      ...(lost.length > 0 ? [`broken: ${lost.join(' ')}`] : []),
    ].join('; '),
  };
}

const counted = ['requests', 'taken', 'right', 'clean', 'asked'];
const rows = new Map();
const missing = new Set();
const requests = options.unseen ? 'plain_judged_unseen.json' : 'plain_judged.json';
for (const entry of JSON.parse(readFileSync(join(root, 'tests', 'eval', requests), 'utf8'))) {
  if (!options.all && !options.unseen && (entry.held_out ?? false) !== (options['held-out'] ?? false)) continue;
  if (options.only && !`${entry.model}: ${entry.request}`.includes(options.only)) continue;
  const model = await open(entry.model);
  if (model === null) {
    missing.add(entry.model);
    continue;
  }
  const read = JSON.parse(run('read', model.shapePath, '--request', entry.request));
  const { sure, reason, unused, readings } = read.plain;
  const result = sure && !entry.ask ? await verdict(model, entry, read) : null;
  for (const key of [entry.ask ? 'to be asked about' : entry.kind, ...(entry.ask ? [] : ['all plain ones'])]) {
    const row = rows.get(key) ?? Object.fromEntries(counted.map((column) => [column, 0]));
    row.requests += 1;
    row.taken += sure ? 1 : 0;
    row.right += result?.right ? 1 : 0;
    row.clean += result?.clean ? 1 : 0;
    row.asked += sure ? 0 : 1;
    rows.set(key, row);
  }
  if (!options.list) continue;
  const mark = !sure ? '?' : entry.ask ? '!' : result.right ? (result.clean ? '=' : '~') : '!';
  const words = sure ? readings[0].words : [reason, ...unused.map((word) => `“${word}”`)].filter(Boolean).join(' ');
  console.log(`${mark} ${entry.model}: ${entry.request}  |  ${words}${result?.why ? `\n      ${result.why}` : ''}`);
}
const last = ['all plain ones', 'to be asked about'];
const order = [...rows.keys()].filter((key) => !last.includes(key)).concat(last.filter((key) => rows.has(key)));
console.table(Object.fromEntries(order.map((key) => [key, rows.get(key)])));
if (missing.size > 0) console.log(`${missing.size} models are not there: ${[...missing].join(', ')}`);
