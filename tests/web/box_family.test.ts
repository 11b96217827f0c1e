// A state of the sliders kept as a variation of a model that no program made: its boxes, the sliders that lead there, and what
// is saved of it.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Program, Shape, Statement } from '../../web/src/program/types';
import { askedOf, boxesOf, boxProgram } from '../../web/src/session/box_family';
import { emptyDocument, type Labels, noLabels, partKey } from '../../web/src/session/document';
import { familyOf } from '../../web/src/session/family';
import { editsOf, withFamily } from '../../web/src/session/family_state';
import type { ModelCore } from '../../web/src/session/model_core';
import { carryOver } from '../../web/src/session/relabel';
import { createSession } from '../../web/src/session/session';
import { readSaved, save } from '../../web/src/share/saved';
import { stool } from '../e2e/fixture';
import { boxes, wall } from '../e2e/wall';
import { twoBoxes } from './box_shapes';
import { cadCore, options, programText } from './cad_fixture';
import { call, type LoadedModule, loadWithCad } from './module';

let module: LoadedModule;
let core: ModelCore;
beforeAll(async () => {
  module = await loadWithCad();
  core = cadCore(module);
});

/** A file whose parts are boxes; what made it is not known any more. */
function tableFile(): Uint8Array {
  return call(module, 'open_cad', { name: 'table' }, [programText('table.scad')]).buffers[0] as Uint8Array;
}

function opened(main: Uint8Array, labels: Labels = noLabels) {
  const about = { name: 'model', external: [], labels: Object.fromEntries(labels) };
  const { shape } = call<{ shape: Shape }>(module, 'open', about, [main]).result;
  const files = { name: 'model', main, external: new Map<string, Uint8Array>() };
  const model = { files, shape, source: { kind: 'file' as const }, labels };
  const session = createSession();
  session.replaceDocument({ ...emptyDocument, model }, 'open');
  const edit = (statement: Statement, request: string) => {
    const seed = { format: 'parsel/edit', version: 1, seed: [statement], disabled: [], hints: {} };
    const { program } = call<{ program: Program }>(module, 'propagate', { edit: seed }).result;
    return session.addProgram(program, request)?.[0] as number;
  };
  /** Corners of all real parts where the sliders stand. */
  const stand = () => {
    const state = session.compiled.value;
    if (state.kind !== 'ready') throw new Error(state.kind);
    const { corners } = state.evaluator;
    return shape.parts.flatMap(({ virtual }, i) => (virtual ? [] : [...corners.slice(24 * i, 24 * i + 24)]));
  };
  return { session, model, shape, edit, stand };
}

const wider = {
  op: 'scale_1d',
  part: 'board',
  feature: [0, 0, 0],
  origin: { part: 'board', at: [0, 0, 0] },
  direction: [1, 0, 0],
  amount: 'x',
} as const;

const far = (a: readonly number[], b: readonly number[]) =>
  Math.max(...a.map((value, i) => Math.abs(value - (b[i] ?? Number.NaN))));

/** A table, a third wider, kept. */
async function kept() {
  const made = opened(tableFile());
  const rest = made.shape.parts.flatMap(({ virtual, corners }) => (virtual ? [] : corners.flat()));
  const key = made.edit(wider, 'wider');
  made.session.setValue(key, 0.3);
  const wide = made.stand();
  expect(await made.session.family.keepVariation(core, 'wide')).toBe(true);
  return { ...made, rest, wide };
}

describe('a state of the sliders kept as a variation of a model of boxes', () => {
  it('is where sliders of its own lead to, and the edits go back to 0', async () => {
    const { session, rest, wide, stand } = await kept();
    expect(far(wide, rest)).toBeGreaterThan(0.1);
    const { family } = session.document.value;
    expect(family?.found.family.variations.map(({ name }) => name)).toEqual(['wide']);
    expect(far(stand(), wide)).toBeLessThan(1e-5);
    expect(session.family.isShown(0)).toBe(true);
    expect(editsOf(session.document.value).map(({ value }) => value)).toEqual([0]);
    session.family.showVariation(null);
    expect(far(stand(), rest)).toBeLessThan(1e-6);
    session.family.mix(0, 0.5, true);
    const half = rest.map((value, i) => (value + (wide[i] ?? 0)) / 2);
    expect(far(stand(), half)).toBeLessThan(1e-5);
    for (let steps = 0; steps < 3; steps++) session.undo();
    expect(session.document.value.family).toBe(undefined);
    expect(far(stand(), wide)).toBe(0);
  });

  it('keeps what both share: the table stays one as its sliders move', async () => {
    const { session, shape } = await kept();
    const family = session.document.value.family;
    const name = (id: string) => id;
    for (const key of family?.keys ?? []) {
      const max = session.document.value.layers.find((entry) => entry.key === key)?.layer.parameter.max ?? 0;
      session.setValue(key, max);
    }
    const state = session.compiled.value;
    if (state.kind !== 'ready') throw new Error(state.kind);
    const read = boxesOf(shape, state.evaluator.corners, name);
    if (!read.ok) throw new Error(read.text);
    const of = (label: string) =>
      shape.parts
        .filter((part) => !part.virtual && part.label === label)
        .map((part) => read.bounds.get(partKey(part)) ?? []);
    const [board = []] = of('board');
    for (const leg of of('leg')) expect(leg[1]?.[1]).toBeCloseTo(board[1]?.[0] ?? 0, 5);
    const heights = of('leg').map(([, y]) => (y?.[1] ?? 0) - (y?.[0] ?? 0));
    for (const height of heights) expect(height).toBeCloseTo(heights[0] ?? 0, 5);
  });

  it('several are kept, on edits and on own sliders; the last that goes takes the family along', async () => {
    const { session, stand, edit } = await kept();
    session.family.showVariation(null);
    const key = edit({ ...wider, direction: [0, 0, 1] }, 'deeper');
    session.setValue(key, 0.2);
    const deep = stand();
    expect(await session.family.keepVariation(core, 'deep')).toBe(true);
    expect(far(stand(), deep)).toBeLessThan(1e-5);
    session.setValue(session.document.value.family?.keys[0] as number, 0.02);
    expect(await session.family.keepVariation(core, 'own')).toBe(true);
    const names = () => session.document.value.family?.found.family.variations.map(({ name }) => name);
    expect(names()).toEqual(['wide', 'deep', 'own']);
    session.family.showVariation(1);
    expect(far(stand(), deep)).toBeLessThan(1e-5);
    await session.family.removeVariation(core, 2);
    await session.family.removeVariation(core, 1);
    expect(names()).toEqual(['wide']);
    await session.family.removeVariation(core, 0);
    expect(session.document.value.family).toBe(undefined);
    expect(session.document.value.layers).toHaveLength(2); // the edits
  });

  it('is saved and opened again with its sliders, under other labels too', async () => {
    const { session, model, wide, stand } = await kept();
    const reopen = async (document: typeof session.document.value) => {
      const read = readSaved(JSON.parse(JSON.stringify(save(document))));
      if (!read.ok) throw new Error(read.text);
      expect(read.lost).toEqual([]);
      const again = createSession();
      const now = document.model ?? model;
      const source = await familyOf(core, now, read.saved.family, options);
      const layers = read.saved.program.layers.map((layer) => again.newEntry(layer as never, layer.parameter.value));
      again.replaceDocument(
        withFamily({ ...emptyDocument, model: now, layers }, source, read.saved.family, again.newEntry),
        'open',
      );
      return again;
    };
    const again = await reopen(session.document.value);
    expect(again.document.value.layers).toHaveLength(session.document.value.layers.length);
    expect(again.document.value.family?.keys).toHaveLength(session.document.value.family?.keys.length ?? -1);
    expect(again.family.isShown(0)).toBe(true);

    const [board] = model.shape.parts.filter(({ label }) => label === 'board');
    const labels = new Map([[partKey(board ?? { node: -1, primitive: -1 }), 'top']]);
    const other = opened(model.files.main, labels);
    const relabelled = carryOver(session.document.value, other.model);
    const renamed = await reopen(relabelled);
    expect(renamed.document.value.layers).toHaveLength(session.document.value.layers.length);
    expect(renamed.family.isShown(0)).toBe(true);
    expect(far(stand(), wide)).toBeLessThan(1e-5);

    const saved = { sliders: 1, choices: [], variations: { format: 'parsel/variations', version: 7 } };
    expect(await familyOf(core, model, saved, options)).toBe(null);
    expect(await familyOf(core, model, { sliders: 1, choices: [] }, options)).toBe(null);
  });

  it('lacks what is hidden', async () => {
    const { session, shape } = await kept();
    const shelf = shape.parts.find(({ label }) => label === 'shelf')?.id ?? '';
    session.setHidden([shelf], true);
    expect(await session.family.keepVariation(core, 'open below')).toBe(true);
    session.family.showVariation(0);
    expect([...session.document.value.hidden]).toEqual([]);
    session.family.showVariation(1);
    expect([...session.document.value.hidden]).toEqual([shelf]);
  });

  it('is written as OpenSCAD', async () => {
    const { session } = await kept();
    const family = session.document.value.family;
    if (family === undefined) throw new Error('no family');
    const setting = [...session.family.settingNow(family)];
    const about = { ...family.asked, choices: {}, setting };
    const { scad } = await core.familyText({ ...about, with: [] });
    const { read } = await core.readCad('again', new TextEncoder().encode(scad), options);
    expect(read.parts).toHaveLength(6);
  });
});

/** A table with a shelf between four legs, and slats under its top, each number off by up to `off` metres. */
function sloppyTable(off: number): Uint8Array {
  let seed = 7;
  const near = (values: readonly number[]) =>
    values.map((value) => {
      seed = (16807 * seed) % 2147483647;
      return value + off * ((2 * seed) / 2147483647 - 1);
    });
  const part = (name: string, translation: readonly number[], scale: readonly number[]) => ({
    name,
    translation: near(translation),
    scale: near(scale),
  });
  const corners = [-1, 1].flatMap((x) => [-1, 1].map((z) => [0.57 * x, 0.35, 0.27 * z]));
  return new Uint8Array(
    boxes([
      part('board', [0, 0.72, 0], [1.2, 0.04, 0.6]),
      ...corners.map((at) => part('leg', at, [0.06, 0.7, 0.06])),
      part('shelf', [0, 0.3, 0], [1.08, 0.03, 0.6]),
    ]),
  );
}

describe('a sloppy model', () => {
  /** Its family with a wider one, in which what lies outside is farther out. */
  const familyOfSloppy = async (off: number, isRounded = true) => {
    const { shape } = opened(sloppyTable(off));
    const made = boxProgram(shape, (id) => id);
    if (!made.ok) throw new Error(made.text);
    const { parts } = made.base.program as { parts: { id: string; centre: number[]; size: number[] }[] };
    const outer = (x: number) => x + (Math.abs(x) > 0.4 ? 0.2 * Math.sign(x) : 0);
    const bounds = parts.map(({ id, centre, size }) => {
      const at = (side: number) => centre.map((c, k) => c + (side * (size[k] ?? 0)) / 2);
      const [low, high] = [at(-1), at(1)];
      return [id, low.map((x, k) => (k === 0 ? [outer(x), outer(high[k] ?? 0)] : [x, high[k]]))] as const;
    });
    const variations = {
      format: 'parsel/variations',
      version: 1,
      variations: [{ name: 'wide', source: 'edit', bounds: Object.fromEntries(bounds) }],
    };
    const asked = isRounded
      ? askedOf(made.base, variations, shape.frame.scale)
      : { cad: made.base.program, variations };
    return (await core.findFamily({ ...asked, choices: {} } as never, options)).found;
  };

  it('has as few sliders as the one that was meant, and hardly moves for it', async () => {
    const meant = await familyOfSloppy(0);
    const sloppy = await familyOfSloppy(0.0005);
    const plain = await familyOfSloppy(0.0005, false);
    expect(sloppy.family.counts.sliders).toBe(meant.family.counts.sliders);
    expect(plain.family.counts.sliders).toBeGreaterThan(2 * sloppy.family.counts.sliders);
    const moved = Object.entries(sloppy.values).map(([name, value]) =>
      Math.abs(value - (plain.values[name] ?? Number.NaN)),
    );
    expect(Math.max(...moved)).toBeLessThan(0.002); // metres
  });

  it('is where its own sliders lead to, but for how sloppy it is', async () => {
    const { session, edit, stand } = opened(sloppyTable(0.001));
    session.setValue(edit(wider, 'wider'), 0.3);
    const wide = stand();
    expect(await session.family.keepVariation(core, 'wide')).toBe(true);
    expect(far(stand(), wide)).toBeLessThan(0.002); // of half the diagonal
    const { family } = session.document.value;
    if (family === undefined) throw new Error('no family');
    const setting = [...session.family.settingNow(family)];
    const { scad } = await core.familyText({ ...family.asked, choices: {}, setting, with: [] });
    expect((await core.readCad('again', new TextEncoder().encode(scad), options)).read.parts).toHaveLength(6);
  });
});

describe('what looks chosen', () => {
  it('is where the sliders stand: a variation, the program, or in a mixture neither', async () => {
    const { session } = await kept();
    const chosen = () => [null, 0].filter((variation) => session.family.isShown(variation));
    expect(chosen()).toEqual([0]);
    session.family.mix(0, 0.5, false);
    expect(chosen()).toEqual([]);
    session.family.mix(0, 0.5, true);
    expect(chosen()).toEqual([]);
    session.family.mix(0, 0, true);
    expect(chosen()).toEqual([null]);
  });
});

describe('what is no variation of boxes is refused with a sentence', () => {
  it.each([
    ['turned at rest', () => opened(stool), /boxes along the axes: “.*slat.*” is turned or slanted/],
    ['more than the core takes', () => opened(new Uint8Array(wall(9, 8))), /64/],
  ])('%s', async (_, open, wanted) => {
    const { session } = open();
    expect(await session.family.keepVariation(core, 'mine')).toBe(false);
    expect(session.notice.value).toMatchObject({ kind: 'error', text: expect.stringMatching(wanted) });
    expect(session.document.value.family).toBe(undefined);
  });

  it('of another number of parts', async () => {
    const slat = (i: number) => ({ name: 'slat', translation: [0.1 * i, 0.5, 0], scale: [0.05, 0.8, 0.02] });
    const rail = (y: number) => ({ name: 'rail', translation: [0.25, y, 0], scale: [0.6, 0.1, 0.02] });
    const { session, shape, edit } = opened(
      new Uint8Array(boxes([rail(0.05), rail(0.95), ...Array.from({ length: 6 }, (_, i) => slat(i))])),
    );
    const row = shape.relations.find(({ kind }) => kind === 'translation')?.id;
    const key = edit({ op: 'change_count', relation: row, anchor: 'fit', amount: '8*x' } as Statement, 'more slats');
    session.setValue(key, 0.3);
    expect(await session.family.keepVariation(core, 'mine')).toBe(false);
    expect(session.notice.value?.text).toMatch(/as many parts as the model: put the number of “.*slat.*” back first/);
    session.setValue(key, 0);
    expect(session.document.value.family).toBe(undefined);
  });

  it('slanted by an edit', async () => {
    const { session, edit } = opened(tableFile());
    const key = edit({ ...wider, op: 'shear', normal: [0, 1, 0], direction: [1, 0, 0] } as Statement, 'slant');
    session.setValue(key, 0.1);
    expect(await session.family.keepVariation(core, 'mine')).toBe(false);
    expect(session.notice.value?.text).toMatch(/is turned or slanted/);
  });

  it('turned by little, by an eighth, by a quarter; flat ones have no box', () => {
    const turned = (angle: number) => {
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      return twoBoxes.parts.flatMap(({ corners }) => corners.flatMap(([x, y, z]) => [c * x + s * z, y, c * z - s * x]));
    };
    const read = (corners: number[]) => boxesOf(twoBoxes, corners, (id) => id);
    expect(read(turned(0)).ok).toBe(true);
    expect(read(turned(Math.PI / 2)).ok).toBe(false);
    expect(read(turned(Math.PI)).ok).toBe(false);
    expect(read(turned(Math.PI / 4))).toMatchObject({ ok: false, text: expect.stringMatching(/“left”/) });
    expect(read(turned(0.001)).ok).toBe(false);
    expect(read(turned(0).map((value, i) => (i % 3 === 1 ? 0 : value))).ok).toBe(false);
    expect(boxProgram(twoBoxes, (id) => id)).toMatchObject({ ok: true });
  });
});
