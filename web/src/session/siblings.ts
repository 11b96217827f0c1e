// Siblings of the model: every slider somewhere in its range, drawn by the core from settings that are sound together
// (core/prove/together.h). ParSEL §8.1.

import { signal } from '@preact/signals';
import { t } from '../texts/texts';
import { models } from './core';
import { programOf } from './document';
import { activeLayers } from './evaluation';
import { document, run, setValues } from './session';

export interface Sibling {
  /** By key of the layer. */
  readonly values: ReadonlyMap<number, number>;
}

/** Of the next that is drawn: the same seed on the same sliders gives the same siblings. */
export const seed = signal(1);

/** Draws siblings of the present work with the next seed; null, and a sentence, when there are none. */
export async function drawSiblings(count: number): Promise<readonly Sibling[] | null> {
  const core = models.peek();
  const { model } = document.peek();
  if (core === null || model === null) return null;
  const layers = activeLayers(document.peek());
  const own = seed.peek();
  seed.value = own + 1;
  const drawn = await run(t`Looking for settings that go together`, (options) =>
    core.siblings(model, programOf(model.shape, layers), count, own, options),
  );
  if (drawn === null || document.peek().model !== model) return null;
  return drawn.siblings.map((values) => ({
    values: new Map(layers.map(({ key }, i) => [key, values[i] ?? 0])),
  }));
}

/** Puts all sliders at once, as one step that undo takes back. */
export function takeSibling({ values }: Sibling): void {
  setValues(values, t`take a sibling`);
}

/** Puts all sliders somewhere in their ranges. */
export async function surprise(): Promise<void> {
  const [drawn] = (await drawSiblings(1)) ?? [];
  if (drawn !== undefined) setValues(drawn.values, t`surprise me`);
}
