// Keeps prompts/recordings: which prompts of prompts/requests.json and prompts/proposals.json, of what is proposed, and about
// the gallery's CAD programs and its models without names have no recorded reply, and recording them. One that goes along with a picture is not asked here.
//
//   node web/tools/record.mjs                             lists what is recorded, missing and stale
//   node web/tools/record.mjs --write DIR [--votes 5]     writes what is missing as DIR/<hash>.<vote>.prompt.md
//   node web/tools/record.mjs --read DIR --model NAME     keeps DIR/<hash>.<vote>.reply.md, unedited
//   node web/tools/record.mjs --provider ID --model NAME [--base URL] [--votes 5]    asks; the key is in PARSEL_KEY
//   node web/tools/record.mjs --prune                     deletes stale recordings
//
// --only MODEL takes the requests of one gallery model. Needs the WebAssembly build (web/start.sh --build-only).
import { mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { runnerImport } from 'vite';
import { loadCore, root } from './core.mjs';
import { compare, readRecordings, renderAll, writeReplies } from './prompts.mjs';

const text = { type: 'string' };
const { values } = parseArgs({
  options: {
    write: text,
    read: text,
    model: text,
    provider: text,
    base: text,
    only: text,
    votes: { type: 'string', default: '5' },
    prune: { type: 'boolean' },
  },
});
const votes = Number(values.votes);
const say = (line) => process.stdout.write(`${line}\n`);
function die(line) {
  process.stderr.write(`${line}\n`);
  process.exit(2);
}
if (!(votes >= 1 && votes <= 9)) die('--votes takes 1 to 9.');
if ((values.read || values.provider) && !values.model) die('--model NAME says who answered.');

const core = await loadCore();
const recordings = readRecordings();
const all = renderAll(core, recordings);
const { offered, open, missing, stale } = compare(all, recordings);
const wanted = all.filter(({ model }) => values.only === undefined || model === values.only);

/** Prompts with fewer replies than votes; each hash once. */
function gaps() {
  const found = new Map();
  for (const { model, request, prompts, tasks } of wanted) {
    for (const prompt of prompts) {
      const have = new Set((recordings.get(prompt.hash)?.replies ?? []).map(({ vote }) => vote));
      const free = Array.from({ length: votes }, (_, vote) => vote).filter((vote) => !have.has(vote));
      if (free.length > 0)
        found.set(prompt.hash, { model, request, prompt, schema: tasks[prompt.task].schema, votes: free });
    }
  }
  return [...found.values()];
}

if (values.write) {
  mkdirSync(values.write, { recursive: true });
  let files = 0;
  for (const { prompt, votes: free } of gaps()) {
    for (const vote of free) {
      writeFileSync(join(values.write, `${prompt.hash}.${vote}.prompt.md`), prompt.text);
      files++;
    }
  }
  say(`${files} prompts in ${values.write}: answer each beside it as <hash>.<vote>.reply.md`);
} else if (values.read) {
  const prompts = new Map(all.flatMap((entry) => entry.prompts.map((prompt) => [prompt.hash, prompt])));
  const replies = new Map();
  for (const file of readdirSync(values.read)) {
    const [, hash, vote] = /^([0-9a-f]{64})\.(\d)\.reply\.md$/.exec(file) ?? [];
    if (hash === undefined) continue;
    if (!prompts.has(hash)) die(`${file} answers no prompt of today: write the prompts anew.`);
    const reply = { vote: Number(vote), text: readFileSync(join(values.read, file), 'utf8') };
    replies.set(hash, [...(replies.get(hash) ?? []), reply]);
  }
  for (const [hash, own] of replies) writeReplies(prompts.get(hash), values.model, own);
  say(`${replies.size} prompts have replies of ${values.model}.`);
} else if (values.provider) {
  const load = async (file) => (await runnerImport(join(root, 'web', 'src', 'llm', file))).module;
  const { providerOf } = await load('providers.ts');
  const { complete } = await load('http.ts');
  const provider = providerOf(values.provider);
  if (provider === undefined) die(`There is no provider ${values.provider}; see web/src/llm/providers.ts.`);
  const key = process.env.PARSEL_KEY ?? '';
  if (key === '' && provider.keysAt !== null) die('Put the key into the environment as PARSEL_KEY.');
  const target = { provider, base: values.base ?? provider.base, model: values.model, key };
  const { signal } = new AbortController();
  for (const { model, request, prompt, schema, votes: free } of gaps()) {
    if (/^The picture shows /m.test(prompt.text)) continue;
    const replies = await Promise.all(
      free.map(async (vote) => ({
        vote,
        text: (await complete(target, { prompt: prompt.text, schema }, { signal })).text,
      })),
    ).catch((error) => die(error.message));
    writeReplies(prompt, values.model, replies);
    say(`${model}: ${request} · ${prompt.task} ${prompt.relation ?? ''}: ${replies.length} replies`);
  }
} else if (values.prune) {
  for (const hash of stale) rmSync(join(root, 'prompts', 'recordings', `${hash}.json`));
  say(`${stale.length} stale recordings deleted.`);
} else {
  for (const { model, request } of offered) say(`recorded      ${model}: ${request}`);
  for (const { model, request, prompts } of open) say(`not recorded  ${model}: ${request} (${prompts.length} prompts)`);
  for (const { model, request, prompt } of missing)
    say(`missing       ${model}: ${request}: ${prompt.task} ${prompt.relation ?? ''} ${prompt.hash}`);
  for (const hash of stale) say(`stale         ${hash}`);
  if (missing.length + stale.length > 0) process.exitCode = 1;
}
