// What a layer's measure reads, on the shape as it stands.
import type { LayerEntry } from './document';
import { type Measure, readAt } from './measure';
import { compiled, document, shownLayers, sliderValue } from './session';

/** At values of the layer's slider; everything else stays where it is. NaN while there is nothing to read. */
export function readLayer(entry: LayerEntry, measure: Measure, at: readonly number[]): number[] {
  const state = compiled.peek();
  const shape = document.peek().model?.shape;
  const layers = shownLayers();
  const index = layers.findIndex(({ key }) => key === entry.key);
  if (state.kind !== 'ready' || shape === undefined || index < 0) return at.map(() => Number.NaN);
  return readAt(shape, measure, state.evaluator, layers.map(sliderValue), index, at);
}
