// The prompts of ParSEL's tables 2 and 3 that the page does not use, and their recorded replies: without worked examples,
// without thinking, without both (the paper's "naive"), and the whole program at one go.
//
//   node tests/eval/variants.mjs                            what is recorded and what is missing
//   node tests/eval/variants.mjs --write DIR                writes what is missing as DIR/<variant>/<hash>.prompt.md
//   node tests/eval/variants.mjs --read DIR --model NAME    keeps DIR/<variant>/<hash>.reply.md, unedited
//
// replies/<variant>.json: {"model", "date", "replies": {hash of the prompt: text}}, one reply to a prompt. Hashes that
// belong to no prompt of today are dropped by --read. Needs the WebAssembly build (web/start.sh --build-only).
import { createHash } from 'node:crypto';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { readRequests, renderRequests } from '../../web/tools/prompts.mjs';

const folder = dirname(fileURLToPath(import.meta.url));

/** `text` from the heading `from` up to the heading `to`, exclusive. */
function between(text, from, to) {
  const start = text.indexOf(`\n${from}\n`);
  const end = text.indexOf(`\n${to}\n`);
  if (start < 0 || end < start) throw new Error(`The prompt has no '${from}' before '${to}': this file must follow.`);
  return [start, end];
}

function cut(text, from, to) {
  const [start, end] = between(text, from, to);
  return text.slice(0, start) + text.slice(end);
}

/** `text` with `old` replaced, which must be there. */
function swap(text, old, by) {
  if (!text.includes(old)) throw new Error(`The prompt does not say '${old}': this file must follow.`);
  return text.replace(old, by);
}

/**
 * Prompts with the paragraph that the page's suggestions have about the picture of the numbered parts (prompts/README.md).
 * @param core from loadCore(), with the model open. @param prompts of seed_edit and type_hints
 * @returns likewise, with numbered: ids of the parts under 1, 2, …
 */
export function withPicture(core, request, prompts) {
  const asked = { task: 'request_variations', request, mentioned: [], count: 0, picture: true };
  const { prompt, numbered } = core('proposal_prompt', asked).result;
  const [words] = /^The picture shows .*$/m.exec(prompt.text);
  return prompts.map((one) => {
    const place = '\nParts that the person pointed at:';
    const text = swap(one.text, place, `\n${words}\n${place}`);
    return { ...one, text, hash: createHash('sha256').update(text).digest('hex'), numbered };
  });
}

const withoutExamples = (text) => cut(text, '# Worked examples', '# The model and the request');

function withoutThinking(text) {
  // What stands between an example's request and its answer is thinking.
  const [start, end] = text.includes('\n# Worked examples\n')
    ? between(text, '# Worked examples', '# The model and the request')
    : [0, 0];
  const examples = text.slice(start, end).replace(/^(Request: .*\n)[\s\S]*?(?=^```json$)/gm, '$1\n');
  let plain = text.slice(0, start) + examples + text.slice(end);
  plain = cut(plain, '# Steps to think through', '# Guidelines and reminders');
  plain = swap(
    plain,
    'Think first, in plain text. Then end with exactly one JSON block',
    'Answer at once, without thinking aloud: with exactly one JSON block and no other text',
  );
  return swap(
    plain,
    'the thinking first, one JSON block at the end, nothing after it.',
    'one JSON block, nothing else.',
  );
}

/** The shape in words and the request, as the seed edit's prompt has them, and how large the shape is in lengths. */
function modelAndRequest(text) {
  const section = text.slice(...between(text, '# The model and the request', '# Steps to think through')).trim();
  const [sizes, ...ratio] = /Its width : height : depth are as (\d+) : (\d+) : (\d+)\./.exec(section);
  const diagonal = Math.hypot(...ratio) / 2;
  const [width, height, depth] = ratio.map((side) => (side / diagonal).toFixed(3));
  const lengths = `; in lengths it is ${width} wide, ${height} high and ${depth} deep.`;
  return swap(section, sizes, sizes.slice(0, -1) + lengths);
}

const oneShot = readFileSync(join(folder, 'one_shot.md'), 'utf8');

/** Of each variant: a prompt of the page → its text, or nothing when the variant does not ask it. */
const texts = {
  no_examples: ({ text }) => withoutExamples(text),
  no_thinking: ({ text }) => withoutThinking(text),
  naive: ({ text }) => withoutThinking(withoutExamples(text)),
  one_shot: ({ task, text }) =>
    task === 'seed_edit' ? oneShot.replace('{{model}}', () => modelAndRequest(text)) : null,
};
export const variants = Object.keys(texts);

/** @param prompts as renderRequests() gives them. @returns those of the variant: [{task, relation, text, hash}] */
export function variantPrompts(variant, prompts) {
  return prompts.flatMap((prompt) => {
    const text = texts[variant](prompt);
    if (text === null) return [];
    const hash = createHash('sha256').update(text).digest('hex');
    return [{ task: prompt.task, relation: prompt.relation, text, hash }];
  });
}

const fileOf = (variant) => join(folder, 'replies', `${variant}.json`);

/** @returns {model, date, replies: {hash: text}} */
export function readReplies(variant) {
  const file = fileOf(variant);
  return existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : { model: null, date: null, replies: {} };
}

async function main() {
  const text = { type: 'string' };
  const { values } = parseArgs({ options: { write: text, read: text, model: text } });
  if (values.read && !values.model) throw new Error('--model NAME says who answered.');
  const rendered = renderRequests(await loadCore(), readRequests()).flatMap(({ prompts }) => prompts);
  for (const variant of variants) {
    const prompts = new Map(variantPrompts(variant, rendered).map((prompt) => [prompt.hash, prompt]));
    const before = readReplies(variant);
    const missing = [...prompts.values()].filter(({ hash }) => before.replies[hash] === undefined);
    if (values.write) {
      mkdirSync(join(values.write, variant), { recursive: true });
      for (const { hash, text: prompt } of missing)
        writeFileSync(join(values.write, variant, `${hash}.prompt.md`), prompt);
    }
    if (values.read) {
      // Replies of two models would not be comparable.
      const kept = before.model === values.model ? before.replies : {};
      const source = join(values.read, variant);
      for (const file of existsSync(source) ? readdirSync(source) : []) {
        const [, hash] = /^([0-9a-f]{64})\.reply\.md$/.exec(file) ?? [];
        if (hash !== undefined) kept[hash] = readFileSync(join(source, file), 'utf8');
      }
      const replies = Object.fromEntries([...prompts.keys()].filter((hash) => hash in kept).map((h) => [h, kept[h]]));
      const date = new Date().toISOString().slice(0, 10);
      mkdirSync(join(folder, 'replies'), { recursive: true });
      writeFileSync(fileOf(variant), `${JSON.stringify({ model: values.model, date, replies }, null, 1)}\n`);
    }
    const have = Object.keys(readReplies(variant).replies).filter((hash) => prompts.has(hash)).length;
    process.stdout.write(`${variant}: ${have} of ${prompts.size} prompts have a reply\n`);
  }
}

if (process.argv[1] === fileURLToPath(import.meta.url)) await main();
