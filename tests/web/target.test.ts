// Where a slider is put by a size that was said.
import { describe, expect, it } from 'vitest';
import { emptyDocument, type LayerEntry } from '../../web/src/session/document';
import type { Measure } from '../../web/src/session/measure';
import { readLayer } from '../../web/src/session/reading';
import { addProgram, document, notice, replaceDocument, undo } from '../../web/src/session/session';
import { aimAt, measureAimed, wantedOf } from '../../web/src/session/target';
import type { Target } from '../../web/src/worker/protocol';
import { twoBoxes } from './box_shapes';
import { fakeCore, moving, openModel } from './fake_core';

const target = (said: Partial<Target>): Target => ({ part: 'left', what: 'distance', x: 0.1, ...said });

describe('a size that was said', () => {
  it('is a difference, a size or a factor', () => {
    expect(wantedOf(target({ by: -0.1 }), 0.4)).toBeCloseTo(0.3);
    expect(wantedOf(target({ to: 0.8 }), 0.4)).toBe(0.8);
    expect(wantedOf(target({ times: 1.5 }), 0.4)).toBeCloseTo(0.6);
  });

  function moved() {
    replaceDocument({ ...emptyDocument, model: openModel('boxes') }, 'open boxes');
    const key = addProgram(moving('left'), 'lift it')?.[0] ?? -1;
    const value = () => document.value.layers.find((entry) => entry.key === key)?.value ?? Number.NaN;
    return { key, value, scale: twoBoxes.frame.scale };
  }

  it('puts the slider there', async () => {
    const { key, value, scale } = moved();
    await aimAt(null, key, target({ by: 0.2 * scale }));
    expect(value()).toBeCloseTo(0.2, 6);
    expect(notice.value).toBe(null);
    undo();
    expect(value()).toBe(0);
  });

  it('of the whole is read off the whole', async () => {
    const { key, value, scale } = moved();
    const aimed = target({ part: null, what: 'height', by: 0.1 * scale });
    const entry = () => document.value.layers[0] as LayerEntry;
    const measure = measureAimed(twoBoxes, aimed, entry().layer.statements[0]) as Measure;
    const [rest = 0] = readLayer(entry(), measure, [0]);
    await aimAt(null, key, aimed);
    expect(readLayer(entry(), measure, [value()])[0]).toBeCloseTo(rest + 0.1 * scale, 6);
    expect(notice.value).toBe(null);
  });

  it('stretches the range to it where all holds so far', async () => {
    const { key, value, scale } = moved();
    const core = fakeCore();
    core.extend = async (_, program, layer, to) => ({
      ...program,
      layers: program.layers.map((one, i) =>
        i === layer ? { ...one, parameter: { ...one.parameter, max: Math.min(to, 2) } } : one,
      ),
    });
    await aimAt(core, key, target({ by: 0.9 * scale }));
    expect(value()).toBeCloseTo(0.9, 6);
    expect(notice.value).toBe(null);
    undo();
    await aimAt(core, key, target({ by: 3 * scale }));
    expect(value()).toBeCloseTo(2);
    expect(notice.value?.text).toMatch(/^The slider goes no further than /);
  });

  it('that is out of reach puts it at the end, and says so', async () => {
    for (const core of [null, fakeCore()]) {
      const { key, value, scale } = moved();
      await aimAt(core, key, target({ by: 3 * scale }));
      expect(value()).toBeCloseTo(0.35);
      expect(notice.value?.text).toMatch(/^The slider goes no further than /);
    }
  });
});
