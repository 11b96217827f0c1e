// Where on the slider a relation gives way, against places known by hand.
import { describe, expect, it } from 'vitest';
import type { Layer, Statement } from '../../web/src/program/types';
import { looseningOf } from '../../web/src/session/loosening';
import { twoBoxes } from './box_shapes';

const layer = (statements: readonly Statement[], min = -0.3, max = 0.3): Layer => ({
  request: '',
  parameter: { name: 'x1', min, max, value: 0 },
  statements,
  relations: [],
});
const move = (part: string, amount: string): Statement => ({
  op: 'translate',
  part,
  feature: [0, 0, 0],
  direction: [0, 1, 0],
  amount,
});
const [joint] = twoBoxes.relations;
if (joint === undefined) throw new Error('the boxes are not joined');

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
