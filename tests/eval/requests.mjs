// How well the recorded replies read their requests (ParSEL §7.2.2, §7.3.1 and supplement §5.3, §5.4: tables 2 and 3),
// against what was written down by hand beforehand in prompts/expected.json.
//
//   node tests/eval/requests.mjs [--each] [--json FILE] [--parsel TOOL]        (after ./web/start.sh --build-only)
//
// Acc(SE)  every seed edit's operator and operand stand in the program that the expected edit gives; for a request that
//          asks for nothing these edits can do: it was called unclear
// Acc(R)   share of the relations whose validity was judged as expected, averaged over the requests
// J(T)     Jaccard similarity of the type hints, without those that change nothing in the expected program
// Match    share of requests where all three are 1
// meshes   share of requests whose edited model, at some value of its slider, is the expected one: no corner off by more
//          than 1 % of the half-diagonal, wherever the whole stands
// J(prog), D(geo), %Rel: as core/propagate/score.h says, over the requests that are not unclear; a reply that gives no
//          program counts as one that does nothing. They need the command-line tool (--parsel, or a build of it).
//
// Variants: all replies voted; the first reply alone; the prompts of variants.mjs, one reply each; the voted seed without
// hints and validity ("seed only"); the whole program by the language model alone ("one shot").
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { loadCore, root } from '../../web/tools/core.mjs';
import { readRecordings, renderRequests } from '../../web/tools/prompts.mjs';
import { meshDistance } from './mesh_distance.mjs';
import { readReplies, variantPrompts } from './variants.mjs';

const text = { type: 'string' };
const { values: options } = parseArgs({ options: { json: text, parsel: text, each: { type: 'boolean' } } });
const builds = ['native-release', 'native-debug'].map((preset) => join(root, 'build', preset, 'core', 'parsel'));
const tool = options.parsel ?? builds.find(existsSync);

const core = await loadCore();
const {
  result: { models: gallery },
  buffers,
} = core('gallery', {});
const expected = JSON.parse(readFileSync(join(root, 'prompts', 'expected.json'), 'utf8'));
const recordings = readRecordings();

// ------------------------------------------------------------------------------------------------- table 3: the replies

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

function seedIsRight(shape, edit, truth) {
  const name = byId(shape);
  const known = signatures(truth.program);
  return edit.seed.every((one) => known.has(signature({ ...one, part: one.part && name(one.part) })));
}

function measure(shape, inference, truth) {
  const { edit } = inference;
  if (truth.unclear) {
    const right = inference.seed.outcome === 'unclear' || edit === null ? 1 : 0;
    return { seed: right, relations: 1, hints: 1 };
  }
  if (edit === null) return { seed: 0, relations: 0, hints: 0 };
  const disabled = new Set(truth.edit.disabled ?? []);
  const kinds = new Map(shape.relations.map(({ id, kind }) => [id, kind]));
  const right = inference.relations.filter(
    ({ relation, keep }) => keep !== (disabled.has(relation) || disabled.has(`kind:${kinds.get(relation)}`)),
  );
  const name = byId(shape);
  const wanted = new Map(Object.entries(truth.edit.hints ?? {}).map(([part, hint]) => [name(part), hint]));
  const inferred = new Map(inference.hints.map(({ part, hint }) => [part, hint]));
  return {
    seed: seedIsRight(shape, edit, truth) ? 1 : 0,
    relations: inference.relations.length === 0 ? 1 : right.length / inference.relations.length,
    hints: hintScore(inferred, wanted, truth),
  };
}

// ------------------------------------------------------------------------------------------------ table 2: the programs

const scratch = mkdtempSync(join(tmpdir(), 'parsel-requests-'));
process.on('exit', () => rmSync(scratch, { recursive: true }));
if (tool === undefined)
  process.stderr.write('No build of the command-line tool: J(prog), D(geo) and %Rel are left out.\n');

/** A program of one layer that does what the statements say, and nothing else. */
function programOf(shape, statements) {
  const parameter = { name: 'x', min: -0.35, max: 0.35, value: 0 };
  return {
    format: 'parsel/program',
    version: 1,
    shape: { name: shape.name, sha256: shape.sha256 },
    layers: [{ request: 'one shot', parameter, statements, relations: [] }],
  };
}

/** The three measures, and how near the mesh comes. program: null when there is none. */
function score(glb, shape, program, truth) {
  const mesh = program === null ? Infinity : meshDistance(shape, program, truth.program);
  if (tool === undefined) return { mesh };
  const write = (name, content) => {
    writeFileSync(join(scratch, name), content);
    return join(scratch, name);
  };
  const [model, right, own] = [
    write('model.glb', glb),
    write('truth.json', JSON.stringify(truth.program)),
    write('program.json', JSON.stringify(program ?? programOf(shape, []))),
  ];
  return { mesh, ...JSON.parse(execFileSync(tool, ['score', model, '--truth', right, '--program', own])) };
}

const orNothing = (work) => {
  try {
    return work();
  } catch {
    return null; // what cannot be propagated, or is refused, is no program
  }
};

function oneShotProgram(shape, inference) {
  if (inference.edit === null) return null;
  const program = programOf(shape, inference.edit.seed);
  const empty = programOf(shape, []);
  // The gate that every program passes.
  return orNothing(() => meshDistance(shape, program, empty)) === null ? null : program;
}

// --------------------------------------------------------------------------------------------------------------- run

const readers = ['voting', 'one reply', 'no examples', 'no thinking', 'naive'];
const makers = ['one shot', 'seed only', 'full'];
const measured = new Map([...readers, ...makers].map((name) => [name, []]));
const rows = [];
const each = [];

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
  /** What the replies to the prompts mean; null when one has no reply. */
  const infer = (prompts, textsOf) => {
    const replies = prompts.map((prompt) => ({ ...prompt, texts: textsOf(prompt) }));
    if (replies.some(({ texts }) => texts.length === 0)) return null;
    return core('read_replies', { request, replies }).result;
  };
  const recorded = ({ hash }) => recordings.get(hash).replies.map((reply) => reply.text);
  const ofVariant = (variant) => {
    const { replies } = readReplies(variant);
    return infer(variantPrompts(variant, rendered.prompts), ({ hash }) => [replies[hash]].filter(Boolean));
  };
  const inferences = {
    voting: infer(rendered.prompts, recorded),
    'one reply': infer(rendered.prompts, (prompt) => recorded(prompt).slice(0, 1)),
    'no examples': ofVariant('no_examples'),
    'no thinking': ofVariant('no_thinking'),
    naive: ofVariant('naive'),
  };
  const oneShot = ofVariant('one_shot');
  for (const name of readers) {
    if (inferences[name] !== null) measured.get(name).push(measure(shape, inferences[name], truth));
  }
  if (options.each) {
    const count = Math.max(...rendered.prompts.map((prompt) => recorded(prompt).length));
    for (let vote = 0; vote < count; ++vote) {
      const alone = infer(rendered.prompts, (prompt) => [recorded(prompt)[vote] ?? recorded(prompt)[0]]);
      each.push({ model, request, vote, refused: alone.refused.length, ...measure(shape, alone, truth) });
    }
  }
  const { voting } = inferences;
  const row = { model, request, kind, outcome: voting.seed.outcome, refused: voting.refused.length };
  Object.assign(row, measured.get('voting').at(-1));
  if (!truth.unclear) {
    const programs = {
      full: voting.edit && orNothing(() => propagated(voting.edit)),
      'seed only': voting.edit && orNothing(() => propagated({ seed: voting.edit.seed })),
    };
    if (oneShot !== null) programs['one shot'] = oneShotProgram(shape, oneShot);
    for (const [name, program] of Object.entries(programs)) {
      const result = score(buffers[entry], shape, program, truth);
      measured.get(name).push(result);
      row[name] = result;
    }
  }
  rows.push(row);
}

const number = (value) => (Number.isFinite(value) ? value.toFixed(3) : 'none');
for (const { model, request, seed, relations, hints, refused, full, 'one shot': oneShot } of rows) {
  const whole = seed === 1 && relations === 1 && hints === 1 ? ' ' : '-';
  const meshes = [
    ['mesh', full],
    ['one shot', oneShot],
  ].map(([name, result]) => (result === undefined ? '' : `  ${name} ${number(result.mesh)}`));
  const measures = `SE ${seed}  R ${relations.toFixed(2)}  T ${hints.toFixed(2)}${meshes.join('')}`;
  console.log(`${whole} ${model}: ${request}  |  ${measures}${refused > 0 ? `  refused ${refused}` : ''}`);
}

const mean = (list, of) => list.reduce((sum, one) => sum + of(one), 0) / list.length;
const table = (names, columns) =>
  Object.fromEntries(
    names
      .filter((name) => measured.get(name).length > 0)
      .map((name) => {
        const list = measured.get(name);
        const cells = Object.entries(columns).map(([column, of]) => [column, mean(list, of)]);
        return [name, { requests: list.length, ...Object.fromEntries(cells) }];
      }),
  );
const replies = table(readers, {
  'Acc(SE)': ({ seed }) => seed,
  'Acc(R)': ({ relations }) => relations,
  'J(T)': ({ hints }) => hints,
  Match: ({ seed, relations, hints }) => (seed === 1 && relations === 1 && hints === 1 ? 1 : 0),
});
const programs = table(makers, {
  ...(tool === undefined
    ? {}
    : {
        'J(prog)': ({ programmatic }) => programmatic,
        'D(geo)': ({ geometric }) => geometric,
        '%Rel': ({ structural }) => structural,
      }),
  meshes: ({ mesh }) => (mesh <= 0.01 ? 1 : 0),
});
if (options.each) {
  const wrong = (part) => each.filter((one) => one[part] < 1);
  const counts = ['seed', 'relations', 'hints'].map((part) => `${part} ${wrong(part).length}`);
  console.log(`each vote alone, of ${each.length} not as expected: ${counts.join(', ')}`);
  for (const one of each.filter(({ seed, relations, hints }) => Math.min(seed, relations, hints) < 1))
    console.log(`  ${one.model}, vote ${one.vote}: ${one.request}  SE ${one.seed}  R ${one.relations}  T ${one.hints}`);
}
console.table(replies);
console.table(programs);
if (options.json) writeFileSync(options.json, `${JSON.stringify({ replies, programs, rows }, null, 1)}\n`);
