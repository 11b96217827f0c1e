// The recorded replies of the repository: prompts/requests.json says which requests the page offers without a key, and
// prompts/recordings/<hash of the prompt>.json holds what a language model answered, unedited.
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { root } from './core.mjs';
import { namelessIds, withoutNames } from './nameless.mjs';

const requestsFile = join(root, 'prompts', 'requests.json');
const proposalsFile = join(root, 'prompts', 'proposals.json');
const recordingsFolder = join(root, 'prompts', 'recordings');

/** @returns [{model, request, mentioned, suggest}]; `suggest` false: answered when it is asked, but not offered */
export function readRequests() {
  return existsSync(requestsFile) ? JSON.parse(readFileSync(requestsFile, 'utf8')) : [];
}

/**
 * What is asked of tasks that propose requests.
 * @returns [{model, task, request, picture}]; `request` is empty for a task about the model alone; `picture`: whether one
 *   went along
 */
export function readProposals() {
  return existsSync(proposalsFile) ? JSON.parse(readFileSync(proposalsFile, 'utf8')) : [];
}

/** @returns Map of hash → {hash, task, model, date, replies: [{vote, text}]} */
export function readRecordings(folder = recordingsFolder) {
  const found = new Map();
  if (!existsSync(folder)) return found;
  for (const file of readdirSync(folder).filter((name) => name.endsWith('.json'))) {
    const recording = JSON.parse(readFileSync(join(folder, file), 'utf8'));
    if (file !== `${recording.hash}.json`) throw new Error(`${file} holds the recording of ${recording.hash}.`);
    found.set(recording.hash, recording);
  }
  return found;
}

/** Adds replies to the recording of a prompt; votes that are there already are replaced. */
export function writeReplies({ hash, task }, model, replies, date = new Date().toISOString().slice(0, 10)) {
  mkdirSync(recordingsFolder, { recursive: true });
  const file = join(recordingsFolder, `${hash}.json`);
  const before = existsSync(file) ? JSON.parse(readFileSync(file, 'utf8')) : null;
  // Votes of two models would not be votes on the same thing.
  const others = before?.model === model ? before.replies : [];
  const byVote = new Map([...others, ...replies].map((reply) => [reply.vote, reply]));
  const sorted = [...byVote.values()].sort((a, b) => a.vote - b.vote);
  writeFileSync(file, `${JSON.stringify({ hash, task, model, date, replies: sorted }, null, 1)}\n`);
}

/**
 * Renders the prompts of requests.
 * @param core from loadCore()
 * @returns [{model, request, mentioned, suggest, prompts: [{task, relation, text, hash}], tasks}]
 */
export function renderRequests(core, requests) {
  const open = opener(core);
  return requests.map(({ model, request, mentioned = [], suggest = true }) => {
    open(model);
    return { model, request, mentioned, suggest, ...core('prompts', { request, mentioned }).result };
  });
}

/** @returns a function that opens a model of the gallery in the core */
function opener(core) {
  const { result, buffers } = core('gallery', {});
  let opened = null;
  return (model) => {
    const index = result.models.findIndex(({ id }) => id === model);
    if (index < 0) throw new Error(`prompts: the gallery has no model ${model}.`);
    // Under the name that the page opens it by, which may stand in the prompts.
    const name = result.models[index].file.replace(/\.glb$/, '');
    if (opened !== model) core('open', { name, external: [] }, [buffers[index]]);
    opened = model;
  };
}

/**
 * Renders the prompts that propose requests, and of every request that a recorded reply proposes its own, as far as
 * the page asks it.
 * @returns as renderRequests(), each with the task that it is of
 */
export function renderProposals(core, proposals, recordings) {
  const open = opener(core);
  return proposals.flatMap(({ model, task, request = '', picture = false }) => {
    open(model);
    const asked = { task, request, mentioned: [], count: 0, picture };
    const { prompt, words, schema } = core('proposal_prompt', asked).result;
    const own = {
      model,
      task,
      request,
      mentioned: [],
      suggest: false,
      prompts: [prompt],
      tasks: { [task]: { words, schema } },
    };
    const texts = (recordings.get(prompt.hash)?.replies ?? []).map(({ text }) => text);
    if (texts.length === 0) return [own];
    const { proposals: found } = core('read_replies', { request, replies: [{ task, relation: null, texts }] }).result;
    const proposed = found.requests.map((one) => {
      const { prompts, tasks } = core('prompts', { request: one.request, mentioned: [] }).result;
      // Which symmetries may go is not asked of proposals: it would be five times as many questions.
      const asked = prompts.filter(({ relation }) => relation === null);
      return { model, task, request: one.request, mentioned: [], suggest: false, prompts: asked, tasks };
    });
    return [own, ...proposed];
  });
}

/** As many kinds of a program are drawn without being asked for: drawnAtOnce in web/src/session/kinds.ts. */
const drawnKinds = 6;

/**
 * Renders what is asked about the gallery's CAD programs: which kinds there are, and the numbers of those that most of the
 * recorded replies name.
 * @returns as renderRequests(), the model being the program's id in the gallery, each with the task that it is of
 */
export function renderKinds(core, recordings) {
  const { result, buffers } = core('cad_gallery', {});
  return result.programs.flatMap(({ id }, index) => {
    const { cad } = core('open_cad', { name: id }, [buffers[2 * index]]).result;
    const one = (task, kind) => {
      const { prompt, words, schema } = core('cad_prompt', { cad, task, kind, count: 0 }).result;
      const prompts = [{ ...prompt, relation: null }];
      return {
        model: `${id}_program`,
        task,
        request: kind,
        mentioned: [],
        suggest: false,
        prompts,
        tasks: { [task]: { words, schema } },
      };
    };
    const own = one('kinds', '');
    const texts = (recordings.get(own.prompts[0].hash)?.replies ?? []).map(({ text }) => text);
    if (texts.length === 0) return [own];
    const { kinds } = core('read_cad_replies', { cad, task: 'kinds', kind: '', texts }).result;
    return [own, ...kinds.slice(0, drawnKinds).map(({ name }) => one('variation', name))];
  });
}

/** Renders what is asked about the gallery's models without names: what their parts are called. */
export function renderNames(core) {
  const { result, buffers } = core('gallery', {});
  return namelessIds.map((id) => {
    const model = `${id}_nameless`;
    const index = result.models.findIndex((one) => one.id === id);
    core('open', { name: model, external: [] }, [withoutNames(buffers[index])]);
    const task = 'part_names';
    const asked = { task, request: '', mentioned: [], count: 0, picture: false };
    const { prompt, words, schema } = core('proposal_prompt', asked).result;
    const tasks = { [task]: { words, schema } };
    return { model, task, request: '', mentioned: [], suggest: false, prompts: [prompt], tasks };
  });
}

/** Everything that may be recorded. */
export function renderAll(core, recordings = readRecordings()) {
  return [
    ...renderRequests(core, readRequests()),
    ...renderProposals(core, readProposals(), recordings),
    ...renderKinds(core, recordings),
    ...renderNames(core),
  ];
}

/**
 * What of the requests is recorded.
 * @returns offered: those with every prompt recorded; open: those with none; missing: prompts without a recording of
 *   requests with some; stale: hashes of recordings that belong to no prompt (a template or a model has changed)
 */
export function compare(rendered, recordings) {
  const known = new Set(rendered.flatMap(({ prompts }) => prompts.map(({ hash }) => hash)));
  const isRecorded = ({ hash }) => (recordings.get(hash)?.replies.length ?? 0) > 0;
  const some = rendered.filter(({ prompts }) => prompts.some(isRecorded));
  return {
    offered: rendered.filter(({ prompts }) => prompts.every(isRecorded)),
    open: rendered.filter(({ prompts }) => !prompts.some(isRecorded)),
    missing: some.flatMap(({ model, request, prompts }) =>
      prompts.filter((prompt) => !isRecorded(prompt)).map((prompt) => ({ model, request, prompt })),
    ),
    stale: [...recordings.keys()].filter((hash) => !known.has(hash)),
  };
}
