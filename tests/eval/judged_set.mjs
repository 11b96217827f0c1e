// The sets of requests with predicates, their models, prompts and recorded replies; see judged_requests.mjs.
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { withoutNames } from '../../web/tools/nameless.mjs';
import { batchedPrompts } from './batched.mjs';
import { variantPrompts, withPicture } from './variants.mjs';

const folder = dirname(fileURLToPath(import.meta.url));
const data = process.env.PARSEL_DATA || null;
export const sets = ['harder', 'paper', 'nameless'];

/** What is missing of a set, a sentence; null when it can be measured. */
export function missing(set) {
  if (set !== 'paper' || (data && existsSync(join(data, 'paper', 'pairs.json')))) return null;
  return 'PARSEL_DATA has no paper/pairs.json: nothing is measured.';
}

/** What a pair's words call its nodes: Map of label → node. */
const labelsIn = (predicates) =>
  new Map(
    predicates.flatMap(({ part, label, pair = [], labels = [], any_of = [] }) => [
      ...(part && label ? [[label, part]] : []),
      ...pair.flatMap((node, i) => (labels[i] ? [[labels[i], node]] : [])),
      ...labelsIn(any_of.flat()),
    ]),
  );

function readPairs(set) {
  if (set !== 'paper') return { pairs: JSON.parse(readFileSync(join(folder, `${set}.json`), 'utf8')), edits: {} };
  const { pairs } = JSON.parse(readFileSync(join(data, 'paper', 'pairs.json'), 'utf8'));
  const edits = join(data, 'paper', 'edits.json');
  return {
    pairs: pairs.map(({ model, request, assertions, expected }) => {
      // Some of what a person expects is beyond these predicates, and says so.
      const predicates = assertions.flatMap((one) => one.predicates).filter(({ testable }) => testable !== false);
      return { model, request, predicates, expected, labels: labelsIn(predicates) };
    }),
    edits: existsSync(edits) ? JSON.parse(readFileSync(edits, 'utf8')) : {},
  };
}

/** What a model is opened as, which stands in the prompts: nothing that says what it is where parts have no names either. */
const nameOf = (set, model) => (set === 'nameless' ? 'model' : model);

/**
 * Every request of a set whose model is there, opened once for its prompts.
 * @param core from loadCore()
 * @param only indices; all when empty
 * @returns [{index, model, name, request, predicates, unclear, expected, labels, reading, file, shape, prompts, oneShot,
 *   batched, pictured}]; expected, labels: of the paper's pairs, what was written down besides; reading: somebody else's
 *   edit, if any; prompts as the page asks them; oneShot: for the whole program; batched: all relations of a kind in one;
 *   pictured: with a picture of the numbered parts. Of models without names only the seed and the hints are asked about,
 *   with the picture and without (oneShot is null, batched empty); of others pictured is empty
 */
export function renderSet(core, set, only = []) {
  const { pairs, edits } = readPairs(set);
  const gallery = core('gallery', {});
  const fileOf = (model) => {
    const index = gallery.result.models.findIndex(({ id }) => id === model);
    if (set !== 'paper' && index >= 0) return gallery.buffers[index];
    const file = data && join(data, set === 'paper' ? 'paper' : 'furniture', `${model}.glb`);
    return file && existsSync(file) ? readFileSync(file) : null;
  };
  const rendered = [];
  for (const [index, pair] of pairs.entries()) {
    if (only.length > 0 && !only.includes(index)) continue;
    const named = fileOf(pair.model);
    if (named === null) {
      process.stdout.write(`${pair.model}: the model is not there, skipped\n`);
      continue;
    }
    const file = set === 'nameless' ? withoutNames(named) : named;
    const name = nameOf(set, pair.model);
    const { shape } = core('open', { name, external: [] }, [file]).result;
    const { prompts } = core('prompts', { request: pair.request, mentioned: pair.mentioned ?? [] }).result;
    const common = { unclear: false, ...pair, name, index, reading: edits[index] ?? null, file, shape };
    if (set === 'nameless') {
      const asked = prompts.filter(({ relation }) => relation === null);
      const pictured = withPicture(core, pair.request, asked);
      rendered.push({ ...common, prompts: asked, oneShot: null, batched: [], pictured });
    } else {
      const [oneShot] = variantPrompts('one_shot', prompts);
      rendered.push({ ...common, prompts, oneShot, batched: batchedPrompts(prompts), pictured: [] });
    }
  }
  return rendered;
}

const repliesFile = (set) => join(folder, 'replies', `${set}.json`);

/** {model, date, replies: {hash of a prompt: [text]}} */
export function readReplies(set) {
  const file = repliesFile(set);
  return existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : { model: null, date: null, replies: {} };
}

/** Map of hash → {hash, text, votes}. Which symmetries may go is asked once, as there are many; so is each variant. */
function allPrompts(rendered, votes) {
  const all = rendered.flatMap(({ prompts, oneShot, batched, pictured }) => [
    ...[...prompts, ...pictured].map((prompt) => ({ ...prompt, votes: prompt.relation === null ? votes : 1 })),
    ...[oneShot, ...batched].filter(Boolean).map((prompt) => ({ ...prompt, votes: 1 })),
  ]);
  return new Map(all.map((prompt) => [prompt.hash, prompt]));
}

/** Writes what has no reply as DIR/<hash>.<vote>.prompt.md. @returns how many */
export function writeMissing(set, rendered, into, votes) {
  const kept = readReplies(set);
  mkdirSync(into, { recursive: true });
  let count = 0;
  for (const { hash, text, votes: wanted } of allPrompts(rendered, votes).values()) {
    for (let vote = 0; vote < wanted; ++vote) {
      if (kept.replies[hash]?.[vote]) continue;
      writeFileSync(join(into, `${hash}.${vote}.prompt.md`), text);
      count++;
    }
  }
  return count;
}

/** Keeps DIR/<hash>.<vote>.reply.md, unedited. @returns how many prompts have a reply */
export function keepReplies(set, rendered, from, model) {
  const prompts = allPrompts(rendered, 1);
  const kept = readReplies(set);
  // Replies of two models would not be votes on the same thing.
  const replies = kept.model === model ? kept.replies : {};
  for (const file of readdirSync(from)) {
    const [, hash, vote] = /^([0-9a-f]{64})\.(\d)\.reply\.md$/.exec(file) ?? [];
    if (!prompts.has(hash)) continue;
    replies[hash] ??= [];
    replies[hash][Number(vote)] = readFileSync(join(from, file), 'utf8');
  }
  const known = Object.fromEntries(Object.entries(replies).filter(([hash]) => prompts.has(hash)));
  const date = new Date().toISOString().slice(0, 10);
  writeFileSync(repliesFile(set), `${JSON.stringify({ model, date, replies: known }, null, 1)}\n`);
  return Object.keys(known).length;
}
