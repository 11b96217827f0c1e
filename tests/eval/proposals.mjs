// What becomes of the recorded proposals (prompts/proposals.json): how many are read, propagate, keep every relation, differ
// from each other, and how the sliders of a model stand together.
//
//   node tests/eval/proposals.mjs [--settings 1000] [--json]
//
// Clean, as the page calls it: nothing is seen to come apart or to run into each other anywhere in the range
// (core/prove/clearance.h), and no relation breaks but joints along which a part slides, which were to stay. Two programs
// differ by 1 − J(prog) (ParSEL, supplement §5.3.1): of the pairs (operator, operand). Joint settings are of the clean sliders
// of a model, composed as keeping them does, and drawn from all ranges at once; sound: no part inverts or collapses, and no
// relation breaks that each layer keeps alone (core/prove/together.h). Needs the WebAssembly build (web/start.sh --build-only).
import { parseArgs } from 'node:util';
import { loadCore } from '../../web/tools/core.mjs';
import { readProposals, readRecordings, renderProposals } from '../../web/tools/prompts.mjs';

const { values } = parseArgs({ options: { settings: { type: 'string', default: '1000' }, json: { type: 'boolean' } } });
const settings = Number(values.settings);
const core = await loadCore();
const recordings = readRecordings();
const textsOf = ({ hash }) => (recordings.get(hash)?.replies ?? []).map(({ text }) => text);

const operands = (program) =>
  new Set(
    program.layers.flatMap(({ statements }) => statements.map(({ op, part, relation }) => `${op} ${part ?? relation}`)),
  );
function similarity(a, b) {
  const both = [...a].filter((item) => b.has(item)).length;
  return both / (a.size + b.size - both || 1);
}

const brokenIn = (relations) => relations.filter(({ status }) => status === 'broken').map(({ id }) => id);

/** A program of the layers of several, under parameters of their own. */
function stacked(programs) {
  const layers = programs.flatMap(({ layers: own }, i) =>
    own.map((layer) => {
      const text = JSON.stringify({ ...layer, request: '' }).replaceAll(/\bx1\b/g, `p${i}`);
      return { ...JSON.parse(text), request: layer.request };
    }),
  );
  return { ...programs[0], layers };
}

/** As the page judges a slider: web/src/session/faults.ts. Ids of attachments begin with an a. */
function isClean(program) {
  const { faults } = core('seen', { program, layer: 0 }).result;
  return faults.length === 0 && brokenIn(program.layers[0].relations).every((id) => /^a\d/.test(id));
}

const found = [];
for (const proposal of readProposals()) {
  const [own, ...proposed] = renderProposals(core, [proposal], recordings);
  if (textsOf(own.prompts[0]).length === 0) continue;
  const entry = { ...proposal, proposed: [] };
  for (const { request, prompts } of proposed) {
    const replies = prompts.map((prompt) => ({ task: prompt.task, relation: null, texts: textsOf(prompt) }));
    const one = { request };
    entry.proposed.push(one);
    if (replies.some(({ texts }) => texts.length === 0)) {
      one.why = 'no recorded reading';
      continue;
    }
    const { seed, edit } = core('read_replies', { request, replies }).result;
    if (edit === null) {
      one.why = seed.reason ?? 'not read';
      continue;
    }
    one.read = true;
    try {
      one.program = core('propagate', { edit }).result.program;
      const [{ parameter, relations }] = one.program.layers;
      one.moves = parameter.min < parameter.max;
      one.broken = brokenIn(relations);
      one.clean = one.moves && isClean(one.program);
      if (!one.clean) {
        const hints = Object.fromEntries(Object.entries(edit.hints).filter(([, hint]) => hint !== 'keep_fixed'));
        one.looser = isClean(core('propagate', { edit: { ...edit, hints } }).result.program);
      }
    } catch (error) {
      one.why = error.message;
    }
  }
  const programs = entry.proposed.flatMap(({ program, moves }) => (program && moves ? [program] : []));
  const kept = entry.proposed.flatMap(({ program, clean }) => (clean ? [program] : []));
  const sets = programs.map(operands);
  const pairs = sets.flatMap((a, i) => sets.slice(i + 1).map((b) => similarity(a, b)));
  entry.similarity = pairs.length === 0 ? null : pairs.reduce((sum, x) => sum + x, 0) / pairs.length;
  entry.alike = pairs.filter((x) => x === 1).length;
  if (proposal.task === 'procedural_requests' && kept.length > 0) {
    try {
      const { program } = core('compose', { program: stacked(kept), first: 1 }).result;
      const drawn = core('siblings', { program, count: settings, seed: 1 }).result;
      entry.joint = { layers: kept.length, sound: settings / (settings + drawn.rejected), reasons: drawn.reasons };
    } catch (error) {
      entry.joint = { layers: kept.length, sound: 0, why: error.message };
    }
  }
  found.push(entry);
}

if (values.json) {
  process.stdout.write(`${JSON.stringify(found, null, 1)}\n`);
} else {
  const say = (line) => process.stdout.write(`${line}\n`);
  for (const task of ['procedural_requests', 'request_variations']) {
    const own = found.filter((entry) => entry.task === task);
    const all = own.flatMap(({ proposed }) => proposed);
    const count = (test) => all.filter(test).length;
    say(`${task}: ${own.length} replies, ${all.length} proposals`);
    say(`  read ${count(({ read }) => read)}, with a slider that moves ${count(({ moves }) => moves)}`);
    say(`  … and no broken relation ${count(({ moves, broken }) => moves && broken.length === 0)}`);
    say(`  … or only joints that slide: clean ${count(({ clean }) => clean)}`);
    say(`  … or when parts that were to stay follow ${count(({ clean, looser }) => clean || looser)}`);
    for (const { model, request, proposed, similarity: mean, alike, joint } of own) {
      say(
        `  ${model}${request ? `, ${request}` : ''}: J(prog) between them ${mean?.toFixed(2)}, ${alike} pairs the same`,
      );
      for (const { request: text, why, broken, clean, moves } of proposed) {
        if (why !== undefined) say(`    not: ${text}: ${why}`);
        else if (!moves) say(`    no room: ${text}`);
        else if (broken.length > 0) say(`    ${clean ? 'slides along' : 'breaks'} ${broken.join(', ')}: ${text}`);
      }
      if (joint !== undefined) {
        say(
          `    ${joint.layers} sliders together: ${(100 * joint.sound).toFixed(1)} % of random settings sound ${joint.why ?? ''}`,
        );
        for (const { reason, count: times } of (joint.reasons ?? []).slice(0, 3)) say(`      ${times} × ${reason}`);
      }
    }
  }
}
