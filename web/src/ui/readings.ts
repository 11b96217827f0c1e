// Asking for other readings of an edit; the dialog that shows them comes when it is opened.
import { signal } from '@preact/signals';
import { type LayerEntry, partNames } from '../session/document';
import { saidFrom } from '../session/looking';
import { document } from '../session/session';
import { otherReadings } from '../session/suggestions';
import { dialog } from './actions';
import { paintNumbered } from './pictures';

/** Key of the layer that the dialog is about. */
export const readingsOf = signal<number | null>(null);

export function showReadings({ key, layer, seen }: LayerEntry): void {
  readingsOf.value = key;
  dialog.value = 'readings';
  const request = saidFrom(layer.request, seen ?? null, partNames(document.peek())).own;
  void otherReadings.start({ task: 'request_variations', request }, paintNumbered);
}
