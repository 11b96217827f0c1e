// Names that recorded replies give the parts of models without names: how many parts are named so that the same relations
// are found as with the names that were taken away.
//
//   node tests/eval/names.mjs                                  the gallery's models that have recordings
//   node tests/eval/names.mjs --replies FOLDER MODEL.glb …     others: FOLDER/<model>.<vote>.reply.txt
import { existsSync, readFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { withoutNames } from '../../web/tools/nameless.mjs';
import { readRecordings } from '../../web/tools/prompts.mjs';

const asked = { task: 'part_names', request: '', mentioned: [], count: 0, picture: false };
const keyOf = ({ node, primitive }) => `node:${node}/${primitive}`;

/** Of each real part, by key: its relations, as texts of their kinds and parts. A virtual part is all of its instances. */
function relationsByPart(shape) {
  const byId = new Map(shape.parts.map((part) => [part.id, part]));
  const keys = (id) => {
    const part = byId.get(id);
    return part.virtual ? part.members.flatMap(keys) : [keyOf(part)];
  };
  const found = new Map(shape.parts.filter(({ virtual }) => !virtual).map((part) => [keyOf(part), new Set()]));
  for (const { kind, parts } of shape.relations) {
    const sides = parts.map((id) => keys(id).sort().join(' ')).sort();
    const text = `${kind}: ${sides.join(' | ')}`;
    for (const key of parts.flatMap(keys)) found.get(key).add(text);
  }
  return found;
}

/** By key: the parts of the same label, which are compared for symmetry. */
function setsOf(labels) {
  return new Map(
    [...labels].map(([key, label]) => [key, new Set([...labels].flatMap(([k, l]) => (l === label ? [k] : [])))]),
  );
}

const places = 'left|right|front|back|rear|top|bottom|upper|lower|inner|outer|middle|center|centre';
const ends = new RegExp(`^(?:${places}) ?(?=.)|(?<=.) ?(?:${places})$`);

/** The label without what only says a place, glued or not: as core/shape compares them, near enough for English names. */
function stem(label) {
  let left = label
    .toLowerCase()
    .replace(/[^a-z]+/g, ' ')
    .trim();
  for (let next = left.replace(ends, ''); next !== left; next = left.replace(ends, '')) left = next;
  return left || label;
}

const labelsOf = (shape) =>
  new Map(shape.parts.filter(({ virtual }) => !virtual).map((part) => [keyOf(part), stem(part.label)]));

const sameSet = (a, b) => a.size === b.size && [...a].every((one) => b.has(one));

/** @returns how many of the parts have the relations of `right` in `shape` */
function agreeing(right, shape) {
  const own = relationsByPart(shape);
  return [...right].filter(([key, set]) => sameSet(set, own.get(key) ?? new Set())).length;
}

/** How many parts share their label with the same others in both. */
function together(a, b) {
  const other = setsOf(labelsOf(b));
  return [...setsOf(labelsOf(a))].filter(([key, set]) => sameSet(set, other.get(key) ?? new Set())).length;
}

/**
 * @param repliesOf by prompt: texts of replies
 * @returns {parts, same: with the voted names, without: with no names at all, together: of parts that share their name with
 *   the same others, names}; null without replies
 */
export function measureNames(core, name, glb, repliesOf) {
  const given = core('open', { name, external: [] }, [glb]).result.shape;
  const right = relationsByPart(given);
  const bare = withoutNames(glb);
  const { shape } = core('open', { name, external: [] }, [bare]).result;
  const { prompt } = core('proposal_prompt', asked).result;
  const texts = repliesOf(prompt);
  if (texts.length === 0) return null;
  const replies = [{ task: asked.task, relation: null, texts }];
  const { names, refused } = core('read_replies', { request: '', replies }).result;
  const byId = new Map(shape.parts.map((part) => [part.id, part]));
  const labels = {};
  for (const { part: id, label } of names.parts) {
    if (label === '') continue;
    const part = byId.get(id);
    for (const one of part.virtual ? part.members : [id]) labels[keyOf(byId.get(one))] = label;
  }
  const renamed = core('open', { name, external: [], labels }, [bare]).result.shape;
  return {
    parts: right.size,
    same: agreeing(right, renamed),
    without: agreeing(right, shape),
    together: together(given, renamed),
    names,
    refused: refused.length,
    hash: prompt.hash,
  };
}

/** Of every model of the gallery that has recorded names: [{id, …measureNames()}]. */
export function measureGalleryNames(core, recordings) {
  const { result, buffers } = core('gallery', {});
  return result.models.flatMap(({ id }, i) => {
    const repliesOf = ({ hash }) => (recordings.get(hash)?.replies ?? []).map(({ text }) => text);
    const measured = measureNames(core, id, buffers[i], repliesOf);
    return measured === null ? [] : [{ id, ...measured }];
  });
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const { values, positionals } = parseArgs({ options: { replies: { type: 'string' } }, allowPositionals: true });
  const core = await loadCore();
  const all =
    values.replies === undefined
      ? measureGalleryNames(core, readRecordings())
      : positionals.flatMap((file) => {
          const id = basename(file, '.glb');
          const texts = Array.from({ length: 9 }, (_, vote) => join(values.replies, `${id}.${vote}.reply.txt`))
            .filter((path) => existsSync(path))
            .map((path) => readFileSync(path, 'utf8'));
          const measured = measureNames(core, id, new Uint8Array(readFileSync(file)), () => texts);
          return measured === null ? [] : [{ id, ...measured }];
        });
  let [parts, same, without, sets] = [0, 0, 0, 0];
  for (const one of all) {
    parts += one.parts;
    same += one.same;
    without += one.without;
    sets += one.together;
    const { category, category_votes, front, of } = one.names;
    process.stdout.write(
      `${one.id}: ${one.same} of ${one.parts} parts (${one.without} without names), ${one.together} grouped alike; ${category} (${category_votes} of ${of}), ` +
        `front ${front}; ${one.names.parts.map(({ part, label }) => `${part}=${label}`).join(', ')}\n`,
    );
  }
  const share = (n) => `${((100 * n) / Math.max(1, parts)).toFixed(1)} %`;
  process.stdout.write(
    `${all.length} models, ${parts} parts: ${share(same)} as with the given names, ${share(without)} without; ${share(sets)} grouped alike\n`,
  );
}
