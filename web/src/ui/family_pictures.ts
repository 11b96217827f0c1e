// Pictures of a family's variations, drawn one after the other when they are first looked at, and let go with the family.
import { signal } from '@preact/signals';
import { loadModel } from '../scene/load';

/** Addresses by variation, for the pictures asked for last. */
export const familyPictures = signal<readonly (string | undefined)[]>([]);

/** Draws a picture of each GLB; answers how to stop and let them go. */
export function drawFamily(glbs: readonly Uint8Array[]): () => void {
  const controller = new AbortController();
  const made: string[] = [];
  familyPictures.value = [];
  void draw(glbs, controller.signal, made);
  return () => {
    controller.abort();
    for (const url of made) URL.revokeObjectURL(url);
  };
}

async function draw(glbs: readonly Uint8Array[], abort: AbortSignal, made: string[]): Promise<void> {
  if (glbs.length === 0) return;
  const { ThumbnailPainter } = await import('../scene/thumbnail');
  if (abort.aborted) return;
  const painter = new ThumbnailPainter(192, 144);
  try {
    for (const [i, main] of glbs.entries()) {
      try {
        const loaded = await loadModel({ name: '', main, external: new Map() });
        const picture = await painter.paint(loaded);
        loaded.dispose();
        if (abort.aborted) return;
        const url = URL.createObjectURL(picture);
        made.push(url);
        const next = [...familyPictures.peek()];
        next[i] = url;
        familyPictures.value = next;
      } catch {
        // a variation without a picture is still one that can be shown
      }
    }
  } finally {
    painter.dispose();
  }
}
