// Sliders that a fresh model offers by itself: found beside the page's work, tried on the spot, kept or dropped.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import { openModel, outputFolder, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
const panel = (page: Page) => page.getByLabel('Sliders this model offers');
const layers = (page: Page) => page.evaluate(() => parsel.document().layers.map(({ layer }) => layer.request));
const looked = (page: Page) => panel(page).getByText('Looking for').waitFor({ state: 'detached', timeout: 120_000 });

describe('a fresh model of one’s own', () => {
  it.each(['light', 'dark'] as const)('offers sliders, to be tried, kept and dropped (%s)', async (colorScheme) => {
    const { page, complaints } = await openModel(site.browser, site.url, stool, { colorScheme });
    await panel(page).getByText('Width', { exact: true }).waitFor({ timeout: 120_000 });
    // Nothing is added before it is asked for, and the page works meanwhile.
    expect(await layers(page)).toEqual([]);
    await looked(page);
    const wide = () => page.evaluate(() => Math.max(...parsel.corners().filter((_, i) => i % 3 === 0)));
    const before = await wide();
    await page.getByLabel('Try Width').fill('0.2');
    expect(await wide()).toBeGreaterThan(before);
    expect(await layers(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/offers-${colorScheme}.png` });
    expect(await serious(page)).toEqual([]);
    await page.getByRole('button', { name: 'Keep Width' }).click();
    expect(await layers(page)).toEqual(['Width']);
    const kept = await page.evaluate(() => parsel.document().layers[0]);
    expect(kept?.value).toBeCloseTo(0.2);
    expect(kept?.layer.relations.every(({ status }) => status !== 'broken')).toBe(true);
    expect(await panel(page).getByText('Width', { exact: true }).count()).toBe(0);
    const rest = await panel(page).getByRole('button', { name: /^Drop/ }).count();
    await panel(page).getByRole('button', { name: /^Drop/ }).first().click();
    expect(await panel(page).getByRole('button', { name: /^Drop/ }).count()).toBe(rest - 1);
    await page.getByRole('button', { name: 'Undo: Width' }).click();
    expect(await layers(page)).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('is offered them on a phone', async () => {
    const { page } = await openModel(site.browser, site.url, stool, { viewport: { width: 390, height: 844 } });
    await panel(page).getByText('Width', { exact: true }).waitFor({ timeout: 120_000 });
    await looked(page);
    await page.screenshot({ path: `${outputFolder}/offers-phone.png` });
    expect(await serious(page)).toEqual([]);
    await page.context().close();
  });
});

describe('a length that is typed', () => {
  it('makes the fitting slider, then moves it, and stretches its range', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    const width = page.getByLabel('width, type a length', { exact: true });
    await width.fill('60');
    await width.press('Enter');
    await page.locator('.card').waitFor();
    expect(await layers(page)).toEqual(['Width']);
    await expect.poll(() => width.inputValue()).toBe('60');
    await width.fill('0.55 m');
    await width.press('Enter');
    await expect.poll(() => width.inputValue()).toBe('55');
    const most = await page.evaluate(() => parsel.document().layers[0]?.layer.parameter.max ?? 0);
    await width.fill('115');
    await width.press('Enter');
    await expect.poll(() => width.inputValue()).toBe('115');
    expect(await layers(page)).toEqual(['Width']);
    expect(await page.evaluate(() => parsel.document().layers[0]?.layer.parameter.max ?? 0)).toBeGreaterThan(most);
    await page.getByLabel('Unit of lengths').selectOption('in');
    expect(await width.inputValue()).toBe('45.28');
    await page.getByRole('button', { name: 'Undo: lengths in in' }).click();
    expect(await width.inputValue()).toBe('115');
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});
