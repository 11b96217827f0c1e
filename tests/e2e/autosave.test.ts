// What the browser keeps: a reload right after a change, two tabs with work of their own, a duplicated tab, a new one.
import type { BrowserContext, Page } from 'playwright-core';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { program, stool } from './fixture';
import { addEdits, openModel, outputFolder, pick, saved, shapeOf, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let context: BrowserContext;
let complaints: string[];
beforeEach(async () => {
  ({ page, complaints } = await openModel(site.browser, site.url, stool));
  context = page.context();
});
afterEach(async () => {
  await context.close();
  expect(complaints).toEqual([]);
});

const values = (of: Page) => of.evaluate(() => parsel.document().layers.map(({ value }) => value));
const name = (of: Page) => of.evaluate(() => parsel.document().model?.files.name);

const addThree = async (to: Page) => addEdits(to, program(await shapeOf(to)));

/** Another tab of the same browser. */
async function newTab(address = page.url()): Promise<Page> {
  const tab = await context.newPage();
  await tab.goto(address);
  return tab;
}

const openSecond = async (tab: Page) => {
  await pick(tab, [{ name: 'second.glb', mimeType: 'model/gltf-binary', buffer: stool }]);
  await expect.poll(() => name(tab)).toBe('second');
};

describe('the work of a tab', () => {
  it('is there after a reload that leaves no time to save', async () => {
    await addThree(page);
    await saved(page);
    await page.getByRole('slider').first().fill('0.31');
    await page.reload();
    await page.locator('.card').nth(2).waitFor();
    expect((await values(page))[0]).toBeCloseTo(0.31);
  });

  it('is its own: two tabs do not write over each other', async () => {
    await addThree(page);
    const other = await newTab();
    await openSecond(other);
    await page.getByRole('slider').first().fill('0.2');
    await Promise.all([saved(page), saved(other)]);
    await Promise.all([page.reload(), other.reload()]);
    await page.locator('.card').nth(2).waitFor();
    expect((await values(page))[0]).toBeCloseTo(0.2);
    expect(await name(page)).toBe('stool');
    await expect.poll(() => name(other)).toBe('second');
    expect(await values(other)).toEqual([]);
  });

  it('is where a new tab begins, and goes on by itself from there', async () => {
    await addThree(page);
    await saved(page);
    const other = await newTab();
    await other.locator('.card').nth(2).waitFor();
    await other.getByRole('slider').first().fill('0.11');
    await saved(other);
    await page.reload();
    await page.locator('.card').nth(2).waitFor();
    expect((await values(page))[0]).toBe(0);
  });

  it('stays with the first when a tab is duplicated', async () => {
    await addThree(page);
    await saved(page);
    // A duplicate begins with the other's session storage, the name of its record included.
    const kept = await page.evaluate(() => ({ ...sessionStorage }));
    const duplicate = await context.newPage();
    await duplicate.addInitScript((items) => {
      if (sessionStorage.length === 0)
        for (const [key, value] of Object.entries(items)) sessionStorage.setItem(key, value);
    }, kept);
    await duplicate.goto(page.url());
    await duplicate.locator('.card').nth(2).waitFor();
    await openSecond(duplicate);
    await saved(duplicate);
    await page.reload();
    await page.locator('.card').nth(2).waitFor();
    expect(await name(page)).toBe('stool');
  });
});

describe('seven tabs', () => {
  const names = Array.from({ length: 7 }, (_, i) => `model-${i}`);

  /** One with each model. The first is the page of the test. */
  async function open(): Promise<Page[]> {
    const tabs: Page[] = [];
    for (const [i, own] of names.entries()) {
      const tab = i === 0 ? page : await newTab();
      await pick(tab, [{ name: `${own}.glb`, mimeType: 'model/gltf-binary', buffer: stool }]);
      await expect.poll(() => name(tab)).toBe(own);
      await saved(tab);
      tabs.push(tab);
    }
    return tabs;
  }

  it('that are reloaded at once each keep their own work', async () => {
    const tabs = await open();
    await Promise.all(tabs.map((tab) => tab.reload()));
    for (const [i, tab] of tabs.entries()) await expect.poll(() => name(tab)).toBe(names[i]);
  });

  it('that a browser restores one by one, as they are looked at, each find their own work', async () => {
    const tabs = await open();
    const kept = await Promise.all(tabs.map((tab) => tab.evaluate(() => ({ ...sessionStorage }))));
    const address = page.url();
    for (const tab of tabs) await tab.close();
    for (const [i, items] of kept.entries()) {
      const tab = await context.newPage();
      await tab.addInitScript((stored) => {
        if (sessionStorage.length === 0)
          for (const [key, value] of Object.entries(stored)) sessionStorage.setItem(key, value);
      }, items);
      await tab.goto(address);
      await expect.poll(() => name(tab)).toBe(names[i]);
      await saved(tab);
    }
  });
});

describe('a browser that keeps nothing', () => {
  it.each([
    ['has no room', 'QuotaExceededError', /no room left/],
    ['refuses', 'InvalidStateError', /does not keep your work/],
  ])('%s: it is said at once, the page works on, and offers the file', async (_, fault, sentence) => {
    await page.evaluate((kind) => {
      IDBObjectStore.prototype.put = () => {
        throw new DOMException('', kind);
      };
    }, fault);
    await addThree(page);
    await expect.poll(() => page.getByRole('alert').textContent()).toMatch(sentence);
    await page.screenshot({ path: `${outputFolder}/unkept.png` });
    await page.getByRole('slider').first().fill('0.2');
    const [file] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('button', { name: 'Save it as a file' }).click(),
    ]);
    expect(file.suggestedFilename()).toBe('stool.parsel.json');
    await page.getByRole('alert').getByRole('button', { name: 'Dismiss' }).click();
    expect(await page.evaluate(() => parsel.flushed())).toBe(false);
    expect(await page.getByRole('alert').textContent()).toBe('');
  });
});
