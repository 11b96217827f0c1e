// Sliders that a model offers by itself: geometry and labels say which, a worker of its own looks whether they are clean,
// one after the other, so that nothing waits for it.
import { type ReadonlySignal, signal } from '@preact/signals';
import type { Layer } from '../program/types';
import type { EditInput, OpenModel } from './document';
import type { ModelCore } from './model_core';
import type { Trace } from './trace';

export interface Offer {
  /** "Height", "Shelf count". */
  readonly title: string;
  readonly layer: Layer;
  readonly trace?: Trace;
}

export type Offers =
  | { readonly kind: 'none' }
  | { readonly kind: 'looking'; readonly model: OpenModel; readonly list: readonly Offer[] }
  | { readonly kind: 'done'; readonly model: OpenModel; readonly list: readonly Offer[] };

export interface OfferFinder {
  readonly offers: ReadonlySignal<Offers>;
  /** Looks for what the model offers; what was found for another model goes. */
  look(model: OpenModel): Promise<void>;
  /** Stops looking, and forgets. */
  stop(): void;
  /** Takes an offer off the list. */
  drop(offer: Offer): void;
}

/** @param core a core that nobody else waits for; asked for when it is needed */
export function createOffers(core: () => Promise<{ models: ModelCore; dispose(): void }>): OfferFinder {
  const offers = signal<Offers>({ kind: 'none' });
  let current: AbortController | null = null;

  function stop(): void {
    current?.abort();
    current = null;
    offers.value = { kind: 'none' };
  }

  async function look(model: OpenModel): Promise<void> {
    stop();
    const controller = new AbortController();
    current = controller;
    const { signal: aborted } = controller;
    offers.value = { kind: 'looking', model, list: [] };
    const { models, dispose } = await core();
    try {
      for (const { title, edit } of await models.offers(model)) {
        if (aborted.aborted) return;
        const found = await models
          .propagateClean(model, edit as unknown as EditInput, { signal: aborted })
          .catch(() => null);
        const layer = found?.program.layers[0];
        const now = offers.peek();
        if (aborted.aborted || now.kind !== 'looking') return;
        if (found === null || layer === undefined) continue;
        const offer: Offer = {
          title,
          layer: { ...layer, request: title },
          ...(found.trace ? { trace: found.trace } : {}),
        };
        offers.value = { ...now, list: [...now.list, offer] };
      }
    } catch {
      // A model that is too much for a second worker is one that is worked on without offers.
    } finally {
      dispose();
      const now = offers.peek();
      if (current === controller && now.kind === 'looking') offers.value = { ...now, kind: 'done' };
    }
  }

  return {
    offers,
    look,
    stop,
    drop(offer) {
      const now = offers.peek();
      if (now.kind !== 'none') offers.value = { ...now, list: now.list.filter((other) => other !== offer) };
    },
  };
}
