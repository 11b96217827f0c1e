// What a language model suggests about CAD programs and about models without names, in the built page, from recordings: kinds
// that become variations, and names for parts.
import type { Page } from 'playwright-core';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { openPage, useSite, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

async function open(button: RegExp, group: RegExp): Promise<{ page: Page; complaints: string[] }> {
  const { page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery);
  await page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
  await page.locator('.bar .model').click();
  await page.getByRole('heading', { name: group }).waitFor();
  await page.getByRole('button', { name: button }).click();
  await page.waitForFunction(() => parsel.stage()?.isShown());
  return { page, complaints };
}

describe('suggested kinds', () => {
  let page: Page;
  let complaints: string[];
  const cards = () => page.getByRole('region', { name: 'Suggested kinds' }).locator('.kind');
  const variations = () => page.getByRole('region', { name: 'Variations' }).getByRole('listitem');
  beforeAll(async () => {
    ({ page, complaints } = await open(/^Bottle$/, /OpenSCAD programs/));
  });

  it('come in as six cards with pictures, without a key', async () => {
    await page.getByRole('button', { name: 'Suggest kinds' }).click();
    await expect.poll(() => cards().count()).toBe(6);
    await expect.poll(() => cards().locator('img').count(), { timeout: 30_000 }).toBe(6);
    await page.getByText('6 drawn · recorded answers').waitFor();
    expect(await cards().first().textContent()).toContain('answers name it');
    await page.getByText('Also named').click();
    await page.getByText('needs a key').waitFor();
    expect(await serious(page)).toEqual([]);
  });

  it('are kept one by one and all together, dropped, and undone', async () => {
    const before = await variations().count();
    const milk = cards().filter({ has: page.getByRole('heading', { name: 'milk bottle' }) });
    await milk.getByRole('button', { name: 'Keep' }).click();
    await expect.poll(() => variations().count()).toBe(before + 1);
    await page.getByRole('button', { name: 'Drop wine bottle' }).click();
    await expect.poll(() => cards().count()).toBe(4);
    await page.getByRole('button', { name: /^Keep all 4/ }).click();
    await expect.poll(() => cards().count()).toBe(0);
    await page.getByRole('button', { name: 'Undo: keep 4 kinds' }).click();
    await expect.poll(() => variations().count()).toBe(before + 1);
    await page.getByRole('button', { name: 'Drop all suggested kinds' }).click();
    expect(await page.getByRole('region', { name: 'Suggested kinds' }).count()).toBe(0);
    expect(complaints).toEqual([]);
  });
});

describe('suggested names', () => {
  it('are a list to correct, and label all parts in one step that is undone', async () => {
    const { page, complaints } = await open(/^Desk with drawers, nameless/, /Models without names/);
    const labels = () =>
      page.evaluate(() =>
        parsel.document().model?.shape.parts.flatMap(({ virtual, label }) => (virtual ? [] : [label])),
      );
    const before = await labels();
    await page.getByRole('button', { name: 'Suggest names for the parts' }).click();
    await page.getByRole('heading', { name: 'Looks like: desk' }).waitFor();
    expect(await serious(page)).toEqual([]);
    const rows = page.getByRole('region', { name: 'Suggested names' }).getByRole('combobox');
    expect(await rows.count()).toBe(12);
    await rows.first().fill('worktop');
    await page.getByRole('button', { name: 'Use these names' }).click();
    await expect.poll(labels).toContain('worktop');
    expect((await labels())?.filter((label) => label === 'drawer')).toHaveLength(3);
    await page.getByRole('button', { name: 'Undo: name the parts' }).click();
    await expect.poll(labels).toEqual(before);
    expect(complaints).toEqual([]);
  });
});
