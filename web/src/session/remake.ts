// A layer made anew from another edit, in its place: its card was reopened and changed.

import { isGroup, type Shape } from '../program/types';
import { t } from '../texts/texts';
import type { EditInput, LayerEntry } from './document';
import { editOf, seedsOf } from './layer_seed';
import type { ModelCore, Propagation } from './model_core';
import { change, document, entriesOf, session } from './session';

/** Propagates the edit and puts what comes of it in the layer's place, as one step. False, and a sentence, when it fails. */
export async function remake(core: ModelCore, key: number, edit: EditInput): Promise<boolean> {
  const entry = document.peek().layers.find((other) => other.key === key);
  if (entry === undefined) return false;
  const found = await session.find(core, edit, entry.layer.request);
  return found !== null && replaceLayer(entry, found);
}

/** False when the layer is another by now, or the found one does not fit beside the others, which is said. */
function replaceLayer({ key, layer: before }: LayerEntry, found: Propagation): boolean {
  const [made] = found.program.layers;
  const now = document.peek().layers.find((other) => other.key === key);
  if (made === undefined || now?.layer !== before) return false;
  const fits = entriesOf(found);
  const [fresh] = fits ?? [];
  if (fresh === undefined) return false;
  const { min, max } = fresh.layer.parameter;
  const { trace: _, ...rest } = now;
  const replaced: LayerEntry = {
    ...rest,
    layer: fresh.layer,
    value: Math.min(max, Math.max(min, now.value)),
    ...(fresh.trace === undefined ? {} : { trace: fresh.trace }),
  };
  change(t`change edit`, (state) => ({
    ...state,
    layers: state.layers.map((other) => (other.key === key ? replaced : other)),
  }));
  return true;
}

/** The other way to count a row: in the same room, or at the same spacing. */
export interface OtherReading {
  readonly keeps: 'room' | 'spacing';
  readonly edit: EditInput;
}

/** Of a layer whose one seed changes how many there are in a row; null for any other. */
export function otherCount(shape: Shape, { layer }: LayerEntry): OtherReading | null {
  const seeds = seedsOf(layer);
  const [seed] = seeds;
  if (seeds.length !== 1 || seed?.op !== 'change_count') return null;
  const group = shape.relations.filter(isGroup).find(({ id }) => id === seed.relation);
  if (group?.kind !== 'translation') return null;
  const edit = editOf(layer);
  const keeps = seed.anchor === 'fit' ? 'spacing' : 'room';
  const anchor = keeps === 'room' ? 'fit' : 'middle';
  return { keeps, edit: { ...edit, seed: edit.seed.map((one) => ({ ...one, anchor }) as typeof one) } };
}
