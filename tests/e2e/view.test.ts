// Where one looks: the camera follows a model that grows, and leaves a person's own view alone; the compass; the ground.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { program, stool } from './fixture';
import { addEdits, openModel, outputFolder, shapeOf, useSite } from './harness';
import { wall } from './wall';

declare const parsel: DebugHandle;

const site = useSite();

/** Without motion: the camera is there at once, however slowly this machine draws. */
async function widened(): Promise<Page> {
  const { page } = await openModel(site.browser, site.url, stool, { reducedMotion: 'reduce' });
  const edits = program(await shapeOf(page));
  const [widen] = edits.layers;
  const wide = { ...widen, parameter: { name: 'x1', min: -0.5, max: 4, value: 0 } } as (typeof edits.layers)[number];
  await addEdits(page, { ...edits, layers: [wide] });
  return page;
}

const pose = (page: Page) => page.evaluate(() => parsel.stage()?.rig.pose ?? []);
const still = (page: Page) => page.waitForFunction(() => parsel.stage()?.isStill());

/** How far the seat's corners reach to both sides on screen, CSS pixels. */
const reach = (page: Page) =>
  page.evaluate(() => {
    const on = parsel.stage();
    const x = Array.from({ length: 8 }, (_, k) => on?.projectMean(on.corners.slice(3 * k, 3 * k + 3)).x ?? 0);
    return [Math.min(...x), Math.max(...x)] as const;
  });

/** How far down the model reaches on screen, and from where on it would be covered there; CSS pixels in the window. */
const lowest = (page: Page) =>
  page.evaluate(() => {
    const on = parsel.stage();
    const all = Array.from(
      { length: (on?.corners.length ?? 0) / 3 },
      (_, i) => on?.corners.slice(3 * i, 3 * i + 3) ?? [],
    );
    return Math.max(...all.map((corner) => on?.projectMean(corner).y ?? 0));
  });
const coveredFrom = (page: Page) =>
  page.evaluate(() =>
    Math.min(...['.centre', '.composer'].map((what) => document.querySelector(what)?.getBoundingClientRect().top ?? 0)),
  );

describe('the camera', () => {
  it('keeps a model in the free part of the window as it grows, and comes back with it', async () => {
    const page = await widened();
    await still(page);
    const before = await pose(page);
    await page.getByRole('slider').first().fill('4');
    await expect.poll(async () => (await pose(page))[2] ?? 0).toBeGreaterThan((before[2] ?? 0) * 1.5);
    await still(page);
    const [left, right] = await reach(page);
    expect(left).toBeGreaterThan(256); // the parts panel
    expect(right).toBeLessThan(1440 - 352);
    await page.screenshot({ path: `${outputFolder}/grown.png` });
    await page.getByRole('slider').first().fill('0');
    await expect.poll(async () => Math.abs(((await pose(page))[2] ?? 0) - (before[2] ?? 0))).toBeLessThan(0.02);
    await page.context().close();
  });

  it('stays where a person has moved it', async () => {
    const page = await widened();
    await page.locator('canvas').focus();
    await page.keyboard.press('+');
    await page.keyboard.press('+');
    await still(page);
    const own = await pose(page);
    await page.getByRole('slider').first().fill('4');
    await still(page);
    expect(await pose(page)).toEqual(own);
    await page.context().close();
  });

  it.each([
    ['a window', { width: 1440, height: 900 }],
    ['a phone', { width: 390, height: 844 }],
  ])('in %s, stands above a composer that grows, and comes back when it shrinks', async (name, viewport) => {
    const { page, complaints } = await openModel(site.browser, site.url, stool, { reducedMotion: 'reduce', viewport });
    await still(page);
    const before = await pose(page);
    const stood = await lowest(page);
    expect(stood).toBeLessThan(await coveredFrom(page));
    const field = page.getByLabel('What to change');
    const shrunk = (await field.boundingBox())?.height ?? 0;
    await field.fill(Array.from({ length: 40 }, (_, i) => `make leg ${i} longer`).join(', '));
    await expect.poll(async () => (await field.boundingBox())?.height ?? 0).toBeGreaterThan(shrunk + 60);
    await expect.poll(() => lowest(page)).toBeLessThan(await coveredFrom(page));
    if (name === 'a window') expect(stood).toBeGreaterThan(await coveredFrom(page)); // as it stood, it would be hidden
    await page.screenshot({ path: `${outputFolder}/composer-tall-${viewport.width}.png` });
    await field.fill('');
    await expect.poll(() => pose(page)).toEqual(before);
    expect(await lowest(page)).toBeCloseTo(stood, 0);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('looks from the side that the compass names; left is the object’s own', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool, { colorScheme: 'dark' });
    await page.getByRole('button', { name: 'Look from its left' }).click();
    await expect.poll(async () => (await pose(page)).slice(0, 2)).toEqual([1.571, 1.571]);
    await page.getByRole('button', { name: 'Look from its back' }).click();
    await expect.poll(async () => Math.abs((await pose(page))[0] ?? 0)).toBeCloseTo(Math.PI, 2);
    await page.screenshot({ path: `${outputFolder}/compass-dark.png` });
    expect(await serious(page)).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('the ground', () => {
  it('is darker below a white model', async () => {
    const { page } = await openModel(site.browser, site.url, wall(2, 3), { name: 'wall.glb' });
    await page.locator('.stage.pale').waitFor();
    const ground = () => page.locator('.stage').evaluate((stage) => getComputedStyle(stage).backgroundImage);
    const below = await ground();
    await page.locator('.stage').evaluate((stage) => stage.classList.remove('pale'));
    expect(await ground()).not.toBe(below);
    await page.context().close();
  });
});
