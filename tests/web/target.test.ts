// Where a slider is put by a size that was said.
import { describe, expect, it } from 'vitest';
import { emptyDocument, type LayerEntry } from '../../web/src/session/document';
import type { Measure } from '../../web/src/session/measure';
import { readLayer } from '../../web/src/session/reading';
import { addProgram, document, notice, replaceDocument, undo } from '../../web/src/session/session';
import { aimAt, measureAimed, wantedOf } from '../../web/src/session/target';
import type { Target } from '../../web/src/worker/protocol';
import { twoBoxes } from './box_shapes';
import { moving, openModel } from './fake_core';

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

  it('puts the slider there', () => {
    const { key, value, scale } = moved();
    aimAt(key, target({ by: 0.2 * scale }));
    expect(value()).toBeCloseTo(0.2, 6);
    expect(notice.value).toBe(null);
    undo();
    expect(value()).toBe(0);
  });

  it('of the whole is read off the whole', () => {
    const { key, value, scale } = moved();
    const aimed = target({ part: null, what: 'height', by: 0.1 * scale });
    const entry = () => document.value.layers[0] as LayerEntry;
    const measure = measureAimed(twoBoxes, aimed, entry().layer.statements[0]) as Measure;
    const [rest = 0] = readLayer(entry(), measure, [0]);
    aimAt(key, aimed);
    expect(readLayer(entry(), measure, [value()])[0]).toBeCloseTo(rest + 0.1 * scale, 6);
    expect(notice.value).toBe(null);
  });

  it('that is out of reach puts it at the end, and says so', () => {
    const { key, value, scale } = moved();
    aimAt(key, target({ by: 3 * scale }));
    expect(value()).toBeCloseTo(0.35);
    expect(notice.value?.text).toMatch(/^The slider goes no further than /);
  });
});
