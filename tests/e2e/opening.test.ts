// Before and after a model is opened: the first screen, the drop zone, what was found, hosts of models.
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { toGlb } from '../../web/tools/glb.mjs';
import { serious } from './axe';
import { stool, stoolGltf } from './fixture';
import { openModel, openPage, outputFolder, pick, useSite, withoutGallery } from './harness';
import { wall } from './wall';

declare const parsel: DebugHandle;

const site = useSite();

/** The stool with its seat held up in the air. */
function withLooseSeat(): Buffer {
  const gltf = stoolGltf();
  const [seat] = gltf.json['nodes'] as { translation?: number[] }[];
  if (seat) seat.translation = [0, 2, 0];
  return toGlb(gltf);
}

describe.each([
  ['light', { width: 1440, height: 900 }],
  ['dark', { width: 390, height: 844 }],
] as const)('the first screen, %s', (colorScheme, viewport) => {
  it('says what a good model is and opens one', async () => {
    const { page, complaints } = await openPage(site.browser, site.url, { colorScheme, viewport }, withoutGallery);
    const first = page.getByRole('region', { name: 'Begin' });
    await first.waitFor();
    expect(await first.textContent()).toMatch(/separate parts.*touch.*names/);
    expect(await serious(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/first-${colorScheme}-${viewport.width}.png` });
    await first.getByRole('button', { name: 'Open a model' }).click();
    await page.locator('.drop-zone').waitFor();
    await page.screenshot({ path: `${outputFolder}/drop-zone-${colorScheme}-${viewport.width}.png` });
    await page
      .getByLabel('Open files')
      .setInputFiles([{ name: 'stool.glb', mimeType: 'model/gltf-binary', buffer: stool }]);
    await first.waitFor({ state: 'detached' });
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('a model after one of more parts', () => {
  it('is in sight', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, wall(4, 5), {
      name: 'wall.glb',
      viewport: { width: 1100, height: 700 },
    });
    await pick(page, [{ name: 'stool.glb', mimeType: 'model/gltf-binary', buffer: stool }]);
    await page.getByText('10 parts').waitFor();
    await page.waitForFunction(() => parsel.stage()?.isStill());
    const { x, y } = await page.evaluate(() => parsel.stage()?.projectMean([0, 0, 0]) ?? { x: 0, y: 0 });
    expect(x).toBeGreaterThan(256); // between the panels
    expect(x).toBeLessThan(1100 - 352);
    expect(y).toBeGreaterThan(72);
    expect(y).toBeLessThan(700);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('what was found', () => {
  it('is one line, and a click shows what hangs loose', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, withLooseSeat());
    const found = page.locator('.found');
    expect(await found.textContent()).toMatch(/10 parts, .*mirror image.*, 1 row/);
    await found.getByRole('button', { name: /hang loose|hangs loose/ }).click();
    const loose = await page.evaluate(() => [...parsel.selected()]);
    expect(loose.length).toBeGreaterThan(0);
    await page.screenshot({ path: `${outputFolder}/found.png` });
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('a model on a listed host', () => {
  it('is fetched once its address is typed', async () => {
    const { page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, async (context) => {
      await withoutGallery(context);
      await context.route('https://cdn.jsdelivr.net/**', (route) =>
        route.fulfill({ body: stool, headers: { 'Access-Control-Allow-Origin': '*' } }),
      );
    });
    await page.waitForFunction(() => parsel.isReady());
    await page.locator('.bar .model').click();
    await page.getByLabel('Address of a model').fill('https://cdn.jsdelivr.net/gh/some/one@1/stool.glb');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => parsel.stage()?.isShown());
    expect(await page.evaluate(() => parsel.document().model?.source.kind)).toBe('url');
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});
