// Pictures of a family's variations, drawn one after the other when they are first looked at, and let go with the family.
import { signal } from '@preact/signals';
import { loadModel, type ModelFiles } from '../scene/load';
import { type CadPicture, picturesOf } from '../session/cad_pictures';
import type { FamilySource } from '../session/family_found';
import { cutPictures } from '../session/solid';

/** Addresses by variation, for the pictures asked for last. */
export const familyPictures = signal<readonly (string | undefined)[]>([]);

/** Draws the program as it is and each variation, cut as the program says; answers how to stop and let them go. */
export function drawFamily(files: ModelFiles, family: FamilySource): () => void {
  const controller = new AbortController();
  const made: string[] = [];
  familyPictures.value = [];
  void draw(files, picturesOf(files, family), controller.signal, made);
  return () => {
    controller.abort();
    for (const url of made) URL.revokeObjectURL(url);
  };
}

async function draw(
  files: ModelFiles,
  pictures: readonly CadPicture[],
  abort: AbortSignal,
  made: string[],
): Promise<void> {
  const [{ ThumbnailPainter }, glbs] = await Promise.all([import('../scene/thumbnail'), asCut(files, pictures, abort)]);
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

/** Pictures with their parts cut; where nothing can cut them, which the page says of the model, whole. */
export async function asCut(
  files: ModelFiles,
  pictures: readonly CadPicture[],
  signal: AbortSignal,
): Promise<readonly Uint8Array[]> {
  try {
    return await cutPictures(files, pictures, { signal, onProgress: () => {} });
  } catch {
    return pictures.map(({ glb }) => glb);
  }
}
