// What can be done with the cards as a whole, and what of it saved work keeps.
import { describe, expect, it } from 'vitest';
import { createCards } from '../../web/src/session/cards';
import { emptyDocument } from '../../web/src/session/document';
import { editOf } from '../../web/src/session/layer_seed';
import { formatLengths, formatMeasure, parseMeasure } from '../../web/src/session/measure';
import { createSession } from '../../web/src/session/session';
import { stretchOf } from '../../web/src/session/sizes';
import { withExtras } from '../../web/src/share/extras';
import { readSaved, save } from '../../web/src/share/saved';
import { twoBoxes } from './box_shapes';
import { moving, openModel } from './fake_core';

function opened() {
  const session = createSession();
  session.replaceDocument({ ...emptyDocument, model: openModel('boxes') }, 'open boxes');
  const keys = ['left', 'right'].map((part) => session.addProgram(moving(part), 'add')?.[0] ?? -1);
  return { session, cards: createCards(session), keys: keys as [number, number] };
}
const values = ({ session }: ReturnType<typeof opened>) => session.document.value.layers.map(({ value }) => value);

describe('cards', () => {
  it('go back to rest all at once, as one step', () => {
    const work = opened();
    const { session, cards, keys } = work;
    session.setValue(keys[0], 0.1);
    session.setValue(keys[1], -0.2);
    cards.resetAll();
    expect(values(work)).toEqual([0, 0]);
    session.undo();
    expect(values(work)).toEqual([0.1, -0.2]);
    session.undo();
    cards.resetAll();
    cards.resetAll(); // nothing to do is no step
    expect(session.undoLabel.value).toBe('reset all sliders');
    session.undo();
    expect(values(work)).toEqual([0.1, 0]);
  });

  it('keep positions under a name, and take them again', () => {
    const work = opened();
    const { session, cards, keys } = work;
    session.slide(keys[0], 0.3); // also what is still being dragged
    cards.savePreset(' high ');
    cards.savePreset('   ');
    expect(session.document.value.presets?.map(({ name }) => name)).toEqual(['high']);
    cards.resetAll();
    session.setValue(keys[1], 0.1);
    cards.applyPreset('high');
    expect(values(work)).toEqual([0.3, 0]);
    session.removeLayer(keys[0]);
    session.setValue(keys[1], 0.1);
    cards.applyPreset('high');
    expect(values(work)).toEqual([0]);
    cards.savePreset('high');
    expect(session.document.value.presets).toHaveLength(1);
    cards.removePreset('high');
    expect(session.document.value.presets).toEqual([]);
  });

  it('are duplicated behind themselves, at rest, under a parameter of their own', () => {
    const work = opened();
    const { session, cards, keys } = work;
    session.setValue(keys[0], 0.2);
    const copy = cards.duplicateLayer(keys[0]);
    expect(session.document.value.layers.map(({ key }) => key)).toEqual([keys[0], copy, keys[1]]);
    expect(values(work)).toEqual([0.2, 0, 0]);
    const names = session.document.value.layers.map(({ layer }) => layer.parameter.name);
    expect(new Set(names).size).toBe(3);
    expect(cards.duplicateLayer(999)).toBeNull();
  });

  it('go through a file and back with their presets, groups and unit', () => {
    const { session, cards, keys } = opened();
    session.setValue(keys[1], 0.2);
    cards.savePreset('wide');
    cards.setGroup(keys[1], ' sizes ');
    cards.setUnit('in');
    const text = JSON.parse(JSON.stringify(save(session.document.value)));
    expect(text).toMatchObject({ unit: 'in', groups: [[1, 'sizes']], presets: [{ name: 'wide' }] });
    const read = readSaved({ ...text, model: { name: 'boxes', sha256: 'a'.repeat(64) } });
    if (!read.ok) throw new Error(read.text);
    const again = withExtras({ ...emptyDocument, layers: session.document.value.layers }, read.saved);
    expect(again.unit).toBe('in');
    expect(again.layers.map(({ group }) => group)).toEqual([undefined, 'sizes']);
    expect([...(again.presets?.[0]?.values ?? [])]).toEqual([
      [keys[0], 0],
      [keys[1], 0.2],
    ]);
    cards.setGroup(keys[1], '');
    cards.setUnit(null);
    expect(save(session.document.value)).not.toHaveProperty('groups');
    expect(save(session.document.value)).not.toHaveProperty('unit');
  });

  it('that are damaged lose their edit, and presets and groups follow the others', () => {
    const { session, cards, keys } = opened();
    session.setValue(keys[1], 0.2);
    cards.savePreset('wide');
    cards.setGroup(keys[1], 'sizes');
    const text = JSON.parse(JSON.stringify(save(session.document.value)));
    text.model.sha256 = 'a'.repeat(64);
    text.program.layers[0].statements = 'gone';
    const read = readSaved(text);
    if (!read.ok) throw new Error(read.text);
    expect(read.lost).toEqual(['edit 1']);
    expect(read.saved.groups).toEqual([[0, 'sizes']]);
    expect(read.saved.presets).toEqual([{ name: 'wide', values: [[0, 0.2]] }]);
    const other = readSaved({ ...text, presets: 'none' });
    expect(other.ok && other.lost).toEqual(['edit 1', 'presets, groups, the unit and whose sides are meant']);
  });
});

describe('the model as it was', () => {
  it('is shown until it is told otherwise, and no slider moves', () => {
    const { session, keys } = opened();
    session.setValue(keys[0], 0.2);
    const height = () => {
      const state = session.compiled.value;
      return state.kind === 'ready' ? (state.evaluator.corners[1] ?? Number.NaN) : Number.NaN;
    };
    const raised = height();
    session.showRest(true);
    expect(session.restIsShown.value).toBe(true);
    expect(height()).toBeCloseTo(raised - 0.2);
    expect(session.document.value.layers[0]?.value).toBe(0.2);
    session.showRest(false);
    expect(height()).toBeCloseTo(raised);
    session.showRest(true);
    session.slide(keys[0], 0.1);
    expect(session.restIsShown.value).toBe(false);
    expect(height()).toBeCloseTo(raised - 0.1);
  });
});

describe('lengths', () => {
  it('are shown and read in the unit that was chosen', () => {
    expect(formatLengths([0.508, 0.9, 0.04], 'in')).toEqual({ lengths: ['20', '35.43', '1.57'], unit: 'in' });
    expect(formatLengths([0.5, 0.9, 0.04])).toEqual({ lengths: ['50', '90', '4'], unit: 'cm' });
    expect(formatMeasure('width', 0.5, 0.5, 'mm')).toBe('500 mm');
    expect(parseMeasure('width', '20', 0.5, 'in')).toBeCloseTo(0.508);
    expect(parseMeasure('width', '20 cm', 0.5, 'in')).toBeCloseTo(0.2);
    expect(parseMeasure('width', '8"', 0.5)).toBeCloseTo(0.2032);
    expect(parseMeasure('angle', '90', 1, 'in')).toBeCloseTo(Math.PI / 2);
  });

  it('of a part are changed by a stretch along its own edge, from where it stands', () => {
    const part = twoBoxes.parts[0]?.id ?? '';
    expect(stretchOf(twoBoxes, part, 0, 1.2)).toMatchObject({ op: 'scale_1d', amount: 'x', origin: { at: [0, 0, 0] } });
    expect(stretchOf(twoBoxes, part, 1, 0.4)).toMatchObject({ amount: '-2*x', origin: { at: [0, -1, 0] } });
    expect(stretchOf(twoBoxes, 'nobody', 1, 0.4)).toBeNull();
  });
});

describe('the edit of a layer', () => {
  it('is its seeds in x, and what was not to count', () => {
    const [layer] = moving('left').layers;
    if (layer === undefined) throw new Error('no layer');
    const seed = { op: 'translate', part: 'left', feature: [0, 0, 0], direction: [0, 1, 0] } as const;
    const edit = editOf({
      ...layer,
      parameter: { ...layer.parameter, name: 'x2' },
      statements: [
        { op: 'keep_fixed', part: 'right', why: { kind: 'attachment', relations: [] } },
        { ...seed, amount: '2*x2', why: { kind: 'seed', relations: [] } },
      ],
      relations: [{ id: 'r1', status: 'disabled', worst: 0, proof: 'certified' }],
    });
    expect(edit).toEqual({ seed: [{ ...seed, amount: '2*x' }], disabled: ['r1'], hints: {} });
  });
});
