import { describe, expect, it } from 'vitest';
import { editedName, plainName } from '../../web/src/session/download_names';
import { hasModel, readPicked, sessionOf } from '../../web/src/session/files';

describe('names of what is written', () => {
  it.each([
    ['chair', 'chair-edited'],
    ['chair-edited', 'chair-edited-2'],
    ['chair-edited-9', 'chair-edited-10'],
    ['стул', 'стул-edited'],
    ['कुर्सी', 'कुर्सी-edited'], // vowel signs are marks, no letters
    ['../a:b', '..ab-edited'],
    ['\u0000', 'model-edited'],
  ])('%j becomes %j, never itself', (name, written) => {
    expect(editedName(name)).toBe(written);
    expect(editedName(name)).not.toBe(plainName(name));
  });
});

/** A file of any size of which nothing can be read. */
const sealed = (name: string, size: number) =>
  ({
    name,
    size,
    webkitRelativePath: '',
    arrayBuffer: () => Promise.reject(new Error(`${name} was read`)),
  }) as unknown as File;

describe('files that were picked', () => {
  it.each([
    ['one of 3 GB', [sealed('large.glb', 3 * 2 ** 30)]],
    ['many that are too large together', [1, 2, 3].map((i) => sealed(`${i}.bin`, 200 * 2 ** 20))],
  ])('%s are refused before anything of them is read', async (_, files) => {
    await expect(readPicked(files)).rejects.toThrow('That is more than 512 MB. Open a smaller model.');
  });

  it('may be a session and its model', () => {
    const bytes = new Uint8Array([1]);
    const both = new Map([
      ['work/chair.glb', bytes],
      ['work/chair.parsel.json', new Uint8Array([2])],
    ]);
    expect(sessionOf(both)).toEqual(new Uint8Array([2]));
    expect(hasModel(both)).toBe(true);
    expect(hasModel(new Map([['chair.parsel.json', bytes]]))).toBe(false);
  });
});
