// The form of a seed edit: nothing of an edit is lost in it, and another part or operator changes what it must.
import { describe, expect, it } from 'vitest';
import type { Shape, Statement } from '../../web/src/program/types';
import { choiceOf, firstChoice, isWhole, seedOf, withPart } from '../../web/src/ui/seed_choice';
import { box, twoBoxes } from './box_shapes';

const row: Shape = {
  ...twoBoxes,
  parts: [
    ...twoBoxes.parts,
    { ...box('row', -1, [0, 0, 0], [0.5, 0.5, 0.5]), virtual: true, members: ['left', 'right'] },
  ],
  relations: [
    ...twoBoxes.relations,
    {
      id: 't1',
      kind: 'translation',
      parts: ['left', 'right'],
      parent: 'row',
      start: [0.25, 0, 0],
      end: [-0.25, 0, 0],
      axis: 0,
      direction: -1,
    },
  ],
};

const origin = { part: 'right', at: [1, 0, -1] } as const;
const seeds: Statement[] = [
  { op: 'translate', part: 'left', feature: [1, 0, 0], direction: [0.6, 0, 0.8], amount: '-2*x' },
  { op: 'rotate', part: 'left', feature: [0, 0, 0], origin, axis: { part: 'right', axis: 1 }, amount: 'pi*x' },
  { op: 'scale_1d', part: 'left', feature: [0, 0, 0], origin: [0.1, 0.2, 0.3], direction: [0, -1, 0], amount: 'x' },
  { op: 'scale_2d', part: 'left', feature: [0, 1, 0], origin, normal: [0, 1, 0], amount: 'x' },
  { op: 'scale_3d', part: 'left', feature: [0, 0, 0], origin, amount: '0.5*x' },
  { op: 'shear', part: 'left', feature: [0, 0, 0], origin, normal: [1, 0, 0], direction: [0, 1, 0], amount: 'x' },
  { op: 'change_count', relation: 't1', anchor: 'fit', amount: '-8*x' },
  { op: 'change_delta', relation: 't1', anchor: 'start', amount: 'x' },
  { op: 'keep_fixed', part: 'left' },
];

describe('the form of a seed edit', () => {
  it.each(seeds)('gives back $op as it was', (seed) => {
    const choice = choiceOf(row, seed);
    expect(isWhole(row, choice)).toBe(true);
    expect(seedOf(row, choice)).toEqual(seed);
  });

  it('wants a part, and a row for what only rows do', () => {
    expect(isWhole(row, firstChoice)).toBe(false);
    expect(isWhole(row, { ...firstChoice, part: 'left', op: 'change_count' })).toBe(true);
    expect(isWhole(twoBoxes, { ...firstChoice, part: 'left', op: 'change_count' })).toBe(false);
  });

  it('takes what was told by the old part from the new one, and leaves the rest', () => {
    const own = { part: 'left', at: [0, -1, 0] } as const;
    const before = choiceOf(row, {
      op: 'rotate',
      part: 'left',
      feature: [0, 0, 0],
      origin: own,
      axis: [0, 1, 0],
      amount: 'x',
    });
    expect(withPart(row, before, 'right').origin).toEqual({ part: 'right', at: [0, -1, 0] });
    const elsewhere = { ...before, origin: [1, 2, 3] as const };
    expect(withPart(row, elsewhere, 'right')).toMatchObject({ part: 'right', origin: [1, 2, 3] });
    const count = choiceOf(row, { op: 'change_count', relation: 't1', anchor: 'fit', amount: '8*x' });
    expect(withPart(twoBoxes, count, 'right').op).toBe('translate');
  });

  it('slants upwards from front to back, and sideways the higher up', () => {
    const slant = { ...firstChoice, part: 'left', op: 'shear' } as const;
    expect(seedOf(row, { ...slant, direction: [0, 1, 0] })).toMatchObject({ normal: [0, 0, 1] });
    expect(seedOf(row, { ...slant, direction: [1, 0, 0] })).toMatchObject({ normal: [0, 1, 0] });
  });
});
