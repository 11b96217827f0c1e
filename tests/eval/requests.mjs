// How well the recorded replies read their requests (ParSEL §7.3.1 and supplement §5.4, tables 2 and 3), against what was
// written down by hand beforehand in prompts/expected.json.
//
//   node tests/eval/requests.mjs [--json FILE]        (after ./web/start.sh --build-only)
//
// Acc(SE)  every seed edit's operator and operand stand in the program that the expected edit gives; for a request that
//          asks for nothing these edits can do: it was called unclear
// Acc(R)   share of the relations whose validity was judged as expected, averaged over the requests
// J(T)     Jaccard similarity of the type hints, without those that change nothing in the expected program
// Match    share of requests where all three are 1
// Meshes   share of requests whose edited model, at some value of its slider, is the expected one: no corner off by more
//          than 1 % of the half-diagonal, wherever the whole stands
//
// Variants: the first reply alone, all replies voted, and the voted seed without hints and validity ("seed only").
import { readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { loadCore, root } from '../../web/tools/core.mjs';
import { readRecordings, renderRequests } from '../../web/tools/prompts.mjs';

const { runnerImport } = await import(createRequire(join(root, 'web', 'package.json')).resolve('vite'));
const load = async (file) => (await runnerImport(join(root, 'web', 'src', 'program', file))).module;
const { checkProgram } = await load('check.ts');
const { interpretProgram } = await load('interpret.ts');

const { values: options } = parseArgs({ options: { json: { type: 'string' } } });
const core = await loadCore();
const {
  result: { models: gallery },
  buffers,
} = core('gallery', {});
const expected = JSON.parse(readFileSync(join(root, 'prompts', 'expected.json'), 'utf8'));
const recordings = readRecordings();

// ------------------------------------------------------------------------------------------------------------ meshes

/** Boxes of all parts and instances at a slider value, centred: [{label, corners}]. */
function boxes(shape, checked, x) {
  const { parts, groups } = interpretProgram(checked, shape, [x]);
  const found = [];
  const grouped = new Set();
  for (const [index, relation] of shape.relations.entries()) {
    if (groups[index] === null) continue;
    const { label } = shape.parts.find(({ id }) => id === relation.parts[0]);
    for (const id of relation.parts) grouped.add(id);
    for (const corners of groups[index].instances) found.push({ label, corners });
  }
  for (const [index, part] of shape.parts.entries()) {
    if (!part.virtual && !grouped.has(part.id)) found.push({ label: part.label, corners: parts[index] });
  }
  const all = found.flatMap(({ corners }) => corners);
  const middle = [0, 1, 2].map((i) => (Math.max(...all.map((c) => c[i])) + Math.min(...all.map((c) => c[i]))) / 2);
  return found.map(({ label, corners }) => ({ label, corners: corners.map((c) => c.map((v, i) => v - middle[i])) }));
}

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const apart = (a, b) => Math.max(...a.map((corner) => Math.min(...b.map((other) => distance(corner, other)))));
const farthest = (from, to) =>
  Math.max(
    ...from.map(({ label, corners }) =>
      Math.min(Infinity, ...to.filter((box) => box.label === label).map((box) => apart(corners, box.corners))),
    ),
  );
/** Hausdorff distance over boxes of the same label. */
const difference = (a, b) => (a.length === b.length ? Math.max(farthest(a, b), farthest(b, a)) : Infinity);

/** Least distance of the model under a program, over its slider, from the one under the expected program. */
function meshDistance(shape, program, truth) {
  const checkedTruth = checkProgram(truth, shape).value;
  const { max, min } = truth.layers[0].parameter;
  const aim = boxes(shape, checkedTruth, max >= -min ? 0.6 * max : 0.6 * min);
  const checked = checkProgram(program, shape).value;
  const { min: low, max: high } = program.layers[0].parameter;
  const at = (x) => difference(boxes(shape, checked, x), aim);
  let best = { x: 0, by: Infinity };
  for (let i = 0; i <= 80; ++i) {
    const x = low + ((high - low) * i) / 80;
    const by = at(x);
    if (by < best.by) best = { x, by };
  }
  for (let step = (high - low) / 160; step > 1e-5; step /= 2) {
    for (const x of [best.x - step, best.x + step]) {
      if (x < low || x > high) continue;
      const by = at(x);
      if (by < best.by) best = { x, by };
    }
  }
  return best.by;
}

// ---------------------------------------------------------------------------------------------------------- measures

const byId = (shape) => {
  const nodes = new Map(shape.parts.filter((part) => !part.virtual).map((part) => [`node:${part.node}`, part.id]));
  return (name) => nodes.get(name) ?? name;
};
const signature = ({ op, part, relation }) => `${op} ${part ?? relation}`;
const signatures = (program) => new Set(program.layers[0].statements.map(signature));
const propagated = (edit) => core('propagate', { edit }).result.program;
const bare = ({ layers: [{ statements }] }) => JSON.stringify(statements);

function hintScore(inferred, wanted, truth) {
  const same = [...inferred].filter(([part, hint]) => wanted.get(part) === hint).length;
  let harmless = 0;
  for (const [part, hint] of inferred) {
    if (wanted.has(part)) continue;
    const hints = { ...truth.edit.hints, [part]: hint };
    try {
      if (bare(propagated({ ...truth.edit, hints })) === bare(truth.program)) ++harmless;
    } catch {
      // A hint that the solver refuses is wrong.
    }
  }
  const union = inferred.size + wanted.size - same - harmless;
  return union === 0 ? 1 : same / union;
}

function measure(shape, inference, edit, truth) {
  if (truth.unclear) {
    const right = inference.seed.outcome === 'unclear' || inference.edit === null ? 1 : 0;
    return { seed: right, relations: 1, hints: 1, mesh: right === 1 ? 0 : Infinity };
  }
  if (edit === null) return { seed: 0, relations: 0, hints: 0, mesh: Infinity };
  const name = byId(shape);
  const known = signatures(truth.program);
  const seed = edit.seed.every((one) => known.has(signature({ ...one, part: one.part && name(one.part) }))) ? 1 : 0;
  const disabled = new Set(truth.edit.disabled ?? []);
  const kinds = new Map(shape.relations.map(({ id, kind }) => [id, kind]));
  const right = inference.relations.filter(
    ({ relation, keep }) => keep !== (disabled.has(relation) || disabled.has(`kind:${kinds.get(relation)}`)),
  );
  const relations = inference.relations.length === 0 ? 1 : right.length / inference.relations.length;
  const wanted = new Map(Object.entries(truth.edit.hints ?? {}).map(([part, hint]) => [name(part), hint]));
  const inferred = new Map(inference.hints.map(({ part, hint }) => [part, hint]));
  let mesh = Infinity;
  try {
    mesh = meshDistance(shape, propagated(edit), truth.program);
  } catch {
    // What cannot be propagated is no mesh.
  }
  return { seed, relations, hints: hintScore(inferred, wanted, truth), mesh };
}

// --------------------------------------------------------------------------------------------------------------- run

const variants = { 'one reply': [], voting: [], 'seed only': [] };
const rows = [];
for (const { model, request, kind, gallery: id, edit, unclear } of expected) {
  const [rendered] = renderRequests(core, [{ model, request }]);
  if (rendered.prompts.some(({ hash }) => !recordings.has(hash))) {
    process.stderr.write(`${model}: ${request}: not recorded\n`);
    continue;
  }
  const entry = gallery.findIndex((one) => one.id === model);
  const { shape } = core('open', { name: model, external: [] }, [buffers[entry]]).result;
  const truth = { unclear: unclear === true };
  if (!truth.unclear) {
    truth.edit = edit ?? gallery[entry].requests.find((one) => one.id === id).edit;
    truth.program = propagated(truth.edit);
  }
  const read = (take) => {
    const replies = rendered.prompts.map(({ task, relation, hash }) => ({
      task,
      relation,
      texts: take(recordings.get(hash).replies.map(({ text }) => text)),
    }));
    return core('read_replies', { request, replies }).result;
  };
  const voted = read((texts) => texts);
  const first = read((texts) => texts.slice(0, 1));
  const results = {
    'one reply': measure(shape, first, first.edit, truth),
    voting: measure(shape, voted, voted.edit, truth),
    'seed only': measure(shape, voted, voted.edit && { seed: voted.edit.seed }, truth),
  };
  for (const [name, result] of Object.entries(results)) variants[name].push(result);
  rows.push({ model, request, kind, outcome: voted.seed.outcome, refused: voted.refused.length, ...results.voting });
}

if ([...recordings.values()].every(({ replies }) => replies.length === 1)) delete variants.voting;

const number = (value) => (Number.isFinite(value) ? value.toFixed(3) : 'none');
for (const { model, request, seed, relations, hints, mesh, refused } of rows) {
  const whole = seed === 1 && relations === 1 && hints === 1 ? ' ' : '-';
  const measures = `SE ${seed}  R ${relations.toFixed(2)}  T ${hints.toFixed(2)}  mesh ${number(mesh)}`;
  console.log(`${whole} ${model}: ${request}  |  ${measures}${refused > 0 ? `  refused ${refused}` : ''}`);
}
const mean = (list, of) => list.reduce((sum, one) => sum + of(one), 0) / list.length;
const totals = {};
for (const [name, list] of Object.entries(variants)) {
  if (list.length === 0) continue;
  totals[name] = {
    requests: list.length,
    'Acc(SE)': mean(list, ({ seed }) => seed),
    'Acc(R)': mean(list, ({ relations }) => relations),
    'J(T)': mean(list, ({ hints }) => hints),
    Match: mean(list, ({ seed, relations, hints }) => (seed === 1 && relations === 1 && hints === 1 ? 1 : 0)),
    meshes: mean(list, ({ mesh }) => (mesh <= 0.01 ? 1 : 0)),
  };
}
console.table(totals);
if (options.json) writeFileSync(options.json, `${JSON.stringify({ totals, rows }, null, 1)}\n`);
