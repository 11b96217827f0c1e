// Pictures of the gallery, drawn here one after the other when the gallery is first looked at, and kept.
import { signal } from '@preact/signals';
import { loadModel } from '../scene/load';
import { modelOf, readUrl } from '../session/files';
import { galleryUrl } from '../session/gallery';

export const thumbnailUrls = signal<ReadonlyMap<string, string>>(new Map());

/** Draws those that are missing; answers how to stop. */
export function thumbnails(ids: readonly string[]): () => void {
  const controller = new AbortController();
  void draw(
    ids.filter((id) => !thumbnailUrls.peek().has(id)),
    controller.signal,
  );
  return () => controller.abort();
}

async function draw(ids: readonly string[], abort: AbortSignal): Promise<void> {
  if (ids.length === 0) return;
  const { ThumbnailPainter } = await import('../scene/thumbnail');
  const painter = new ThumbnailPainter(320, 240);
  try {
    for (const id of ids) {
      if (abort.aborted) return;
      try {
        const loaded = await loadModel(await modelOf(await readUrl(galleryUrl(id), abort)));
        const picture = await painter.paint(loaded);
        loaded.dispose();
        thumbnailUrls.value = new Map(thumbnailUrls.peek()).set(id, URL.createObjectURL(picture));
      } catch {
        // a model without a picture is still one that can be opened
      }
    }
  } finally {
    painter.dispose();
  }
}
