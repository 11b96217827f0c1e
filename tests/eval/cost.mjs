// What it costs to read a request, in calls and tokens, and what is still met when less is asked.
//   node tests/eval/judged_requests.mjs SET --json FILE && node tests/eval/cost.mjs FILE
//
// five votes   every prompt five times, the page's setting until now
// three votes  seed and hints three times, each relation once
// one vote     every prompt once
// early stop   the seed twice, and a third time where the two differ; all else once
// few calls    seed, hints, and one question about all relations of a kind, each once (batched.mjs)
//
// Tokens are characters / 4, of prompts and of the recorded replies, as the page estimates them; replies that were not
// recorded count as the mean of those that were. No variant of fewer relations is counted as met where it was not measured.
import { readFileSync, writeFileSync } from 'node:fs';
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { missing, readReplies, renderSet } from './judged_set.mjs';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { json: { type: 'string' } } });
const [file] = positionals;
if (file === undefined) throw new Error('usage: node cost.mjs FILE [--json OUT]');
const { set, rows } = JSON.parse(readFileSync(file, 'utf8'));
if (missing(set)) {
  process.stdout.write(`${missing(set)}\n`);
  process.exit(0);
}
const core = await loadCore();
const { replies } = readReplies(set);
const rowOf = new Map(rows.map((row) => [row.index, row]));
const tokens = (text) => text.length / 4;
const mean = (list) => list.reduce((sum, one) => sum + one, 0) / Math.max(1, list.length);
const textsOf = ({ hash }) => (replies[hash] ?? []).filter(Boolean);

/** {calls, tokens} of asking each prompt as often as `votes` says. */
function asked(prompts, votes) {
  const sum = { calls: 0, tokens: 0 };
  for (const prompt of prompts) {
    const count = votes(prompt);
    sum.calls += count;
    sum.tokens += count * (tokens(prompt.text) + mean(textsOf(prompt).map(tokens)));
  }
  return sum;
}

/** What the seed is by one reply, to compare two. */
function seedBy(prompt, reply) {
  const { seed } = core('read_replies', { request: '', replies: [{ ...prompt, texts: [reply] }] }).result;
  return JSON.stringify(seed.readings[0]?.statements ?? null);
}

const ways = new Map(['five votes', 'three votes', 'one vote', 'early stop', 'few calls'].map((way) => [way, []]));
for (const { index, model, file: glb, prompts, batched } of renderSet(core, set)) {
  const row = rowOf.get(index);
  if (!row?.voted) continue;
  core('open', { name: model, external: [] }, [glb]);
  const isMet = (name) => row[name] !== undefined && row[name].good === row[name].of;
  const seed = prompts.find(({ task }) => task === 'seed_edit');
  const [first, second] = textsOf(seed);
  const agree = second === undefined || seedBy(seed, first) === seedBy(seed, second);
  const whole = prompts.filter(({ relation }) => relation === null);
  const add = (way, cost, name) => ways.get(way).push({ ...cost, met: isMet(name) });
  add(
    'five votes',
    asked(prompts, () => 5),
    'voted',
  );
  add(
    'three votes',
    asked(prompts, ({ relation }) => (relation === null ? 3 : 1)),
    'voted',
  );
  add(
    'one vote',
    asked(prompts, () => 1),
    'one reply',
  );
  add(
    'early stop',
    asked(prompts, ({ task }) => (task === 'seed_edit' ? (agree ? 2 : 3) : 1)),
    agree ? 'one reply' : 'voted',
  );
  if (row['few calls'])
    add(
      'few calls',
      asked([...whole, ...batched], () => 1),
      'few calls',
    );
}

const table = Object.fromEntries(
  [...ways].map(([way, list]) => {
    const of = (field) => list.map((one) => one[field]);
    const figures = {
      requests: list.length,
      met: list.filter(({ met }) => met).length,
      calls: Number(mean(of('calls')).toFixed(1)),
      'most calls': Math.max(0, ...of('calls')),
      tokens: Math.round(mean(of('tokens'))),
      'most tokens': Math.round(Math.max(0, ...of('tokens'))),
    };
    return [way, figures];
  }),
);
console.table(table);
if (values.json) writeFileSync(values.json, `${JSON.stringify({ set, table }, null, 1)}\n`);
