// Sliders that the model offers by itself, each to be tried on the spot, kept, or dropped.

import { useComputed, useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { models } from '../session/core';
import { type LayerEntry, withFreshParameters } from '../session/document';
import { seedsOf } from '../session/layer_seed';
import { formatMeasure, larger, measureOf } from '../session/measure';
import type { Offer } from '../session/offers';
import { drop, keepOffer, look, offers } from '../session/page_offers';
import { readLayer } from '../session/reading';
import { document, draft, newEntry, slide, sliderValue, step } from '../session/session';
import { number, t } from '../texts/texts';
import { Icon } from './Icon';

export function OffersPanel() {
  const state = offers.value;
  const { model } = document.value;
  if (model === null || models.value === null) return null;
  const mine = state.kind !== 'none' && state.model.shape === model.shape ? state : null;
  if (mine === null) {
    return (
      <button type="button" class="button wide" onClick={() => void look(model)}>
        {t`Find sliders for this model`}
      </button>
    );
  }
  const keepAll = () => {
    for (const offer of mine.list) keepOffer(offer, 0);
  };
  return (
    <section class="offers-panel" aria-label={t`Sliders this model offers`}>
      <header>
        <h3>{mine.list.length > 0 ? t`This model offers` : ''}</h3>
        {mine.kind === 'done' && mine.list.length > 1 && (
          <button type="button" class="button" onClick={keepAll}>
            {t`Keep all`}
          </button>
        )}
      </header>
      <ul>
        {mine.list.map((offer) => (
          <OfferCard key={offer.title} offer={offer} />
        ))}
      </ul>
      <p class="quiet" role="status">
        {mine.kind === 'looking' ? (
          <>
            <span class="spinner" aria-hidden="true" /> {t`Looking for sliders that keep everything together…`}
          </>
        ) : mine.list.length === 0 ? (
          t`No more sliders are offered. Say what to change, or pull a part.`
        ) : null}
      </p>
    </section>
  );
}

function OfferCard({ offer }: { offer: Offer }) {
  const entry = useSignal<LayerEntry | null>(null);
  const { min, max } = offer.layer.parameter;
  const isTried = entry.value !== null && draft.value?.key === entry.value.key;
  step.value; // the draft's slider is ahead of it while it is dragged
  const value = isTried && draft.value ? sliderValue(draft.value) : 0;
  const reading = useComputed(() => readingOf(offer, entry.value));
  // What is only tried goes with its card.
  useEffect(
    () => () => {
      if (entry.peek() !== null && draft.peek()?.key === entry.peek()?.key) draft.value = null;
    },
    [entry],
  );
  return (
    <li class="offer">
      <span class="offer-title">{offer.title}</span>
      <span class="quiet offer-value">{reading.value}</span>
      <button
        type="button"
        class="button icon-only"
        aria-label={t`Keep ${offer.title}`}
        title={t`Keep`}
        onClick={() => keepOffer(offer, value)}
      >
        <Icon name="check" />
      </button>
      <button
        type="button"
        class="button icon-only"
        aria-label={t`Drop ${offer.title}`}
        title={t`Drop`}
        onClick={() => drop(offer)}
      >
        <Icon name="close" />
      </button>
      <input
        type="range"
        min={min}
        max={max}
        step="any"
        value={value}
        aria-label={t`Try ${offer.title}`}
        aria-valuetext={reading.value || number(value, 2, 2)}
        onInput={(event) => {
          const to = event.currentTarget.valueAsNumber;
          if (!isTried) {
            entry.value = newEntry(named(offer));
            draft.value = entry.value;
          }
          if (entry.value !== null) slide(entry.value.key, to);
        }}
      />
    </li>
  );
}

/** Under a parameter that no layer of the work has. */
function named(offer: Offer) {
  const { layer } = offer;
  const taken = new Set(document.peek().layers.map((other) => other.layer.parameter.name));
  return withFreshParameters([layer], taken)[0] ?? layer;
}

function readingOf({ layer }: Offer, entry: LayerEntry | null): string {
  step.value; // reads the evaluator, which is no signal
  const { model, unit } = document.value;
  const shown = draft.value;
  if (model === null || entry === null || shown?.key !== entry.key) return '';
  const measure = measureOf(model.shape, seedsOf(layer)[0]);
  if (measure === null) return '';
  const [rest = 0, now = 0] = readLayer(shown, measure, [0, sliderValue(shown)]);
  return formatMeasure(measure.what, now, larger(rest, now), unit);
}
