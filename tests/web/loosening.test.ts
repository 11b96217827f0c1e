// Where on the slider a relation gives way, against places known by hand.
import { describe, expect, it } from 'vitest';
import { movedParts } from '../../web/src/program/edited';
import type { Layer, Shape, ShapeRelation, Statement, Vec3 } from '../../web/src/program/types';
import { looseningOf } from '../../web/src/session/loosening';
import { box, oneBox, twoBoxes } from './box_shapes';

const layer = (statements: readonly Statement[], min = -0.3, max = 0.3): Layer => ({
  request: '',
  parameter: { name: 'x1', min, max, value: 0 },
  statements,
  relations: [],
});
const move = (part: string, amount: string, direction: Vec3 = [0, 1, 0]): Statement => ({
  op: 'translate',
  part,
  feature: [0, 0, 0],
  direction,
  amount,
});
const [joint] = twoBoxes.relations;
if (joint === undefined) throw new Error('the boxes are not joined');

/** Three boxes in a row along x, 0.3 apart, and a post that the first of them touches, joined at a point. */
const spaces = [-0.3, 0, 0.3];
const row: Shape = {
  ...oneBox,
  parts: [
    box('post', 0, [-0.5, 0, 0], [0.1, 0.2, 0.1]),
    ...spaces.map((x, i) => ({ ...box(`slat_${i}`, i + 1, [x, 0, 0], [0.1, 0.2, 0.1]), group: 't1' })),
    {
      ...box('slats', -1, [0, 0, 0], [0.4, 0.2, 0.1]),
      primitive: -1,
      virtual: true,
      members: spaces.map((_, i) => `slat_${i}`),
      group: 't1',
    },
  ],
  relations: [
    {
      id: 't1',
      kind: 'translation',
      parts: spaces.map((_, i) => `slat_${i}`),
      parent: 'slats',
      start: [-0.3, 0, 0],
      end: [0.3, 0, 0],
      axis: 0,
      direction: 1,
    },
    {
      id: 'a1',
      kind: 'point',
      parts: ['post', 'slat_0'],
      points: [[-0.4, 0, 0]],
      local_a: [[1, 0, 0]],
      local_b: [[-1, 0, 0]],
    },
  ],
};
const rowJoint = row.relations[1];
if (rowJoint === undefined) throw new Error('the row is not joined');
const ofRow = (op: 'change_delta' | 'change_count', amount: string): Statement => ({
  op,
  relation: 't1',
  anchor: 'middle',
  amount,
});

describe('the parts that statements move', () => {
  it('are a part, or a row with its parent and every instance; what is kept fixed is not', () => {
    const all = ['slat_0', 'slat_1', 'slat_2', 'slats'];
    expect([...movedParts(row, [ofRow('change_delta', 'x1')])].sort()).toEqual(all);
    expect([...movedParts(row, [move('slats', 'x1')])].sort()).toEqual(all);
    expect([...movedParts(row, [move('node:1', 'x1')])]).toEqual(['slat_0']);
    expect(movedParts(row, [{ op: 'keep_fixed', part: 'post' }]).size).toBe(0);
  });
});

describe('the joint of an instance that its row takes along', () => {
  // Half a spacing of 0.3 on either side of the middle slat: the first moves by 0.3·x.
  const at = (beyond: number) => [beyond / 0.3, beyond / 0.3 + 0.35 / 96 + 1e-9] as const;

  it('has the tolerance of one edited part while the other stays, and of both when both move', () => {
    const found = looseningOf(row, layer([ofRow('change_delta', 'x1')], -0.35, 0.35), rowJoint);
    expect(found?.above).not.toBeNull();
    expect(found?.below).not.toBeNull();
    const spacing = (value: number) => (1 + value) * 0.3;
    expect(found?.above).toBeGreaterThan(spacing(at(0.0144)[0]) - 1e-9);
    expect(found?.above).toBeLessThan(spacing(at(0.0144)[1]));
    const both = looseningOf(row, layer([ofRow('change_delta', 'x1'), move('post', '0.01*x1')], -0.35, 0.35), rowJoint);
    expect(both?.above).toBeGreaterThan(spacing(at(0.0433)[0]) - 1e-9);
  });

  it('is not spoken of where the number of instances has changed', () => {
    const change = ofRow('change_count', '3*floor(100*abs(x1))');
    expect(looseningOf(row, layer([change, move('slats', 'x1')], -0.35, 0.35), rowJoint)).toBeNull();
  });
});

describe('a relation that an edit does not keep', () => {
  it('comes loose where it is off by more than the tolerance of one edited part', () => {
    const found = looseningOf(twoBoxes, layer([move('left', 'x1')]), joint);
    expect(found?.measure.read).toBeTypeOf('function');
    // The distance moved has the slider's sign; the scan has steps of 0.3 / 96.
    for (const at of [-(found?.below ?? 0), found?.above]) {
      expect(at).toBeGreaterThan(0.0144);
      expect(at).toBeLessThan(0.0144 + 0.3 / 96 + 1e-9);
    }
  });

  it('has more room when both parts are edited, and keeps whole on the side where they go together', () => {
    const found = looseningOf(twoBoxes, layer([move('left', 'x1'), move('right', 'min(x1, 0)')]), joint);
    expect(found?.below).toBeNull();
    expect(found?.above).toBeGreaterThan(0.0433);
    expect(found?.above).toBeLessThan(0.0433 + 0.3 / 96 + 1e-9);
  });

  it('is not spoken of when it never comes apart', () => {
    expect(looseningOf(twoBoxes, layer([move('left', 'x1'), move('right', 'x1')]), joint)).toBeNull();
  });
});

describe('what stands on the floor', () => {
  const stands: ShapeRelation = {
    id: 'g1',
    kind: 'ground',
    parts: ['left'],
    points: [[0.25, -0.25, 0]],
    local: [[0, -1, 0]],
  };
  const standing: Shape = { ...twoBoxes, relations: [...twoBoxes.relations, stands] };

  it('leaves it at the tolerance of one edited part, although its only part is edited', () => {
    const found = looseningOf(standing, layer([move('left', 'x1')]), stands);
    for (const at of [-(found?.below ?? 0), found?.above]) {
      expect(at).toBeGreaterThan(0.0144);
      expect(at).toBeLessThan(0.0144 + 0.3 / 96 + 1e-9);
    }
  });

  it('may slide along it', () => {
    expect(looseningOf(standing, layer([move('left', 'x1', [1, 0, 0])]), stands)).toBeNull();
  });
});
