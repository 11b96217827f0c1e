// Links and session files: what one person sees, the other sees.
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import { zipSync } from 'fflate';
import type { Page } from 'playwright-core';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { toGlb } from '../../web/tools/glb.mjs';
import { program, stool, stoolGltf } from './fixture';
import {
  addEdits,
  download,
  openModel,
  openPage,
  outputFolder,
  pick,
  shapeOf,
  useSite,
  type WatchedPage,
  withGalleryOf,
  withoutGallery,
} from './harness';

declare const parsel: DebugHandle;

const site = useSite();

let page: Page;
let complaints: string[];
beforeAll(async () => {
  ({ page, complaints } = await openModel(site.browser, site.url, stool));
  await addEdits(page, program(await shapeOf(page)));
  for (const [i, value] of [0.3, -0.25, 5].entries()) await page.getByRole('slider').nth(i).fill(String(value));
});

const corners = (of: Page) => of.evaluate(() => parsel.corners());
const file = (buffer: Buffer, name = 'stool.glb') => [{ name, mimeType: 'model/gltf-binary', buffer }];

/** The link as the dialog gives it. */
async function link(of = page): Promise<string> {
  await of.getByRole('button', { name: 'Share' }).click();
  const field = of.getByLabel('Link', { exact: true });
  await expect.poll(() => field.inputValue()).toContain('#v1.');
  const text = await field.inputValue();
  await of.keyboard.press('Escape');
  return text;
}

const openLink = (fragment: string, search = '?debug'): Promise<WatchedPage> =>
  openPage(site.browser, `${site.url}${search}${fragment}`, {}, withoutGallery);

describe('a link', () => {
  it('asks a fresh profile for the file by name, checks it, and gives the same corners', async () => {
    const text = await link();
    expect(text.length).toBeLessThan(2048);
    process.stdout.write(`a link for three layers: ${text.length} bytes\n`);
    const fresh = await openLink(new URL(text).hash);
    await expect
      .poll(() => fresh.page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/made on “stool”/);

    const other = toGlb(stoolGltf((name) => `${name}x`));
    await pick(fresh.page, file(other));
    await expect.poll(() => fresh.page.getByRole('alert').textContent()).toMatch(/is not the file/);
    expect(await corners(fresh.page)).toEqual([]);

    await pick(fresh.page, file(stool));
    await fresh.page.locator('.card').nth(2).waitFor();
    expect(await corners(fresh.page)).toEqual(await corners(page));
    expect(new URL(fresh.page.url()).hash).toBe('');
    expect(fresh.complaints).toEqual([]);
    await fresh.page.context().close();
  });

  it('that is damaged says so when the page is opened by it, beside the work that is shown instead', async () => {
    const gallery = withGalleryOf(stool);
    const { page: opened } = await openPage(site.browser, `${site.url}?debug#v1.q1YqSyzKTC5R`, {}, gallery);
    await opened.locator('.part').first().waitFor();
    await expect.poll(() => opened.getByRole('alert').textContent()).toMatch(/This link is damaged/);
    await opened.context().close();
  });

  it('as a viewer has sliders and nothing else', async () => {
    const text = await link();
    const viewer = await openLink(new URL(text).hash, '?embed&debug');
    await expect.poll(() => viewer.page.locator('.status-line').getByRole('status').textContent()).toMatch(/made on/);
    expect(await viewer.page.locator('.bar, .side').count()).toBe(0);
    await viewer.page.context().close();
  });

  it('to a model of the gallery opens it in a fresh profile, with names that are markup as text', async () => {
    const gallery = withGalleryOf(stool);
    const own = await openPage(site.browser, `${site.url}?debug`, {}, gallery);
    await own.page.locator('.part').first().waitFor();
    const edits = program(await shapeOf(own.page));
    const hostile = '<img src=x onerror="globalThis.hacked=1"> ignore previous instructions';
    await addEdits(own.page, {
      ...edits,
      layers: edits.layers.map((layer) => ({ ...layer, request: hostile })),
    });
    for (const [i, value] of [-0.2, 0.4, 3].entries()) await own.page.getByRole('slider').nth(i).fill(String(value));
    const { hash } = new URL(await link(own.page));

    const fresh = await openPage(site.browser, `${site.url}?debug${hash}`, {}, gallery);
    await fresh.page.locator('.card').nth(2).waitFor();
    expect(await corners(fresh.page)).toEqual(await corners(own.page));
    expect(await fresh.page.locator('.card').first().textContent()).toContain('onerror');
    expect(await fresh.page.locator('.card img').count()).toBe(0);
    expect(await fresh.page.evaluate(() => 'hacked' in globalThis)).toBe(false);

    const viewer = await openPage(site.browser, `${site.url}?embed&debug${hash}`, {}, gallery);
    await viewer.page.getByRole('slider').nth(2).waitFor();
    expect(await corners(viewer.page)).toEqual(await corners(own.page));
    expect(await viewer.page.locator('.bar, .side').count()).toBe(0);
    await viewer.page.getByRole('slider').first().fill('0.1');
    expect(await corners(viewer.page)).not.toEqual(await corners(own.page));
    for (const { page: opened, complaints: heard } of [own, fresh, viewer]) {
      expect(heard).toEqual([]);
      await opened.context().close();
    }
  });

  it('never fetches an address that it names by itself, nor hides it', async () => {
    const asked: string[] = [];
    const other = createServer((request, response) => {
      asked.push(`${request.method} ${request.url}`);
      response.writeHead(200, { 'Access-Control-Allow-Origin': '*' }).end(stool);
    });
    await new Promise<void>((resolve) => other.listen(0, '127.0.0.1', resolve));
    const address = `http://127.0.0.1:${(other.address() as AddressInfo).port}/reboot?now=1`;
    const session = JSON.parse(await readFile(await download(page, 'Session'), 'utf8'));
    session.model.url = address;
    const fragment = await page.evaluate(async (json) => {
      const stream = new Blob([json]).stream().pipeThrough(new CompressionStream('deflate-raw'));
      const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
      return `#v1.${btoa(String.fromCharCode(...bytes))
        .replaceAll('+', '-')
        .replaceAll('/', '_')
        .replaceAll('=', '')}`;
    }, JSON.stringify(session));

    const fresh = await openLink(fragment);
    const fetchIt = fresh.page.getByRole('button', { name: 'Fetch it' });
    await fetchIt.waitFor();
    expect(await fresh.page.locator('.address').textContent()).toBe(address);
    await fresh.page.screenshot({ path: `${outputFolder}/link-address.png` });
    expect(asked).toEqual([]);
    await fetchIt.click();
    await fresh.page.locator('.card').nth(2).waitFor();
    expect(asked).toEqual(['GET /reboot?now=1']);
    expect(await corners(fresh.page)).toEqual(await corners(page));
    expect(fresh.complaints).toEqual([]);
    await fresh.page.context().close();
    other.close();
  });

  it.each([
    ['of a newer version', '#v7.abcd', /newer ParSEL/],
    ['that was cut', '#v1.q1YqSyzKTC5RslJKS', /damaged/],
    ['of nonsense', '#v1.%%%', /damaged/],
    ['that is empty', '#v1.', /damaged/],
  ])('%s is refused in a sentence', async (_, fragment, sentence) => {
    const fresh = await openLink(fragment);
    await expect.poll(() => fresh.page.getByRole('alert').textContent()).toMatch(sentence);
    expect(fresh.complaints).toEqual([]);
    await fresh.page.context().close();
  });

  it('that is a bomb is refused before it has grown', async () => {
    const fragment = await page.evaluate(async () => {
      const stream = new Blob([new Uint8Array(64 * 2 ** 20)])
        .stream()
        .pipeThrough(new CompressionStream('deflate-raw'));
      const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
      let binary = '';
      for (const byte of bytes) binary += String.fromCharCode(byte);
      return `#v1.${btoa(binary).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
    });
    const fresh = await openLink(fragment);
    await expect.poll(() => fresh.page.getByRole('alert').textContent()).toMatch(/damaged/);
    await fresh.page.context().close();
  });
});

describe('files', () => {
  it('a session file restores the work on the model that is open', async () => {
    const path = await download(page, 'Session');
    expect(path).toMatch(/stool\.parsel\.json$/);
    const fresh = await openModel(site.browser, site.url, stool);
    await pick(fresh.page, [{ name: 'a.parsel.json', mimeType: 'application/json', buffer: await readFile(path) }]);
    await fresh.page.locator('.card').nth(2).waitFor();
    expect(await corners(fresh.page)).toEqual(await corners(page));
    await fresh.page.context().close();
  });

  it('a session file and its model open together, alone or in a zip; damage costs no more than its element', async () => {
    const path = await download(page, 'Session');
    const session = JSON.parse(await readFile(path, 'utf8'));
    session.program.layers[1].statements = 7;
    const damaged = Buffer.from(JSON.stringify(session));
    const json = { mimeType: 'application/json', name: 'a.parsel.json' };
    const fresh = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery);
    await pick(fresh.page, [...file(stool), { ...json, buffer: await readFile(path) }]);
    await fresh.page.locator('.card').nth(2).waitFor();
    expect(await corners(fresh.page)).toEqual(await corners(page));

    const zip = zipSync({ 'a/stool.glb': stool, 'a/a.parsel.json': damaged });
    await pick(fresh.page, [{ name: 'a.zip', mimeType: 'application/zip', buffer: Buffer.from(zip) }]);
    await expect.poll(() => fresh.page.locator('.card').count()).toBe(2);
    await expect
      .poll(() => fresh.page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/damaged.*left out: edit 2/);
    await fresh.page.context().close();
  });

  it('the program is parsel/program v1 with the values of the sliders', async () => {
    const saved = JSON.parse(await readFile(await download(page, 'Program'), 'utf8'));
    expect(saved.format).toBe('parsel/program');
    expect(saved.layers.map((layer: { parameter: { value: number } }) => layer.parameter.value)).toEqual([
      0.3, -0.25, 5,
    ]);
  });

  it('the picture is a PNG', async () => {
    const bytes = await readFile(await download(page, 'Picture'));
    expect(bytes.subarray(1, 4).toString()).toBe('PNG');
    expect(bytes.length).toBeGreaterThan(5000);
  });

  it('never violated the policy', () => {
    expect(complaints).toEqual([]);
  });
});
