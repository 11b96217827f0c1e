// Every way in, and what is not a model: named in a sentence, with the work at hand untouched.

import { mkdir, mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { zipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { beforeAll, beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { type Gltf, toGlb } from '../../web/tools/glb.mjs';
import { compress } from '../web/compressed';
import { stool, stoolGltf } from './fixture';
import { drop, openModel, openPage, pick, useSite, withGalleryOf, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

let page: Page;
let complaints: string[];

const file = (name: string, buffer: Buffer) => ({ name, mimeType: 'application/octet-stream', buffer });
const parts = () => page.evaluate(() => parsel.document().model?.shape.parts.length ?? 0);

/** The stool as a .gltf beside its buffer. */
function split({ json, binary }: Gltf, uri: string): { text: Buffer; binary: Buffer } {
  const buffers = [{ byteLength: binary.length, uri }];
  return { text: Buffer.from(JSON.stringify({ ...json, buffers })), binary };
}

describe('opening', () => {
  beforeEach(async () => {
    await page?.context().close();
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    await page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
  });
  const opened = async () => {
    await page.locator('.part').first().waitFor();
    expect(await parts()).toBe(11);
    expect(complaints).toEqual([]);
  };

  it('a .glb by the picker', async () => {
    await pick(page, [file('stool.glb', stool)]);
    await opened();
  });

  it('a .glb by a drop', async () => {
    await drop(page, { 'stool.glb': stool });
    await opened();
  });

  it('a .gltf with its buffer by a drop', async () => {
    const { text, binary } = split(stoolGltf(), 'stool.bin');
    await drop(page, { 'stool.gltf': text, 'stool.bin': binary });
    await opened();
  });

  it('a folder', async () => {
    const { text, binary } = split(stoolGltf(), 'data/stool.bin');
    const folder = await mkdtemp(join(tmpdir(), 'parsel-folder-'));
    await mkdir(join(folder, 'data'));
    await writeFile(join(folder, 'stool.gltf'), text);
    await writeFile(join(folder, 'data', 'stool.bin'), binary);
    await page.locator('.bar .model').click();
    await page.getByLabel('Open a folder').setInputFiles(folder);
    await opened();
    await rm(folder, { recursive: true });
  });

  it('a .gltf with its buffer, whose name is escaped', async () => {
    const { text, binary } = split(stoolGltf(), 'my%20data.bin');
    await pick(page, [file('stool.gltf', text), file('my data.bin', binary)]);
    await opened();
  });

  it('a zip with folders', async () => {
    const { text, binary } = split(stoolGltf(), 'data/stool.bin');
    const zip = zipSync({ 'a/readme.txt': Buffer.from('hello'), 'a/stool.gltf': text, 'a/data/stool.bin': binary });
    await pick(page, [file('stool.zip', Buffer.from(zip))]);
    await opened();
  });

  it('an address on the same site', async () => {
    await page.route('**/models/stool.glb', (route) => route.fulfill({ body: stool }));
    await page.locator('.bar .model').click();
    await page.getByLabel('Address of a model').fill('./models/stool.glb');
    await page.getByRole('button', { name: 'Open', exact: true }).click();
    await opened();
  });

  it('a model of the gallery, with a picture of it', async () => {
    const { page: first } = await openPage(site.browser, `${site.url}?debug`, {}, withGalleryOf(stool));
    await first.locator('.part').first().waitFor(); // the first visit opens the first model by itself
    await first.locator('.bar .model').click();
    await first.getByRole('img', { includeHidden: true }).first().waitFor({ state: 'attached' });
    await first.locator('.thumbnail img').first().waitFor();
    expect(await first.getByRole('button', { name: 'A stool' }).count()).toBe(1);
    await first.context().close();
  });

  it('names with markup as text, of files, nodes, meshes, materials and extras', async () => {
    const hostile = '<img src=x onerror="globalThis.hacked=1">';
    const { json, binary } = stoolGltf(() => hostile);
    const named = (list: unknown) =>
      (list as object[]).map((item) => ({ ...item, name: hostile, extras: { hostile } }));
    const renamed = { ...json, meshes: named(json['meshes']), materials: named(json['materials']) };
    await pick(page, [file('"><script>1</script>.glb', toGlb({ json: renamed, binary }))]);
    await page.locator('.part').first().waitFor();
    expect(await page.locator('.side.left').textContent()).toContain('onerror');
    expect(await page.evaluate(() => 'hacked' in globalThis)).toBe(false);
    expect(await page.locator('.side img, .bar img').count()).toBe(0);
    expect(complaints).toEqual([]);
  });

  it.each(['__proto__', 'constructor', 'ignore previous instructions'])(
    'parts that are all called %s',
    async (name) => {
      await pick(page, [file(`${name}.glb`, toGlb(stoolGltf(() => name)))]);
      await opened();
      const ids = await page.evaluate(() => parsel.document().model?.shape.parts.map(({ id }) => id) ?? []);
      expect(new Set(ids).size).toBe(11);
    },
  );

  it.each(['Draco', 'Meshopt, quantized'] as const)('a .glb that is compressed: %s', async (how) => {
    await pick(page, [file('stool.glb', await compress(stool, how))]);
    await opened();
    await expect
      .poll(() => page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/came compressed with (Draco|Meshopt); what you export will not be/);
  });
});

describe('what cannot be opened', () => {
  beforeAll(async () => {
    await page?.context().close();
    ({ page, complaints } = await openModel(site.browser, site.url, stool));
  });
  const needing = (extension: string) => {
    const gltf = stoolGltf();
    return toGlb({ ...gltf, json: { ...gltf.json, extensionsUsed: [extension], extensionsRequired: [extension] } });
  };
  /** Says of itself that it grows to 600 MiB: the size in the archive's directory, which begins with this signature. */
  const bomb = () => {
    const zip = Buffer.from(zipSync({ 'bomb.glb': Buffer.alloc(1000) }));
    zip.writeUInt32LE(600 * 2 ** 20, zip.indexOf('PK\x01\x02', 0, 'latin1') + 24);
    return zip;
  };

  it.each<[string, string, () => Buffer, RegExp]>([
    ['a file of another kind', 'notes.txt', () => Buffer.from('hello'), /\.txt cannot be opened here\. Open a \.glb/],
    ['nonsense', 'broken.glb', () => Buffer.from('hello'), /broken\.glb is damaged/],
    ['a file that breaks off', 'half.glb', () => stool.subarray(0, stool.length >> 1), /.+\./],
    ['a .gltf without its buffer', 'a.gltf', () => split(stoolGltf(), 'a.bin').text, /a\.gltf also needs a\.bin/],
    ['KTX2 textures', 'k.glb', () => needing('KHR_texture_basisu'), /KHR_texture_basisu: its textures are KTX2/],
    ['a zip without a model', 'z.zip', () => Buffer.from(zipSync({ 'a.txt': Buffer.from('x') })), /Open a \.glb/],
    ['a zip that breaks off', 'z.zip', () => Buffer.from(zipSync({ 'a.glb': stool })).subarray(0, 300), /damaged/],
    ['a zip that is a bomb', 'bomb.zip', bomb, /more than 512 MB/],
    ['a session that is none', 'a.parsel.json', () => Buffer.from('{"format":"x"}'), /no saved ParSEL session/],
    [
      'a session of a newer version',
      'a.parsel.json',
      () => Buffer.from('{"format":"parsel/session","version":9}'),
      /newer ParSEL/,
    ],
  ])('is refused by name: %s', async (_, name, content, sentence) => {
    await pick(page, [file(name, content())]);
    await expect.poll(() => page.getByRole('alert').textContent()).toMatch(sentence);
    expect(await page.evaluate(() => parsel.document().model?.files.name)).toBe('stool');
    expect(await parts()).toBe(11);
    expect(complaints).toEqual([]);
  });

  it('is refused by name: Draco data that is damaged', async () => {
    const compressed = await compress(stool, 'Draco');
    const binary = 28 + compressed.readUInt32LE(12);
    compressed.fill(0x55, binary, binary + 60);
    await pick(page, [file('damaged.glb', compressed)]);
    await expect.poll(() => page.getByRole('alert').textContent()).toMatch(/damaged: its Draco data cannot be read/);
    expect(await page.evaluate(() => parsel.document().model?.files.name)).toBe('stool');
  });

  it('can be cancelled while it is decompressed, with the work at hand untouched', async () => {
    await page.route('**/draco_decoder*.wasm', () => {}); // never answers
    await pick(page, [file('slow.glb', await compress(stool, 'Draco'))]);
    await expect
      .poll(() => page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/Reading the model · decompressing Draco/);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await expect.poll(() => page.locator('.status-line').getByRole('status').textContent()).toBe('');
    expect(await page.evaluate(() => parsel.document().model?.files.name)).toBe('stool');
    expect(complaints).toEqual([]);
  });

  it('says where the page may not fetch from, without trying', async () => {
    await page.locator('.bar .model').click();
    await page.getByLabel('Address of a model').fill('https://example.org/chair.glb');
    await page.getByRole('button', { name: 'Open', exact: true }).click();
    await expect
      .poll(() => page.getByRole('alert').textContent())
      .toMatch(/may not fetch from example\.org.*drop it here/);
    expect(complaints).toEqual([]);
  });
});
