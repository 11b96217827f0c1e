// What a layer's measure reads, on the shape as it stands.
import type { LayerEntry } from './document';
import { type Measure, readAt } from './measure';
import { compiled, document, restIsShown, shownLayers, sliderValue } from './session';

/** At values of the layer's slider; everything else stays where it is. NaN while there is nothing to read. */
export function readLayer(entry: LayerEntry, measure: Measure, at: readonly number[]): number[] {
  const state = compiled.peek();
  const shape = document.peek().model?.shape;
  const layers = shownLayers();
  const index = layers.findIndex(({ key }) => key === entry.key);
  if (state.kind !== 'ready' || shape === undefined || index < 0) return at.map(() => Number.NaN);
  const readings = readAt(shape, measure, state.evaluator, layers.map(sliderValue), index, at);
  if (restIsShown.peek()) state.evaluator.evaluate(layers.map(() => 0));
  return readings;
}

/** The slider value at which a measure reads `wanted`, or the nearest there is: a scan, then bisection. */
export function solveLayer(entry: LayerEntry, measure: Measure, wanted: number): number {
  const { min, max } = entry.layer.parameter;
  const read = (x: number) => readLayer(entry, measure, [x])[0] ?? Number.NaN;
  const samples = Array.from({ length: 65 }, (_, i) => min + ((max - min) * i) / 64);
  const errors = samples.map((x) => read(x) - wanted);
  const nearest = (value: number) => Math.abs(value);
  let best = errors.reduce((found, error, i) => (nearest(error) < nearest(errors[found] ?? 0) ? i : found), 0);
  for (let i = 0; i < 64; i++) if ((errors[i] ?? 0) * (errors[i + 1] ?? 0) < 0) best = i;
  let [low, high] = [samples[best] ?? 0, samples[best + 1] ?? samples[best] ?? 0];
  const rising = (errors[best + 1] ?? 0) > (errors[best] ?? 0);
  if ((errors[best] ?? 0) * (errors[best + 1] ?? 1) >= 0) return low;
  for (let i = 0; i < 40; i++) {
    const middle = (low + high) / 2;
    if (read(middle) < wanted === rising) low = middle;
    else high = middle;
  }
  return (low + high) / 2;
}
