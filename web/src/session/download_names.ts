// Names of the files that are written. A model never gets the name of the file that it was made from, so that saving it
// beside that file does not overwrite it.

/** A file name without its extension from a model's name: no path, no control characters. */
export function plainName(name: string): string {
  return name.replace(/[^\p{L}\p{M}\p{N} _.-]/gu, '').trim() || 'model';
}

const edited = /^(.+)-edited(?:-(\d{1,6}))?$/u;

/** "chair" → "chair-edited" → "chair-edited-2" → …: what came out of this page once may be opened and edited again. */
export function editedName(name: string): string {
  const plain = plainName(name);
  const before = edited.exec(plain);
  return before === null ? `${plain}-edited` : `${before[1]}-edited-${Number(before[2] ?? 1) + 1}`;
}
