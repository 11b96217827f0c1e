// Pictures of suggested kinds, drawn as they come in.
import { effect, signal } from '@preact/signals';
import { loadModel } from '../scene/load';
import type { ThumbnailPainter } from '../scene/thumbnail';
import type { KindsActions } from '../session/kinds';

/** Addresses by GLB. */
export const kindPictures = signal<ReadonlyMap<Uint8Array, string>>(new Map());

/** Answers how to stop and let them go. */
export function drawKinds({ asked }: Pick<KindsActions, 'asked'>): () => void {
  const controller = new AbortController();
  const begun = new Set<Uint8Array>();
  let painter: Promise<ThumbnailPainter> | null = null;
  let queue: Promise<void> = Promise.resolve();

  async function draw(main: Uint8Array): Promise<void> {
    try {
      painter ??= import('../scene/thumbnail').then((module) => new module.ThumbnailPainter(192, 144));
      const loaded = await loadModel({ name: '', main, external: new Map() });
      const picture = controller.signal.aborted ? null : await (await painter).paint(loaded);
      loaded.dispose();
      if (picture === null || controller.signal.aborted) return;
      kindPictures.value = new Map(kindPictures.peek()).set(main, URL.createObjectURL(picture));
    } catch {
      // a kind without a picture is still one that can be kept
    }
  }

  const stop = effect(() => {
    for (const { state } of asked.value?.cards ?? []) {
      if (state.kind !== 'drawn' || begun.has(state.picture)) continue;
      begun.add(state.picture);
      queue = queue.then(() => draw(state.picture));
    }
  });
  return () => {
    stop();
    controller.abort();
    void queue.then(async () => (await painter)?.dispose());
    for (const url of kindPictures.peek().values()) URL.revokeObjectURL(url);
    kindPictures.value = new Map();
  };
}
