// The ends of a slider: how far it goes in what it changes, and where on its track something comes apart.

import type { LayerEntry } from '../session/document';
import { cleanEnds } from '../session/loosening';
import { formatMeasure, larger, type Measure } from '../session/measure';
import { readLayer } from '../session/reading';
import { document, step } from '../session/session';
import { t } from '../texts/texts';

/** Where the clean part of the track begins and ends, as shares of its length: custom properties of `.track`. */
export function cleanShares({ layer }: LayerEntry): Record<string, number> {
  const shape = document.value.model?.shape;
  const { min, max } = layer.parameter;
  if (shape === undefined || max === min) return {};
  const clean = cleanEnds(shape, layer);
  return { '--clean-low': (clean.min - min) / (max - min), '--clean-high': (clean.max - min) / (max - min) };
}

/** The least and the greatest value. */
export function Ends({ entry, measure }: { entry: LayerEntry; measure: Measure }) {
  step.value; // reads the evaluator, which is no signal
  const { min, max } = entry.layer.parameter;
  if (!entry.enabled || min === max) return null;
  const [least = 0, greatest = 0] = readLayer(entry, measure, [min, max]);
  if (!Number.isFinite(least) || !Number.isFinite(greatest)) return null;
  const show = (value: number) => formatMeasure(measure.what, value, larger(least, greatest), document.value.unit);
  return (
    <p
      class="ends quiet"
      title={t`This slider goes from ${show(least)} to ${show(greatest)}; type a value to go further`}
    >
      <span class="visually-hidden">{t`Goes from@range`} </span>
      <span>{show(least)}</span>
      <span class="visually-hidden"> {t`to@range`} </span>
      <span>{show(greatest)}</span>
    </p>
  );
}
