// What the page's model offers: looked for when a model of one's own is opened that nobody has worked on yet.
import { effect, untracked } from '@preact/signals';
import wasmUrl from 'parsel-module/parsel.wasm?url';
import { startCore } from '../worker/client';
import { models } from './core';
import { emptyProgram } from './document';
import { modelCore } from './model_core';
import { createOffers, type Offer } from './offers';
import { addProgram, document, draft } from './session';

export const { offers, look, stop, drop } = createOffers(async () => {
  const client = await startCore(wasmUrl);
  return { models: modelCore(client), dispose: () => client.dispose() };
});

/** Makes an offer a layer of the work; answers its key. */
export function keepOffer(offer: Offer, value: number): number | null {
  const { model } = document.peek();
  if (model === null) return null;
  draft.value = null;
  const layer = { ...offer.layer, parameter: { ...offer.layer.parameter, value } };
  const [key] = addProgram({ ...emptyProgram(model.shape), layers: [layer] }, offer.title, offer.trace) ?? [];
  if (key === undefined) return null;
  drop(offer);
  return key;
}

/** Looks whenever a fresh model of one's own is there; answers how to stop. */
export function lookOnOpening(): () => void {
  let seen = document.peek().model?.files;
  return effect(() => {
    const { model, layers } = document.value;
    if (models.value === null || model?.files === seen) return;
    seen = model?.files;
    untracked(() => {
      if (model !== null && model.source.kind !== 'gallery' && layers.length === 0) void look(model);
      else stop();
    });
  });
}
