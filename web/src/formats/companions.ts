// Files that a model names, among those that were opened with it. Nothing is ever fetched.
import { fileName, type Texture } from './model';

const folderOf = (path: string) => path.slice(0, path.lastIndexOf('/') + 1);

export class Companions {
  readonly #files = new Map<string, Uint8Array>();
  readonly #byName = new Map<string, Uint8Array>();
  readonly #folder: string;

  /** @param path of the model among the files */
  constructor(path: string, files: ReadonlyMap<string, Uint8Array>) {
    this.#folder = folderOf(path).toLowerCase();
    for (const [other, bytes] of files) {
      this.#files.set(other.toLowerCase(), bytes);
      this.#byName.set(fileName(other).toLowerCase(), bytes);
    }
  }

  /** By the path that a file gives, relative to itself, absolute on another machine, or an address: then by name alone. */
  find(reference: string): Uint8Array | undefined {
    const path = reference
      .replace(/^"(.*)"$/, '$1')
      .replaceAll('\\', '/')
      .replace(/^(?:\.\/)+/, '')
      .toLowerCase();
    return (
      this.#files.get(this.#folder + path) ??
      this.#files.get(path) ??
      this.#byName.get(fileName(path)) ??
      this.#byName.get(fileName(unescaped(path)))
    );
  }

  /** Those of a kind, in the order of their paths. */
  withExtension(extension: string): readonly Uint8Array[] {
    const found = [...this.#files].filter(([path]) => path.endsWith(`.${extension}`));
    return found.sort(([a], [b]) => (a < b ? -1 : 1)).map(([, bytes]) => bytes);
  }
}

function unescaped(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** The bytes as they are when a glTF may hold them, by their signature; null for other kinds of pictures. */
export function textureOf(bytes: Uint8Array): Texture | null {
  const [a, b, c, d] = bytes;
  if (a === 0x89 && b === 0x50 && c === 0x4e && d === 0x47) return { bytes, type: 'image/png' };
  return a === 0xff && b === 0xd8 && c === 0xff ? { bytes, type: 'image/jpeg' } : null;
}
