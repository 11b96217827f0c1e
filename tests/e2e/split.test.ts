// A model in one piece: the offer, the parts, how fine, undo, and what is kept.
import type { BrowserContext, Page } from 'playwright-core';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { openModel, outputFolder, saved, useSite } from './harness';
import { tableInOnePiece } from './one_mesh';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let context: BrowserContext;
let complaints: string[];
beforeEach(async () => {
  ({ page, complaints } = await openModel(site.browser, site.url, tableInOnePiece, { name: 'table.glb' }));
  context = page.context();
});
afterEach(async () => {
  await context.close();
  expect(complaints).toEqual([]);
});

const parts = (of: Page = page) =>
  of.evaluate(() => parsel.document().model?.shape.parts.filter(({ virtual }) => !virtual).length);
const offer = (of: Page = page) => of.getByRole('button', { name: 'Split it into parts' });

describe('a model in one piece', () => {
  it('is split where it is offered, finer on request, in one step that undo takes back', async () => {
    expect(await parts()).toBe(1);
    await offer().click();
    await expect.poll(() => parts()).toBe(5);
    await expect.poll(() => offer().count()).toBe(0);

    await page.getByLabel('Split into 5 parts').fill('1');
    await expect.poll(() => parts()).toBe(6);
    await page.keyboard.press('Control+z');
    await expect.poll(() => parts()).toBe(1);
    await expect.poll(() => offer().count()).toBe(1);
    await page.keyboard.press('Control+Shift+z');
    await expect.poll(() => parts()).toBe(6);
  });

  it('is split in the way that is chosen of those that give something, each with what it gives', async () => {
    await page.getByRole('button', { name: 'Split into parts' }).click();
    const ways = page.getByRole('list', { name: 'Ways to split it' }).getByRole('button');
    await expect.poll(() => ways.allTextContents()).toEqual(['By what hangs together5 parts']);
    expect(await serious(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/split-ways.png` });
    await ways.focus();
    await page.keyboard.press('Enter');
    await expect.poll(() => parts()).toBe(5);
    await expect.poll(() => ways.getAttribute('aria-pressed')).toBe('true');
    // Split otherwise fine, other numbers hold: they are looked for again.
    await page.getByLabel('Split into 5 parts').fill('1');
    await expect.poll(() => parts()).toBe(6);
    await page.getByRole('button', { name: 'Split it another way' }).click();
    await expect.poll(() => ways.allTextContents()).toEqual(['By what hangs together6 parts']);
    await page.keyboard.press('Control+z');
    await expect.poll(() => parts()).toBe(1);
  });

  it('stays split after a reload, and so does an edit of its parts', async () => {
    await offer().click();
    await expect.poll(() => parts()).toBe(5);
    const labels = await page.evaluate(() => parsel.document().model?.shape.parts.map(({ label }) => label));
    expect(labels?.filter((label) => label === 'post')).toHaveLength(4);
    expect(labels).toContain('board');
    await saved(page);
    await page.reload();
    await page.waitForFunction(() => parsel.stage()?.isShown());
    expect(await parts()).toBe(5);
    expect(await page.getByLabel('Split into 5 parts').count()).toBe(1);
  });
});
