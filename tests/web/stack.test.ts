// Layers whose amounts name the parameters of layers before them, when these are off or gone.
import { describe, expect, it } from 'vitest';
import { atRest, byThemselves } from '../../web/src/program/rest';
import type { Layer } from '../../web/src/program/types';

const layer = (name: string, amount: string): Layer => ({
  request: name,
  parameter: { name, min: -0.35, max: 0.35, value: 0 },
  statements: [{ op: 'translate', part: 'leg', feature: [0, 0, 0], direction: [1, 0, 0], amount }],
  relations: [],
});
const amountOf = ({ statements }: Layer) => (statements[0] as { amount: string }).amount;

describe('composed layers', () => {
  it('have 0 for the parameters of layers that are not there, and nothing else', () => {
    const second = layer('x2', '1.5e-3*x2*(1 + x1)/max(pi, x12) + floor(.5*e1)');
    expect(amountOf(atRest(second, new Set(['x2', 'x12'])))).toBe('1.5e-3*x2*(1 + 0)/max(pi, x12) + floor(.5*0)');
    expect(amountOf(byThemselves([second])[0] as Layer)).toBe('1.5e-3*x2*(1 + 0)/max(pi, 0) + floor(.5*0)');
  });

  it('are the same object where all are there, so that nothing is compiled anew', () => {
    const both = [layer('x1', 'x1'), layer('x2', '0.3*x2*(1 + x1)')];
    expect(byThemselves(both)).toEqual(both);
    expect(byThemselves(both)[1]).toBe(both[1]);
  });
});
