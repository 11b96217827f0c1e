// Names of the files that are written. A model never gets the name of the file that it was made from, so that saving it
// beside that file does not overwrite it.

/** A file name without its extension from a model's name: no path, no control characters. */
export function plainName(name: string): string {
  return name.replace(/[^\p{L}\p{M}\p{N} _.-]/gu, '').trim() || 'model';
}

const numbered = /^(.+)-([a-z]+)(?:-(\d{1,6}))?$/u;

/**
 * "chair" → "chair-edited" → "chair-edited-2" → …: what came out of this page once may be opened and edited again.
 * @param word what has become of the model
 */
export function editedName(name: string, word: 'edited' | 'sliders' = 'edited'): string {
  const plain = plainName(name);
  const before = numbered.exec(plain);
  return before?.[2] === word ? `${before[1]}-${word}-${Number(before[3] ?? 1) + 1}` : `${plain}-${word}`;
}
