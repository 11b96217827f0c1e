// The service worker: the page without a network, and the arrival of a newer version.
import { cp, mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import type { Server } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { Program } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { compress } from '../web/compressed';
import { program, stool } from './fixture';
import { addEdits, dist, openModel, openPage, pick, saved, serve, shapeOf, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

const kept = (page: Page) => page.evaluate(async () => (await navigator.serviceWorker.ready).active?.state);
const corners = (page: Page) => page.evaluate(() => parsel.corners());
const model = (buffer: Buffer) => [{ name: 'stool.glb', mimeType: 'model/gltf-binary', buffer }];

function stop(server: Server): void {
  server.close();
  server.closeAllConnections();
}

describe('without a network', () => {
  it('the page opens again, with its gallery, its core, its decoders and what reads CAD programs', async () => {
    const { url, server } = await serve();
    const { page, complaints } = await openPage(site.browser, `${url}?debug`, { serviceWorkers: 'allow' });
    await page.locator('.card').first().waitFor(); // the first model of the gallery, with its edit
    await expect.poll(() => kept(page)).toBe('activated');
    stop(server);
    await page.context().setOffline(true);

    await page.reload();
    await page.locator('.card').first().waitFor();
    await page.getByRole('slider').first().fill('0.1');
    await page.locator('.bar .model').click();
    await page.locator('.gallery button').nth(1).click();
    await expect.poll(() => page.evaluate(() => parsel.document().layers.length)).toBe(0);
    await pick(page, model(await compress(stool, 'Draco')));
    await expect.poll(() => page.evaluate(() => parsel.document().model?.files.name)).toBe('stool');
    const scad = { name: 'block.scad', mimeType: 'text/plain', buffer: Buffer.from('// block\ncube([3, 4, 5]);\n') };
    await pick(page, [scad]);
    await expect.poll(() => page.evaluate(() => parsel.document().model?.shape.name)).toBe('block');
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('a newer version', () => {
  /** A build that differs: the page says which it is. */
  async function rebuild(folder: string): Promise<void> {
    const change = async (name: string, edit: (text: string) => string) => {
      const before = await readFile(join(folder, name), 'utf8');
      const after = edit(before);
      if (after === before) throw new Error(`${name} was to change`);
      await writeFile(join(folder, name), after);
    };
    await change('index.html', (text) => text.replace('<head>', '<head><meta name="build" content="newer">'));
    await change('sw.js', (text) =>
      text.replace(/(\{url:"index\.html",revision:")\w+|(\{"?revision"?:")\w+(?=",url:"index\.html")/, '$1$2newer'),
    );
  }
  const isNewer = (page: Page) => page.locator('meta[name=build]').count();
  const notice = (page: Page) =>
    expect.poll(() => page.locator('.status-line').getByRole('status').textContent()).toMatch(/new version is ready/);

  it('is announced in every page, and comes with the work as it is, only where it is asked for', async () => {
    const folder = await mkdtemp(join(tmpdir(), 'parsel-build-'));
    await cp(dist, folder, { recursive: true });
    const { url, server } = await serve(folder);
    const { page: one, complaints } = await openModel(site.browser, url, stool, { serviceWorkers: 'allow' });
    await expect.poll(() => kept(one)).toBe('activated');
    const edits: Program = program(await shapeOf(one));
    await addEdits(one, edits);
    await one.getByRole('slider').first().fill('0.31');
    await saved(one);
    const two = await one.context().newPage();
    await two.goto(`${url}?debug`);
    await two.locator('.card').nth(2).waitFor();
    await two.getByRole('slider').first().fill('-0.2');
    const [before, other] = [await corners(one), await corners(two)];

    await rebuild(folder);
    await one.evaluate(async () => (await navigator.serviceWorker.getRegistration())?.update());
    await notice(one);
    await notice(two);
    expect(await isNewer(one)).toBe(0);

    for (const [page, state] of [
      [one, before],
      [two, other],
    ] as const) {
      expect(await corners(page)).toEqual(state); // nobody else's reload touched it
      await page.getByRole('button', { name: 'Reload' }).click();
      await expect.poll(() => isNewer(page)).toBe(1);
      await page.locator('.card').nth(2).waitFor();
      expect(await corners(page)).toEqual(state);
      await expect
        .poll(() => page.locator('.status-line').getByRole('status').textContent())
        .not.toMatch(/new version/);
    }
    expect(complaints).toEqual([]);
    await one.context().close();
    stop(server);
    await rm(folder, { recursive: true });
  });
});
