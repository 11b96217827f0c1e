// Requests with predicates that were written down beforehand: what share of them is met, and where the others fail.
//
//   node tests/eval/judged_requests.mjs SET                            measures the recorded replies
//   node tests/eval/judged_requests.mjs SET --write DIR [--votes 3]    writes what has no reply as DIR/<hash>.<vote>.prompt.md
//   node tests/eval/judged_requests.mjs SET --read DIR --model NAME    keeps DIR/<hash>.<vote>.reply.md, unedited
//
// SET: harder   harder.json, on models of the gallery and of $PARSEL_DATA/furniture
//      nameless nameless.json, on such models without any name; each with and without a picture of its numbered parts
//      paper    $PARSEL_DATA/paper: part of the paper's own shapes and requests; nothing of it stands here but the replies,
//               by the hash of their prompt
// --json FILE writes what is printed, with the programs (paper/report.mjs and study/make.mjs draw them). --only 3,10: these
// requests alone; --variants 'one go,voted': these rows of the table alone. --each measures every vote alone, too, and counts
// what of it is at fault (faults.mjs).
//
// A request is met when all of its predicates hold (predicates.mjs). Where the slider stands was written down with the
// predicates: at 0.2 (harder, nameless), or where the part that is edited has moved by 0.2 half-diagonals, for turns by 0.2 (paper);
// at its end when that comes first. Numbers of instances are counted at the end, as a count takes whole steps.
// Kept relations are seen on the meshes (kept_relations.mjs) there; an edit is clean when none is lost there and at the end
// of what the search looks at, 0.35, however much farther the slider goes.
// Variants: all replies voted; the first alone; the first, with one question about all relations of a kind ("few calls",
// batched.mjs; cost.mjs says what each costs); the voted seed without hints and validity; the whole program by the language
// model at one go; all replies to the prompts with a picture ("picture"); and, where the folder has it, somebody else's
// reading (edits.json). Of what is not met it is said whether the reading contradicts what was expected (paper/blame.mjs);
// if not, the search is at fault.
// replies/SET.json: {model, date, replies: {hash: [text]}}. Needs the WebAssembly build.
import { writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { separated } from './batched.mjs';
import { faultOf } from './faults.mjs';
import { keepReplies, missing, readReplies, renderSet, sets, writeMissing } from './judged_set.mjs';
import { keptRelations } from './kept_relations.mjs';
import { blame } from './paper/blame.mjs';
import { searched } from './paper/frames.mjs';
import { sliderAt } from './paper/slider.mjs';
import { judge, readNodes } from './predicates.mjs';

const text = { type: 'string' };
const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    write: text,
    read: text,
    model: text,
    json: text,
    only: text,
    variants: text,
    votes: { type: 'string', default: '3' },
    each: { type: 'boolean' },
  },
});
const [set] = positionals;
const votes = Number(values.votes);
function die(line) {
  process.stderr.write(`${line}\n`);
  process.exit(2);
}
if (!sets.includes(set)) die('Which set: harder, paper or nameless?');
if (!(votes >= 1 && votes <= 9)) die('--votes takes 1 to 9.');
if (values.read && !values.model) die('--model NAME says who answered.');
const names = ['one go', 'seed only', 'one reply', 'few calls', 'voted', 'picture', 'other reading'];
const wanted = values.variants?.split(',') ?? names;
const unknown = wanted.find((name) => !names.includes(name));
if (unknown !== undefined) die(`--variants knows no "${unknown}", only ${names.join(', ')}.`);
if (missing(set)) {
  process.stdout.write(`${missing(set)}\n`);
  process.exit(0);
}

const core = await loadCore();
const rendered = renderSet(core, set, values.only ? values.only.split(',').map(Number) : []);
if (values.write) {
  const count = writeMissing(set, rendered, values.write, votes);
  process.stdout.write(`${count} prompts of ${rendered.length} requests have no reply\n`);
  process.exit(0);
}
if (values.read) {
  const count = keepReplies(set, rendered, values.read, values.model);
  process.stdout.write(`${count} prompts of ${rendered.length} requests have replies\n`);
  process.exit(0);
}

const { replies } = readReplies(set);
const repliesTo = ({ hash }) => (replies[hash] ?? []).filter(Boolean);

/** A program of one layer that does what the statements say, and nothing else. */
const programOf = ({ name, sha256 }, statements) => ({
  format: 'parsel/program',
  version: 1,
  shape: { name, sha256 },
  layers: [
    { request: 'one go', parameter: { name: 'x', min: -searched, max: searched, value: 0 }, statements, relations: [] },
  ],
});

/** {program} or {refused: why}; the same edit is propagated once. */
function propagated(edit, known) {
  const key = JSON.stringify(edit);
  if (!known.has(key)) {
    try {
      known.set(key, { program: core('propagate', { edit }).result.program });
    } catch (error) {
      known.set(key, { refused: error.message });
    }
  }
  return known.get(key);
}

/** Every prompt with its first `count` replies; null when one has none. */
function given(prompts, count) {
  const list = prompts.map((prompt) => ({ ...prompt, texts: repliesTo(prompt).slice(0, count) }));
  return list.some(({ texts }) => texts.length === 0) ? null : list;
}

/** One reply to everything, all relations of a kind asked about in one; null when a reply is missing or cannot be read. */
function inOneCall({ prompts, batched }) {
  const whole = given(
    prompts.filter(({ relation }) => relation === null),
    1,
  );
  const answers = batched.map((prompt) => repliesTo(prompt)[0] && separated(prompt, repliesTo(prompt)[0]));
  if (whole === null || answers.some((answer) => !answer)) return null;
  const single = new Map(answers.flatMap((answer) => [...answer]));
  return prompts.map((prompt) => ({
    ...prompt,
    texts: prompt.relation === null ? repliesTo(prompt).slice(0, 1) : [single.get(prompt.relation)],
  }));
}

const counts = (predicate) => (predicate.any_of?.flat() ?? [predicate]).some((one) => 'group' in one);

/** @param made {program} or {refused}; null when nothing was understood */
async function verdict(made, { predicates, shape, rest }, seed, givenUp) {
  const nothing = (why) => ({ good: 0, of: predicates.length, kept: 0, asked: 0, clean: false, why, program: null });
  if (made === null) return nothing('read as unclear, or not at all');
  if (made.refused) return nothing(made.refused);
  const { program } = made;
  const { max } = program.layers[0].parameter;
  const at = async (value) => {
    const rows = program.layers.map((_, i) => (i === 0 ? value : 0));
    return readNodes(core('apply', { program, values: rows }).buffers[0]);
  };
  let slider;
  let now;
  let far;
  let end;
  try {
    slider = set === 'paper' ? await sliderAt(shape, rest, seed, max, at) : Math.min(0.2, max);
    [now, far, end] = [await at(slider), await at(Math.max(slider, Math.min(searched, max))), await at(max)];
  } catch (error) {
    return nothing(error.message); // the gate refuses what a language model wrote
  }
  const judged = predicates.map((one) => ({ predicate: one, ...judge(one, rest, counts(one) ? end : now) }));
  const wrong = judged.filter(({ ok }) => !ok);
  const [there, farther] = [now, far].map((nodes) => keptRelations(shape, rest, nodes, givenUp));
  return {
    good: judged.length - wrong.length,
    of: judged.length,
    kept: there.kept,
    asked: there.of,
    lost: there.lost,
    clean: there.lost.length === 0 && farther.lost.length === 0,
    why: wrong.map(({ predicate, why }) => `${JSON.stringify(predicate)} ${why}`).join('; '),
    slider,
    program,
  };
}

/** Every vote alone: [{vote, fault}]; fault: null when it meets the request. @param good edits that are known to meet it */
async function eachVote(pair, infer, measured, good) {
  const { prompts, unclear } = pair;
  const count = Math.max(...prompts.map((prompt) => repliesTo(prompt).length));
  const inferences = Array.from({ length: count }, (_, vote) =>
    infer(prompts.map((prompt) => ({ ...prompt, texts: [repliesTo(prompt)[vote] ?? repliesTo(prompt)[0]] }))),
  );
  const isMet = async (edit) => {
    const { good: held, of } = await measured(edit);
    return held === of;
  };
  const met = [...good];
  for (const { edit } of unclear ? [] : inferences) if (edit && (await isMet(edit))) met.push(edit);
  const faults = [];
  for (const [vote, { edit, seed, refused }] of inferences.entries()) {
    const asked = seed.outcome === 'unclear' || edit === null;
    let fault = null;
    if (unclear) fault = asked ? null : 'taken as if it were clear';
    else if (asked) fault = refused.length > 0 ? 'cannot be read' : 'read as unclear';
    else if (!(await isMet(edit))) fault = (await faultOf(edit, met, isMet)) ?? 'no reading meets it';
    faults.push({ vote, fault });
  }
  return faults;
}

const rows = [];
for (const pair of rendered) {
  const { index, model, name: opened, request, unclear, reading, file, shape, prompts, oneShot, pictured } = pair;
  core('open', { name: opened, external: [] }, [file]);
  pair.rest = await readNodes(file);
  const infer = (list) => list && core('read_replies', { request, replies: list }).result;
  const [voted, one] = [infer(given(prompts, 9)), infer(given(prompts, 1))];
  const whole = oneShot && infer(given([oneShot], 1));
  const few = set === 'nameless' ? null : infer(inOneCall(pair));
  const seen = pictured.length > 0 ? infer(given(pictured, 9)) : null;
  const row = { index, model, request, ...(pair.kind && { kind: pair.kind }) };
  if (unclear) {
    // What cannot be done, or could mean anything, must be asked back.
    if (values.each && voted) row.each = await eachVote(pair, infer, null, []);
    for (const [name, inference] of [
      ['one go', whole],
      ['one reply', one],
      ['few calls', few],
      ['voted', voted],
    ]) {
      if (inference === null || !wanted.includes(name)) continue;
      const asked = inference.seed.outcome === 'unclear' || inference.edit === null;
      row[name] = { good: asked ? 1 : 0, of: 1, unclear, why: asked ? '' : 'taken as if it were clear' };
    }
  } else {
    const known = new Map();
    const seed = (voted?.edit ?? reading)?.seed ?? [];
    const givenUp = (voted?.edit ?? reading)?.disabled ?? [];
    const measure = async (name, edit) => {
      if (wanted.includes(name)) row[name] = await verdict(edit && propagated(edit, known), pair, seed, givenUp);
    };
    if (whole && wanted.includes('one go')) {
      const made = whole.edit && { program: programOf(shape, whole.edit.seed) };
      row['one go'] = await verdict(made, pair, seed, givenUp);
    }
    if (voted) {
      await measure('seed only', voted.edit && { ...voted.edit, hints: {}, disabled: [] });
      await measure('voted', voted.edit);
    }
    if (one) await measure('one reply', one.edit);
    if (few) await measure('few calls', few.edit);
    if (seen) await measure('picture', seen.edit);
    if (reading) await measure('other reading', reading);
    if (row.voted && row.voted.good < row.voted.of) row.blame = blame(pair, voted.edit);
    if (values.each && voted) {
      const measured = (edit) => verdict(propagated(edit, known), pair, seed, givenUp);
      row.each = await eachVote(
        pair,
        infer,
        measured,
        row['other reading'] && row['other reading'].good === row['other reading'].of ? [reading] : [],
      );
    }
  }
  rows.push(row);
  const cells = names.filter((name) => row[name]).map((name) => `${name} ${row[name].good}/${row[name].of}`);
  process.stdout.write(`${index} ${model}: ${request}\n    ${cells.join('  ') || 'no replies'}\n`);
  const shown = row.voted ?? row['other reading'] ?? row['one go'];
  if (shown?.why) process.stdout.write(`    ${row.blame ? `${row.blame}: ` : ''}${shown.why}\n`);
}

const share = (a, b) => Number((b === 0 ? 1 : a / b).toFixed(3));
const summary = Object.fromEntries(
  names.flatMap((name) => {
    const all = rows.map((row) => row[name]).filter(Boolean);
    if (all.length === 0) return [];
    const edits = all.filter((one) => !one.unclear);
    const sum = (list, of) => list.reduce((total, one) => total + (of(one) ?? 0), 0);
    const met = all.filter(({ good, of }) => good === of).length;
    const figures = {
      requests: all.length,
      met,
      'met, share': share(met, all.length),
      predicates: share(
        sum(all, ({ good }) => good),
        sum(all, ({ of }) => of),
      ),
      'relations kept': share(
        sum(edits, ({ kept }) => kept),
        sum(edits, ({ asked }) => asked),
      ),
      'clean edits': share(edits.filter(({ clean }) => clean).length, edits.length),
    };
    return [[name, figures]];
  }),
);
console.table(summary);
const blamed = rows.filter(({ blame: why }) => why).map(({ blame: why }) => why.split(' ')[0]);
for (const why of new Set(blamed))
  process.stdout.write(`${why} at fault: ${blamed.filter((x) => x === why).length} of ${blamed.length} not met\n`);
const each = rows.flatMap(({ each: list }) => list ?? []);
if (values.each) {
  const wrong = each.flatMap(({ fault }) => fault ?? []);
  process.stdout.write(`each vote alone: ${wrong.length} of ${each.length} do not meet their request\n`);
  for (const fault of new Set(wrong)) process.stdout.write(`  ${fault}: ${wrong.filter((x) => x === fault).length}\n`);
}
if (values.json) writeFileSync(values.json, `${JSON.stringify({ set, summary, rows }, null, 1)}\n`);
