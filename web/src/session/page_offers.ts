// What the page's model offers: looked for when a model of one's own is opened that nobody has worked on yet.
import { effect, untracked } from '@preact/signals';
import { startCore } from '../worker/modules';
import { models } from './core';
import { emptyProgram } from './document';
import { madeBy } from './layers';
import { modelCore } from './model_core';
import { createOffers, type Offer } from './offers';
import { addProgram, document, draft } from './session';

export const { offers, look, stop, drop } = createOffers(async () => {
  const client = await startCore();
  return { models: modelCore(client), dispose: () => client.dispose() };
});

/** Makes an offer a layer of the work; answers its key. */
export function keepOffer(offer: Offer, value: number): number | null {
  const { model } = document.peek();
  if (model === null) return null;
  draft.value = null;
  const layer = { ...offer.layer, parameter: { ...offer.layer.parameter, value } };
  const [key] = addProgram({ ...emptyProgram(model.shape), layers: [layer] }, offer.title, madeBy(offer)) ?? [];
  if (key === undefined) return null;
  drop(offer);
  return key;
}

/** A model that has been there for so long (ms) is one that somebody looks at: tabs that a browser brings back come first. */
const settled = 1500;

/**
 * Looks whenever a fresh model of one's own is there, or is seen with other labels or joints, and nobody has begun to work on
 * it; answers how to stop.
 */
export function lookOnOpening(): () => void {
  let seen = document.peek().model?.shape;
  let waiting: ReturnType<typeof setTimeout> | undefined;
  const lookIfFresh = () => {
    const { model, layers } = document.peek();
    if (model !== null && model.source.kind !== 'gallery' && layers.length === 0) void look(model);
  };
  const end = effect(() => {
    const { model } = document.value;
    if (models.value === null || model?.shape === seen) return;
    seen = model?.shape;
    clearTimeout(waiting);
    untracked(stop);
    waiting = setTimeout(lookIfFresh, settled);
  });
  return () => {
    clearTimeout(waiting);
    end();
  };
}
