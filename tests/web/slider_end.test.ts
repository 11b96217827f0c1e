import { describe, expect, it } from 'vitest';
import type { Trace } from '../../web/src/session/trace';
import { reasonOfEnd } from '../../web/src/ui/slider_end';
import { moving } from './fake_core';

const [layer] = moving('seat').layers;
if (layer === undefined) throw new Error('the program has a layer');
const traced = (min: string, max: string): Trace => ({ steps: [], notes: [], stop: '', ends: { min, max } });

describe('the end of a slider', () => {
  it('is told at that end alone', () => {
    const entry = { layer, trace: traced('seat would collapse', 'seat and back would come apart') };
    expect(reasonOfEnd(entry, layer.parameter.min)).toBe('seat would collapse');
    expect(reasonOfEnd(entry, layer.parameter.max)).toBe('seat and back would come apart');
    expect(reasonOfEnd(entry, 0.2)).toBeNull();
  });

  it('is not worth a word where it is far enough, or where nobody knows', () => {
    expect(reasonOfEnd({ layer, trace: traced('limit', '') }, layer.parameter.min)).toBeNull();
    expect(reasonOfEnd({ layer, trace: traced('limit', '') }, layer.parameter.max)).toBeNull();
    expect(reasonOfEnd({ layer, trace: { steps: [], notes: [], stop: '' } }, layer.parameter.max)).toBeNull();
    expect(reasonOfEnd({ layer }, layer.parameter.max)).toBeNull();
  });
});
