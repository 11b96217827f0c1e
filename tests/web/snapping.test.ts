// Sliders that stop at whole lengths, and a ruler whose points go with their parts.
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { Program, Statement } from '../../web/src/program/types';
import { emptyDocument, type LengthUnit } from '../../web/src/session/document';
import { readLayer } from '../../web/src/session/reading';
import { measured, ruler, setPoint, toggleRuler } from '../../web/src/session/ruler';
import { session } from '../../web/src/session/session';
import { lengthOf, snap, snapped, snapping } from '../../web/src/session/snapping';
import { twoBoxes } from './box_shapes';
import { openModel } from './fake_core';

const { addProgram, document, entryOf, replaceDocument, setValue, undo, undoLabel } = session;

const program = (statement: Partial<Statement>, min = -1, max = 1): Program => ({
  format: 'parsel/program',
  version: 1,
  shape: { name: '', sha256: '' },
  layers: [
    {
      request: 'an edit',
      parameter: { name: 'x', min, max, value: 0 },
      statements: [
        {
          feature: [0, 0, 0],
          part: 'left',
          amount: 'x',
          why: { kind: 'seed', relations: [] },
          ...statement,
        } as Statement,
      ],
      relations: [],
    },
  ],
});
const stretch = { op: 'scale_1d', direction: [0, 1, 0], origin: { part: 'left', at: [0, -1, 0] } } as const;

/** The box is 0.5 normalised units high, which the frame's scale makes metres. */
function ready(made: Program, scale = 1.37, unit?: LengthUnit) {
  const shape = { ...twoBoxes, frame: { centre: [0, 0, 0] as const, scale } };
  replaceDocument({ ...emptyDocument, model: openModel('boxes', shape), ...(unit ? { unit } : {}) }, 'open');
  const key = addProgram(made, 'edit')?.[0] ?? -1;
  const entry = entryOf(key);
  if (entry === undefined) throw new Error('no layer');
  const length = (value: number) => {
    const measure = lengthOf(entry);
    return measure === null ? Number.NaN : (readLayer(entry, measure, [value])[0] ?? Number.NaN);
  };
  return { entry, length };
}

beforeEach(() => snap(true));
afterEach(() => {
  snap(false);
  ruler.value = null;
  while (undoLabel.peek() !== null) undo();
});

describe('snapping', () => {
  it.each([-0.4, -0.017, 0.03, 0.2, 0.71])('takes a slider at %f to the nearest whole centimetre', (value) => {
    const { entry, length } = ready(program(stretch));
    const whole = snapped(entry, value);
    const cm = length(whole) * 100;
    expect(cm).toBeCloseTo(Math.round(cm), 4);
    expect(Math.abs(length(whole) - length(value))).toBeLessThan(0.00501);
  });

  it('finds it where the length is no straight line of the slider', () => {
    const { entry, length } = ready(program({ ...stretch, amount: 'x + 0.8*x*x' }, -0.5, 0.9));
    for (const value of [-0.3, 0.1, 0.8]) {
      const cm = length(snapped(entry, value)) * 100;
      expect(cm).toBeCloseTo(Math.round(cm), 4);
    }
  });

  it('goes by whole inches where lengths are in inches', () => {
    const { entry, length } = ready(program(stretch), 1.37, 'in');
    const inches = length(snapped(entry, 0.2)) / 0.0254;
    expect(inches).toBeCloseTo(Math.round(inches), 4);
  });

  it('by keyboard goes to the next one, up and down, and from a whole one as well', () => {
    const { entry, length } = ready(program(stretch));
    const start = snapped(entry, 0.1);
    const cm = (value: number) => Math.round(length(value) * 1e4) / 100;
    expect(cm(snapped(entry, start, 1))).toBeCloseTo(cm(start) + 1, 6);
    expect(cm(snapped(entry, start, -1))).toBeCloseTo(cm(start) - 1, 6);
    expect(cm(snapped(entry, start, 10))).toBeCloseTo(cm(start) + 10, 6);
    const between = (start + snapped(entry, start, 1)) / 2;
    expect(cm(snapped(entry, between, 1))).toBeCloseTo(cm(start) + 1, 6);
    expect(cm(snapped(entry, between, -1))).toBeCloseTo(cm(start), 6);
  });

  it('turns round where more of the slider is less of the length', () => {
    const { entry, length } = ready(program({ ...stretch, amount: '-x' }));
    const start = snapped(entry, 0.1);
    expect(length(snapped(entry, start, 1))).toBeCloseTo(length(start) - 0.01, 6);
  });

  it('leaves angles and what is off alone, and stays within the range', () => {
    const turning = ready(program({ op: 'rotate', axis: [0, 1, 0], origin: { part: 'left', at: [0, 0, 0] } }));
    expect(snapped(turning.entry, 0.123)).toBe(0.123);
    const { entry } = ready(program(stretch, -0.1, 0.1));
    expect(snapped(entry, 0.0999)).toBeLessThanOrEqual(0.1);
    expect(snapped(entry, 0.0999, 50)).toBe(0.1);
    snap(false);
    expect(snapping.value).toBe(false);
    expect(snapped(entry, 0.0123)).toBe(0.0123);
  });
});

describe('the ruler', () => {
  it('measures between two points, which move with their parts', () => {
    const { entry } = ready(program({ op: 'translate', direction: [1, 0, 0] }), 2);
    toggleRuler();
    setPoint('right', [-1, 1, 0.98]); // nearly an edge: it is taken for one
    expect(measured.value).toMatchObject({ points: [[-0.5, 0.25, 0.25]], length: null });
    setPoint('left', [1, 1, 1]);
    const length = () => measured.value?.length;
    expect(length()?.whole).toBeCloseTo(2, 12);
    expect(length()?.along).toEqual([2, 0, 0]);
    setValue(entry.key, 0.25);
    expect(length()?.whole).toBeCloseTo(2.5, 12);
  });

  it('begins anew with a third point, and is put away', () => {
    ready(program(stretch));
    toggleRuler();
    for (const part of ['left', 'right', 'left']) setPoint(part, [0.5, 0, 0]);
    expect(ruler.value).toEqual([{ part: 'left', at: [0.5, 0, 0] }]);
    toggleRuler();
    expect([ruler.value, measured.value]).toEqual([null, null]);
    setPoint('left', [0, 0, 0]);
    expect(ruler.value).toBe(null);
  });

  it('says nothing of a part that is gone', () => {
    ready(program(stretch));
    toggleRuler();
    setPoint('left', [0, 0, 0]);
    setPoint('nobody', [0, 0, 0]);
    expect(measured.value).toEqual({ points: [], length: null });
    replaceDocument(emptyDocument, 'close');
    expect(document.value.model).toBe(null);
    toggleRuler();
    toggleRuler();
    expect(ruler.value).toBe(null);
  });
});
