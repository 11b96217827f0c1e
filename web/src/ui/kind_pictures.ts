// Pictures of suggested kinds, drawn as they come in.
import { effect, signal } from '@preact/signals';
import { loadModel, type ModelFiles } from '../scene/load';
import type { ThumbnailPainter } from '../scene/thumbnail';
import type { CadPicture } from '../session/cad_pictures';
import type { KindsActions } from '../session/kinds';
import { asCut } from './family_pictures';

/** Addresses by what they show. */
export const kindPictures = signal<ReadonlyMap<CadPicture, string>>(new Map());

/** Answers how to stop and let them go. */
export function drawKinds({ asked }: Pick<KindsActions, 'asked'>): () => void {
  const controller = new AbortController();
  const begun = new Set<CadPicture>();
  let painter: Promise<ThumbnailPainter> | null = null;
  let queue: Promise<void> = Promise.resolve();

  async function draw(files: ModelFiles, picture: CadPicture): Promise<void> {
    try {
      const [main = picture.glb] = await asCut(files, [picture], controller.signal);
      painter ??= import('../scene/thumbnail').then((module) => new module.ThumbnailPainter(192, 144));
      const loaded = await loadModel({ name: '', main, external: new Map() });
      const drawn = controller.signal.aborted ? null : await (await painter).paint(loaded);
      loaded.dispose();
      if (drawn === null || controller.signal.aborted) return;
      kindPictures.value = new Map(kindPictures.peek()).set(picture, URL.createObjectURL(drawn));
    } catch {
      // a kind without a picture is still one that can be kept
    }
  }

  const stop = effect(() => {
    const now = asked.value;
    for (const { state } of now?.cards ?? []) {
      if (now === null || state.kind !== 'drawn' || begun.has(state.picture)) continue;
      begun.add(state.picture);
      queue = queue.then(() => draw(now.model.files, state.picture));
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
