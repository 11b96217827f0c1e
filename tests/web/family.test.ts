// Families of the gallery's CAD programs, from the core through the session: sliders, stops, mixtures, what is shared, and
// work that is saved and opened again.
import { beforeAll, describe, expect, it } from 'vitest';
import { emptyDocument } from '../../web/src/session/document';
import { familyOf, withProgramRead } from '../../web/src/session/family';
import type { FamilyState } from '../../web/src/session/family_found';
import { choicesFor, sharedClasses } from '../../web/src/session/family_shared';
import {
  absentIds,
  areThere,
  baseOf,
  editsOf,
  lengthAt,
  mixed,
  settingOf,
  stopsOf,
  withFamily,
} from '../../web/src/session/family_state';
import type { ModelCore } from '../../web/src/session/model_core';
import { createSession } from '../../web/src/session/session';
import { readSaved, save } from '../../web/src/share/saved';
import { cadCore, openProgram, options, programText } from './cad_fixture';
import { moving } from './fake_core';
import { type LoadedModule, loadWithCad } from './module';

const programs = ['bottle', 'camera', 'car', 'chair', 'table'] as const;

let module: LoadedModule;
let core: ModelCore;
beforeAll(async () => {
  module = await loadWithCad();
  core = cadCore(module);
});

const opened = (name: string) => openProgram(core, module, name);

const close = (a: readonly number[], b: readonly number[]) => {
  expect(a.length).toBe(b.length);
  for (const [k, value] of a.entries()) expect(value).toBeCloseTo(b[k] as number, 6);
};

describe('the family of a program', () => {
  it.each(programs)(
    '%s: sliders evaluate, and every variation lies within what they and their stops allow',
    async (name) => {
      const { session, family } = await opened(name);
      expect(session.compiled.value.kind).toBe('ready');
      const { sliders, variations } = family().found.family;
      expect(family().keys).toHaveLength(sliders.length);
      expect(family().pictures).toHaveLength(variations.length);
      for (const [i, { absent }] of variations.entries()) {
        session.family.showVariation(i);
        const now = session.family.settingNow(family());
        expect(session.family.isShown(i)).toBe(true);
        for (const [k, { parameter }] of sliders.entries()) {
          if (absent.includes(parameter.split('.')[0] as string)) continue; // moves nothing that is there
          expect(now[k]).toBeCloseTo(settingOf(family(), i)[k] as number, 6);
        }
        for (const k of sliders.keys()) {
          const { low, high } = stopsOf(family(), now, k, (id) => absent.includes(id));
          expect(low).toBeLessThanOrEqual((now[k] as number) + 1e-6);
          expect(high).toBeGreaterThanOrEqual((now[k] as number) - 1e-6);
        }
      }
      session.undo();
      expect(session.family.isShown(variations.length - 2)).toBe(true);
    },
  );

  it('what the page draws at a variation is what the program makes there', async () => {
    const { session, family, model } = await opened('chair');
    const bounds = JSON.parse(new TextDecoder().decode(programText('chair.variations.json'))).variations[3];
    expect(bounds.name).toBe('bar stool');
    session.family.showVariation(3);
    const state = session.compiled.value;
    if (state.kind !== 'ready') throw new Error(state.kind);
    const seat = model.shape.parts.findIndex(({ id }) => id === 'seat');
    const corners = state.evaluator.corners.slice(seat * 24, seat * 24 + 24);
    const metres = family().found.metres;
    for (const axis of [0, 2]) {
      const along = [...corners].filter((_, i) => i % 3 === axis);
      const size = (Math.max(...along) - Math.min(...along)) * model.shape.frame.scale;
      expect(size).toBeCloseTo((bounds.bounds.seat[axis][1] - bounds.bounds.seat[axis][0]) * metres, 6);
    }
    expect([...session.document.value.hidden].sort()).toEqual(['arm_left', 'arm_right']);
  });

  it('mixes: weights alone, together and beyond a whole, on top of what was moved by hand', async () => {
    const { session, family } = await opened('chair');
    const f = family();
    const none = f.weights.map(() => 0);
    close(mixed(f, none), baseOf(f));
    close(
      mixed(
        f,
        f.weights.map((_, i) => (i === 2 ? 1 : 0)),
      ),
      settingOf(f, 2),
    );
    const both = mixed(
      f,
      f.weights.map((_, i) => (i < 2 ? 1 : 0)),
    );
    close(
      both,
      settingOf(f, 0).map((value, k) => (value + (settingOf(f, 1)[k] as number)) / 2),
    );

    const k = f.found.family.sliders.findIndex(({ name }) => name === 'leg height');
    session.setValue(f.keys[k] as number, 0.01);
    const before = session.family.settingNow(family());
    session.family.mix(3, 0.25, false);
    expect(session.document.value.layers[k]?.value).toBeCloseTo(0.01); // not kept yet
    session.family.mix(3, 0.5, true);
    const half = mixed(
      f,
      f.weights.map((_, i) => (i === 3 ? 0.5 : 0)),
    );
    const moved = session.family.settingNow(family());
    expect((moved[k] as number) - (before[k] as number)).toBeCloseTo((half[k] as number) - (baseOf(f)[k] as number), 6);
    session.undo();
    close(session.family.settingNow(family()), before);
    expect(family().weights).toEqual(none);
  });

  it('a slider stops where parts would meet, and says which', async () => {
    const { family } = await opened('table');
    const f = family();
    const stops = f.found.family.sliders.map((_, k) => stopsOf(f, baseOf(f), k, () => false));
    const said = stops.flatMap(({ lowText, highText }) => [lowText, highText]).filter((one) => one !== null);
    expect(said.join('\n')).toMatch(/the \w.* meets the \w/);
    for (const [k, { low }] of stops.entries()) expect(low).toBeLessThanOrEqual(baseOf(f)[k] as number);
  });

  it('what is shared is told by class, and switching a class changes the sliders and nothing that stands', async () => {
    const { session, family, cad } = await opened('chair');
    const { constraints } = family().found.family;
    const classes = sharedClasses(constraints, cad.parts);
    const told = classes.flatMap(({ ids }) => ids);
    expect(new Set(told).size).toBe(told.length);
    const isCorner = (id: string) => /^coincident/.test(id);
    expect(constraints.filter(({ id }) => !told.includes(id) && !isCorner(id))).toEqual([]);
    const texts = classes.filter(({ agreement }) => agreement === 'common').map(({ text: said }) => said);
    expect(texts).toContain('The legs are equally high');
    expect(texts).toContain('The seat on top of the legs');
    expect(texts.length).toBeLessThan(constraints.length / 3);

    session.family.showVariation(1);
    const parameters = () => session.compiled.value.kind === 'ready' && [...session.compiled.value.evaluator.corners];
    const stood = parameters() as number[];
    const before = family().keys.length;
    const onTop = classes.filter(({ text: said }) => /^The (back|arms|seat) on top of/.test(said));
    const changes = new Map(onTop.flatMap((shared) => [...choicesFor(shared, false)]));
    await session.family.choose(core, changes);
    expect(family().keys.length).toBeGreaterThan(before);
    close(parameters() as number[], stood);
    const again = sharedClasses(family().found.family.constraints, cad.parts);
    const off = again.filter(({ key }) => onTop.some((shared) => shared.key === key));
    expect(off.map(({ kept }) => kept)).toEqual(onTop.map(() => false));
    await session.family.choose(core, new Map(off.flatMap((shared) => [...choicesFor(shared, true)])));
    expect(family().keys.length).toBe(before);
    expect(family().choices).toEqual({});
  });

  it('keeps what is shown as a variation, and lets it go', async () => {
    const { session, family } = await opened('table');
    const { length } = family().found.family.variations;
    session.family.showVariation(0);
    session.setValue(family().keys[0] as number, session.document.value.layers[0]?.layer.parameter.max as number);
    const stood = session.family.settingNow(family());
    expect(await session.family.keepVariation(core, 'my own')).toBe(true);
    expect(family().found.family.variations.at(-1)?.name).toBe('my own');
    const byName = new Map(family().found.family.sliders.map(({ name }, k) => [name, settingOf(family(), length)[k]]));
    expect([...byName.values()].length).toBeGreaterThanOrEqual(stood.length); // one more may be needed
    await session.family.removeVariation(core, length);
    expect(family().found.family.variations).toHaveLength(length);
  });

  /** A block with two holes, of which one is not in every variation, and nothing else tells two of these apart. */
  const block = {
    scad: `difference() {
  // block
  cube([40, 20, 10]);
  // hole
  translate([10, 10, -1]) cylinder(d = 6, h = 12);
  // slot
  translate([25, 5, -1]) cube([10, 10, 12]);
}
// lid
translate([0, 0, 10]) cube([40, 20, 2]);
`,
    variations: {
      format: 'parsel/variations',
      version: 1,
      variations: [{ name: 'full' }, { name: 'without hole', absent: ['hole'] }, { name: 'open', absent: ['lid'] }],
    },
  };

  it('optional parts that only cut are there or not: shown, undone, kept as variation, saved, and written', async () => {
    const { session, family, model, cad } = await openProgram(core, module, 'block', block);
    const groups = family().found.family.optional.map(({ parts }) => parts);
    expect(groups).toEqual(expect.arrayContaining([['hole'], ['lid']]));
    const gone = () => [...absentIds(session.document.value)].sort();
    const pressed = () => [null, 0, 1, 2].filter((variation) => session.family.isShown(variation));
    expect(pressed()).toEqual([null, 0]);
    session.family.setThere(['hole'], false);
    expect(gone()).toEqual(['hole']);
    expect([...session.document.value.hidden]).toEqual([]);
    expect(pressed()).toEqual([1]); // no slider tells them apart
    session.undo();
    expect(gone()).toEqual([]);
    session.redo();
    session.family.setThere(['lid'], false);
    expect(gone()).toEqual(['hole', 'lid']);
    expect(pressed()).toEqual([]);
    session.family.showVariation(2);
    expect(gone()).toEqual(['lid']);
    session.family.showVariation(1);
    expect(gone()).toEqual(['hole']);

    const read = readSaved(JSON.parse(JSON.stringify(save(session.document.value))));
    if (!read.ok) throw new Error(read.text);
    expect(read.lost).toEqual([]);
    const source = await familyOf(core, model, read.saved.family, options);
    const again = withFamily({ ...emptyDocument, model }, source, read.saved.family, session.newEntry);
    expect([...absentIds(again)]).toEqual(['hole']);
    const other = { ...read.saved.family, sliders: 0, choices: [], without: ['hole', 'block', 'no such part'] };
    expect(withFamily({ ...emptyDocument, model }, source, other, session.newEntry).family?.without).toEqual(['hole']);

    expect(await session.family.keepVariation(core, 'mine')).toBe(true);
    expect(family().found.family.variations.at(-1)).toMatchObject({ name: 'mine', absent: ['hole'] });
    expect(gone()).toEqual(['hole']); // as it stood
    const about = { cad: cad.program, variations: family().variations, choices: {} };
    const { scad } = await core.familyText({
      ...about,
      setting: [...session.family.settingNow(family())],
      with: family().found.family.optional.map(({ parts }) => areThere(session.document.value, parts)),
    });
    expect(scad).toMatch(/^\w*hole\w* = false;/m);
  });

  it('is saved and opened again: values, choices, own variations; edits behind the sliders stay edits', async () => {
    const { session, family, model, cad } = await opened('chair');
    session.addProgram(moving('seat'), 'lift the seat');
    const [first] = sharedClasses(family().found.family.constraints, cad.parts).filter(({ kept }) => kept);
    await session.family.choose(core, choicesFor(first as NonNullable<typeof first>, false));
    session.family.showVariation(2);
    const read = readSaved(JSON.parse(JSON.stringify(save(session.document.value))));
    if (!read.ok) throw new Error(read.text);
    expect(read.saved.family?.variations).toBeUndefined(); // they come with the program
    const source = await familyOf(core, model, read.saved.family, options);
    const other = createSession();
    const layers = read.saved.program.layers.map((layer) => other.newEntry(layer as never, layer.parameter.value));
    const document = withFamily({ ...emptyDocument, model, layers }, source, read.saved.family, other.newEntry);
    other.replaceDocument(document, 'open');
    close(other.family.settingNow(document.family as FamilyState), session.family.settingNow(family()));
    expect(editsOf(document).map(({ layer }) => layer.request)).toEqual(
      editsOf(session.document.value).map(({ layer }) => layer.request),
    );
    expect(document.family?.choices).toEqual(family().choices);

    const damaged = await familyOf(core, model, { sliders: 1, choices: [['no such', 'off']] }, options);
    expect(damaged?.choices).toEqual({});
  });

  it('is written as OpenSCAD that begins where it stands, and reads back to that', async () => {
    const { session, family, cad } = await opened('chair');
    session.family.showVariation(3);
    const setting = [...session.family.settingNow(family())];
    const about = { cad: cad.program, variations: family().variations, choices: {}, setting };
    const { scad, sets } = await core.familyText({ ...about, with: family().found.family.optional.map(() => true) });
    expect(Object.keys(sets.parameterSets)).toContain('bar stool');
    const { sliders } = family().found.family;
    for (const [k, { variable }] of sliders.entries()) {
      const [, value] = new RegExp(`^${variable} = (\\S+);`, 'm').exec(scad) ?? [];
      expect(Number(value)).toBeCloseTo(setting[k] as number, 6);
      expect(lengthAt(family(), k, 0)).toBe(sliders[k]?.value);
    }
    const { read } = await core.readCad('again', new TextEncoder().encode(scad), options);
    const parts = (read.cad as unknown as { parts: { label: string; size: number[] }[] }).parts;
    expect(parts.find(({ label }) => label === 'seat')?.size[1]).toBeCloseTo(40, 9);
  });
});

describe('programs that cannot be opened', () => {
  const loop = 'module m() { m(); }\n\nm();\n';
  it.each([
    ['without an end', loop, /line 1|line 3/],
    ['minkowski', 'cube(1);\nminkowski() { cube(1); sphere(1); }\n', /line 2/],
    ['text', 'cube(1);\n\ntext("hello");\n', /line 3/],
    ['import', 'import("x.stl");\n', /line 1/],
    ['a statement without an end', 'cube([1, 2, 3]);\ntranslate([0, 0\n', /line [23]/],
    ['division by zero', 'cube([1, 1, 1 / 0]);\n', /line 1/],
    ['10 MB', 'cube([1, 1, 1]);\n'.repeat(620_000), /MB|MiB|bytes|large|long/],
  ])('%s: refused by line, within a second', async (_, program, wanted) => {
    const began = performance.now();
    const main = new TextEncoder().encode(program);
    const read = withProgramRead(
      core,
      { name: 'x', main, external: new Map(), program: { variations: null } },
      options,
    );
    await expect(read).rejects.toThrow(wanted);
    expect(performance.now() - began).toBeLessThan(10_000); // a second on a machine that does nothing else
  });
});
