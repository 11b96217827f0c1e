// What recorded variations of the gallery's CAD programs say is shared, against what was written down by hand before any
// reply was there (families.json): node tests/eval/families.mjs [--votes N]
//
// Both sets are closed under what they imply: a constraint of the program counts as found, or as wanted, when it follows
// from those that are (its rows lie in their span). precision = found and wanted / found, recall = … / wanted.
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { parseArgs } from 'node:util';
import { loadCore, root } from '../../web/tools/core.mjs';
import { readRecordings, renderKinds } from '../../web/tools/prompts.mjs';

export const readWanted = () => JSON.parse(readFileSync(join(root, 'tests', 'eval', 'families.json'), 'utf8'));

const axes = ['x', 'y', 'z'];

/** The linear forms of a feature such as "seat.x-", "wheel.x", "seat.x-y+z-", "seat.sy": [{parameter: factor}]. */
function formsOf(kind, feature) {
  const dot = feature.lastIndexOf('.');
  const [part, what] = [feature.slice(0, dot), feature.slice(dot + 1)];
  const plane = (axis, side) => ({ [`${part}.c${axis}`]: 1, [`${part}.s${axis}`]: side === '+' ? 0.5 : -0.5 });
  if (kind === 'equal') return [{ [feature]: 1 }];
  if (kind === 'coplanar') return [plane(what[0], what[1])];
  if (kind === 'coaxial') return axes.filter((axis) => axis !== what).map((axis) => ({ [`${part}.c${axis}`]: 1 }));
  return axes.map((axis) => {
    const at = what === 'centre' ? -1 : what.indexOf(axis);
    return at < 0 ? { [`${part}.c${axis}`]: 1 } : plane(axis, what[at + 1]);
  });
}

/** "coplanar(a.x-,b.x+)" → its rows, form of a minus form of b. */
export function rowsOf(id) {
  const [, kind, a, b] = /^(\w+)\(([^,]+),([^,]+)\)$/.exec(id) ?? [];
  if (kind === undefined) throw new Error(`${id} is no constraint.`);
  const others = formsOf(kind, b);
  return formsOf(kind, a).map((form, i) => {
    const row = new Map(Object.entries(form));
    for (const [name, factor] of Object.entries(others[i])) row.set(name, (row.get(name) ?? 0) - factor);
    for (const [name, factor] of row) if (Math.abs(factor) < 1e-12) row.delete(name);
    return row;
  });
}

/** Rows by elimination; add() tells whether a row is no combination of those before. */
function span() {
  const rows = new Map();
  const reduced = (row) => {
    const left = new Map(row);
    for (const [pivot, known] of rows) {
      const factor = left.get(pivot);
      if (factor === undefined) continue;
      for (const [name, value] of known) {
        const next = (left.get(name) ?? 0) - factor * value;
        if (Math.abs(next) < 1e-9) left.delete(name);
        else left.set(name, next);
      }
    }
    return left;
  };
  return {
    holds: (row) => reduced(row).size === 0,
    add(row) {
      const left = reduced(row);
      const [first] = left;
      if (first === undefined) return;
      const [pivot, value] = first;
      const own = new Map([...left].map(([name, factor]) => [name, factor / value]));
      for (const [other, known] of rows) {
        const factor = known.get(pivot);
        if (factor === undefined) continue;
        for (const [name, one] of own) {
          const next = (known.get(name) ?? 0) - factor * one;
          if (Math.abs(next) < 1e-9) known.delete(name);
          else known.set(name, next);
        }
        rows.set(other, known);
      }
      rows.set(pivot, own);
    },
  };
}

/** Those of `holding` that follow from `ids`. */
export function implied(ids, holding) {
  const known = span();
  for (const id of ids) for (const row of rowsOf(id)) known.add(row);
  return new Set(holding.filter((id) => rowsOf(id).every((row) => known.holds(row))));
}

/** @param found,wanted ids of constraints; @param holding all that hold in the program */
export function score(found, wanted, holding) {
  const [own, right] = [implied(found, holding), implied(wanted, holding)];
  const both = [...own].filter((id) => right.has(id));
  return {
    precision: own.size === 0 ? 1 : both.length / own.size,
    recall: right.size === 0 ? 1 : both.length / right.size,
    wrong: [...own].filter((id) => !right.has(id)),
    missed: [...right].filter((id) => !own.has(id)),
    found: own.size,
    wanted: right.size,
    holding: holding.length,
  };
}

/**
 * Of each program: its kinds, and how what they share compares.
 * @param votes of each kind that are counted, at most
 * @returns [{id, kinds: [{name, variation, agreed, unanimous, constraints, votes, refused}], score, family}]
 */
export function measureFamilies(core, recordings, votes = 9) {
  const wanted = readWanted();
  const { result, buffers } = core('cad_gallery', {});
  const rendered = renderKinds(core, recordings);
  return result.programs.map(({ id }, index) => {
    const { cad } = core('open_cad', { name: id }, [buffers[2 * index]]).result;
    const kinds = rendered
      .filter(({ model, task }) => model === `${id}_program` && task === 'variation')
      .flatMap(({ request: name, prompts: [{ hash }] }) => {
        const texts = (recordings.get(hash)?.replies ?? []).slice(0, votes).map(({ text }) => text);
        if (texts.length === 0) return [];
        const read = core('read_cad_replies', { cad, task: 'variation', kind: name, texts }).result;
        return [{ name, ...read, variation: read.variation.variations[0], votes: texts.length }];
      });
    const variations = { format: 'parsel/variations', version: 1, variations: kinds.map(({ variation }) => variation) };
    const { family } = core('find_family', { cad, variations, choices: {} }).result;
    const holding = family.constraints.map((one) => one.id);
    const found = family.constraints.filter(({ kept }) => kept).map((one) => one.id);
    return { id, kinds, family, score: score(found, wanted[id].wanted, holding) };
  });
}

if (process.argv[1] && import.meta.url === pathToFileURL(process.argv[1]).href) {
  const { values } = parseArgs({ options: { votes: { type: 'string', default: '9' } } });
  const all = measureFamilies(await loadCore(), readRecordings(), Number(values.votes));
  let [precision, recall] = [0, 0];
  for (const { id, kinds, family, score: one } of all) {
    precision += one.precision / all.length;
    recall += one.recall / all.length;
    process.stdout.write(
      `${id}: precision ${one.precision.toFixed(3)}, recall ${one.recall.toFixed(3)}; ${one.found} found, ${one.wanted} wanted of ` +
        `${one.holding}; ${family.counts.sliders} sliders\n`,
    );
    for (const { name, agreed, unanimous, constraints, votes, refused, variation } of kinds) {
      const lacks = variation.absent.length > 0 ? `, without ${variation.absent.join(', ')}` : '';
      process.stdout.write(
        `  ${name}: ${votes - refused.length} of ${votes} votes; of ${constraints} constraints most keep ${agreed}, all ${unanimous}${lacks}\n`,
      );
    }
    for (const id of one.wrong) process.stdout.write(`  not wanted: ${id}\n`);
    for (const id of one.missed) process.stdout.write(`  missed: ${id}\n`);
  }
  process.stdout.write(`mean precision ${precision.toFixed(3)}, mean recall ${recall.toFixed(3)}\n`);
}
