// A slider put where a request said: "10 cm longer", "exactly 80 cm", "twice as high".

import type { Shape, Statement } from '../program/types';
import { t } from '../texts/texts';
import type { Target } from '../worker/protocol';
import { putAt } from './extend';
import { formatMeasure, larger, type Measure, measureOf, sizeOf } from './measure';
import type { ModelCore } from './model_core';
import { readLayer, solveLayer } from './reading';
import { document, say, setValue } from './session';

/** What a target is read off: the whole, or the quantity that the layer's seed changes. */
export function measureAimed(shape: Shape, target: Target, seed: Statement | undefined): Measure | null {
  const { part, what } = target;
  if (part !== null || (what !== 'width' && what !== 'height' && what !== 'depth')) return measureOf(shape, seed);
  const axis = { width: 0, height: 1, depth: 2 }[what] as 0 | 1 | 2;
  return { part: null, what, read: (evaluator) => sizeOf(shape, evaluator, null)[axis] };
}

/** What the measure shall read, when it reads `rest` at 0 of the slider. */
export function wantedOf({ by, to, times }: Target, rest: number): number {
  if (to !== undefined) return to;
  return times !== undefined ? rest * times : rest + (by ?? 0);
}

/**
 * Puts the layer's slider there, beyond its end where that holds (extend.ts), or as near as it gets, which it then says.
 * @param core what can stretch its range; null leaves the range
 */
export async function aimAt(core: ModelCore | null, key: number, target: Target): Promise<void> {
  const { layers, model } = document.peek();
  const entry = layers.find((other) => other.key === key);
  if (entry === undefined || model === null) return;
  const { layer } = entry;
  const seed = layer.statements.find(({ why }) => why?.kind === 'seed') ?? layer.statements[0];
  const measure = measureAimed(model.shape, target, seed);
  const { min, max } = layer.parameter;
  const estimate = Math.min(max, Math.max(min, target.x));
  if (measure === null) {
    setValue(key, estimate);
    return;
  }
  const [rest = Number.NaN] = readLayer(entry, measure, [0]);
  const wanted = wantedOf(target, rest);
  // Counts go in steps: the middle of one is surer than its edge, where a search ends.
  const stepwise = measure.what === 'count';
  if (stepwise || core === null) setValue(key, stepwise ? estimate : solveLayer(entry, measure, wanted));
  else await putAt(core, entry, measure, wanted);
  const now = document.peek().layers.find((other) => other.key === key);
  if (now === undefined) return;
  const [reached = wanted] = readLayer(now, measure, [now.value]);
  const show = (value: number) => formatMeasure(measure.what, value, larger(rest, wanted), document.peek().unit);
  if (show(reached) !== show(wanted))
    say(t`The slider goes no further than ${show(reached)}; ${show(wanted)} was asked for.`);
}
