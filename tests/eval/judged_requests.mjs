// Requests with predicates that were written down beforehand: what share of them is met, and where the others fail.
//
//   node tests/eval/judged_requests.mjs SET                            measures the recorded replies
//   node tests/eval/judged_requests.mjs SET --write DIR [--votes 3]    writes what has no reply as DIR/<hash>.<vote>.prompt.md
//   node tests/eval/judged_requests.mjs SET --read DIR --model NAME    keeps DIR/<hash>.<vote>.reply.md, unedited
//
// SET: harder   harder.json, on models of the gallery and of $PARSEL_DATA/furniture
//      paper    $PARSEL_DATA/paper: part of the paper's own shapes and requests; nothing of it stands here but the replies,
//               by the hash of their prompt
// --json FILE writes what is printed. A request is met when all of its predicates hold (predicates.mjs) with the first
// slider at 0.2, or at its end when that comes first; numbers of instances are counted at the end, as a count takes whole
// steps. Variants: all replies voted; the first alone; the voted seed without
// hints and validity; and, where the folder has it, somebody else's reading (edits.json), which tells a wrong reading from
// a wrong search. replies/SET.json: {model, date, replies: {hash: [text]}}. Needs the WebAssembly build.
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { judge, readNodes } from './predicates.mjs';

const folder = dirname(fileURLToPath(import.meta.url));
const text = { type: 'string' };
const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: { write: text, read: text, model: text, json: text, votes: { type: 'string', default: '3' } },
});
const [set] = positionals;
const votes = Number(values.votes);
function die(line) {
  process.stderr.write(`${line}\n`);
  process.exit(2);
}
if (set !== 'harder' && set !== 'paper') die('Which set: harder or paper?');
if (!(votes >= 1 && votes <= 9)) die('--votes takes 1 to 9.');
if (values.read && !values.model) die('--model NAME says who answered.');

const data = process.env.PARSEL_DATA || null;
const core = await loadCore();
const gallery = core('gallery', {});

/** The file of a model, or null where it is not to be had. */
function fileOf(model) {
  const index = gallery.result.models.findIndex(({ id }) => id === model);
  if (set === 'harder' && index >= 0) return gallery.buffers[index];
  const file = data && join(data, set === 'paper' ? 'paper' : 'furniture', `${model}.glb`);
  return file && existsSync(file) ? readFileSync(file) : null;
}

function readPairs() {
  if (set === 'harder') return { pairs: JSON.parse(readFileSync(join(folder, 'harder.json'), 'utf8')), edits: {} };
  const file = data && join(data, 'paper', 'pairs.json');
  if (!file || !existsSync(file)) {
    process.stdout.write('PARSEL_DATA has no paper/pairs.json: nothing is measured.\n');
    process.exit(0);
  }
  const { pairs } = JSON.parse(readFileSync(file, 'utf8'));
  const edits = join(data, 'paper', 'edits.json');
  return {
    pairs: pairs.map(({ model, request, assertions }) => {
      // Some of what a person expects is beyond these predicates, and says so.
      const predicates = assertions.flatMap((one) => one.predicates).filter(({ testable }) => testable !== false);
      return { model, request, predicates };
    }),
    edits: existsSync(edits) ? JSON.parse(readFileSync(edits, 'utf8')) : {},
  };
}

const repliesFile = join(folder, 'replies', `${set}.json`);
const kept = existsSync(repliesFile)
  ? JSON.parse(readFileSync(repliesFile, 'utf8'))
  : { model: null, date: null, replies: {} };
const repliesTo = ({ hash }) => (kept.replies[hash] ?? []).filter(Boolean);

/** The edited file with the first slider at 0.2 and at its end; null when there is no program. */
function edited(edit) {
  if (edit === null) return null;
  try {
    const { program } = core('propagate', { edit }).result;
    const { max } = program.layers[0].parameter;
    const [glb, atEnd] = [Math.min(0.2, max), max].map((value) => {
      const at = program.layers.map((_, i) => (i === 0 ? value : 0));
      return core('apply', { program, values: at }).buffers[0];
    });
    const reports = program.layers.flatMap(({ relations }) => relations);
    const held = reports.filter(({ status }) => status === 'held').length;
    const asked = reports.filter(({ status }) => status !== 'disabled').length;
    return { glb, atEnd, held, asked };
  } catch (error) {
    return { refused: error.message };
  }
}

async function verdict(edit, predicates, rest) {
  const result = edited(edit);
  if (result === null) return { good: 0, of: predicates.length, why: 'read as unclear, or not at all' };
  if (result.refused) return { good: 0, of: predicates.length, why: result.refused };
  const [now, end] = [await readNodes(result.glb), await readNodes(result.atEnd)];
  const counts = (predicate) => (predicate.any_of?.flat() ?? [predicate]).some((one) => 'group' in one);
  const judged = predicates.map((predicate) => {
    return { predicate, ...judge(predicate, rest, counts(predicate) ? end : now) };
  });
  const wrong = judged.filter(({ ok }) => !ok);
  return {
    good: judged.length - wrong.length,
    of: judged.length,
    held: result.held,
    asked: result.asked,
    why: wrong.map(({ predicate, why }) => `${JSON.stringify(predicate)} ${why}`).join('; '),
  };
}

const { pairs, edits } = readPairs();
const rendered = [];
for (const [index, pair] of pairs.entries()) {
  const file = fileOf(pair.model);
  if (file === null) {
    process.stdout.write(`${pair.model}: the model is not there, skipped\n`);
    continue;
  }
  core('open', { name: pair.model, external: [] }, [file]);
  const { prompts } = core('prompts', { request: pair.request, mentioned: pair.mentioned ?? [] }).result;
  rendered.push({ ...pair, index, file, prompts });
}

if (values.write || values.read) {
  const prompts = new Map(rendered.flatMap((pair) => pair.prompts.map((prompt) => [prompt.hash, prompt])));
  if (values.write) {
    mkdirSync(values.write, { recursive: true });
    for (const { hash, relation, text: prompt } of prompts.values()) {
      for (let vote = 0; vote < votes; ++vote) {
        // Which symmetries may go is asked once, as there are many of them.
        if (vote > 0 && relation !== null) continue;
        if (!kept.replies[hash]?.[vote]) writeFileSync(join(values.write, `${hash}.${vote}.prompt.md`), prompt);
      }
    }
  } else {
    // Replies of two models would not be votes on the same thing.
    const replies = kept.model === values.model ? kept.replies : {};
    for (const file of readdirSync(values.read)) {
      const [, hash, vote] = /^([0-9a-f]{64})\.(\d)\.reply\.md$/.exec(file) ?? [];
      if (!prompts.has(hash)) continue;
      replies[hash] ??= [];
      replies[hash][Number(vote)] = readFileSync(join(values.read, file), 'utf8');
    }
    const known = Object.fromEntries(Object.entries(replies).filter(([hash]) => prompts.has(hash)));
    const date = new Date().toISOString().slice(0, 10);
    writeFileSync(repliesFile, `${JSON.stringify({ model: values.model, date, replies: known }, null, 1)}\n`);
  }
  process.stdout.write(`${prompts.size} prompts of ${rendered.length} requests\n`);
  process.exit(0);
}

const names = ['voted', 'one reply', 'seed only', 'other reading'];
const rows = [];
for (const { index, model, request, predicates, unclear = false, file, prompts } of rendered) {
  core('open', { name: model, external: [] }, [file]);
  const rest = await readNodes(file);
  const infer = (count) => {
    const replies = prompts.map((prompt) => ({ ...prompt, texts: repliesTo(prompt).slice(0, count) }));
    return replies.some(({ texts }) => texts.length === 0) ? null : core('read_replies', { request, replies }).result;
  };
  const [voted, one] = [infer(9), infer(1)];
  const row = { index, model, request };
  if (unclear) {
    // What cannot be done, or could mean anything, must be asked back.
    for (const [name, inference] of [
      ['voted', voted],
      ['one reply', one],
    ]) {
      if (inference === null) continue;
      const asked = inference.seed.outcome === 'unclear' || inference.edit === null;
      row[name] = { good: asked ? 1 : 0, of: 1, why: asked ? '' : 'taken as if it were clear' };
    }
  } else {
    if (voted) {
      row.voted = await verdict(voted.edit, predicates, rest);
      row['seed only'] = await verdict(voted.edit && { ...voted.edit, hints: {}, disabled: [] }, predicates, rest);
    }
    if (one) row['one reply'] = await verdict(one.edit, predicates, rest);
    if (edits[index]) row['other reading'] = await verdict(edits[index], predicates, rest);
  }
  rows.push(row);
  const cells = names.filter((name) => row[name]).map((name) => `${name} ${row[name].good}/${row[name].of}`);
  process.stdout.write(`${index} ${model}: ${request}\n    ${cells.join('  ') || 'no replies'}\n`);
  const shown = row.voted ?? row['other reading'];
  if (shown?.why) process.stdout.write(`    ${shown.why}\n`);
}

const summary = Object.fromEntries(
  names.flatMap((name) => {
    const all = rows.map((row) => row[name]).filter(Boolean);
    if (all.length === 0) return [];
    const sum = (of) => all.reduce((total, one) => total + (of(one) ?? 0), 0);
    const met = all.filter(({ good, of }) => good === of).length;
    const share = (a, b) => Number((b === 0 ? 1 : a / b).toFixed(3));
    return [
      [
        name,
        {
          requests: all.length,
          met,
          'met, share': share(met, all.length),
          predicates: share(
            sum(({ good }) => good),
            sum(({ of }) => of),
          ),
          'relations held': share(
            sum(({ held }) => held),
            sum(({ asked }) => asked),
          ),
        },
      ],
    ];
  }),
);
console.table(summary);
if (values.json) writeFileSync(values.json, `${JSON.stringify({ summary, rows }, null, 1)}\n`);
