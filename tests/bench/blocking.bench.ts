// How long the page's main thread is blocked while a person works on a model of 1,000 parts: of everything that they do, the
// longest task and all over 50 ms, as the browser counts them (Long Tasks API). Needs web/dist.
//
//   npm --prefix web run bench:page
//
// Prints CSV `benchmark,case,metric,value`; nothing is asserted: a busy machine stretches tasks.
import type { Page } from 'playwright-core';
import { it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { openModel, useSite } from '../e2e/harness';
import { wall } from '../e2e/wall';

declare const parsel: DebugHandle;

const site = useSite();
const print = (name: string, metric: string, value: number) =>
  process.stdout.write(`blocking,${name},${metric},${value.toFixed(0)}\n`);

interface Watched {
  longTasks: number[];
}

/** What was seen since the last call. */
async function longTasks(page: Page): Promise<number[]> {
  await page.waitForTimeout(400); // entries come with a delay
  return page.evaluate(() => (globalThis as unknown as Watched).longTasks.splice(0));
}

it('1,000 parts', async () => {
  const { page } = await openModel(site.browser, site.url, wall(25, 40), {
    name: 'wall.glb',
    viewport: { width: 1000, height: 820 },
  });
  await page.waitForFunction(() => parsel.stage()?.isStill());
  await page.evaluate(() => {
    const seen: number[] = [];
    Object.assign(globalThis, { longTasks: seen });
    new PerformanceObserver((list) => seen.push(...list.getEntries().map(({ duration }) => duration))).observe({
      type: 'longtask',
    });
  });
  const measure = async (name: string, act: () => Promise<unknown>) => {
    await longTasks(page);
    await act();
    const tasks = await longTasks(page);
    print(name, 'longest_ms', Math.max(0, ...tasks));
    print(name, 'over_50_ms', tasks.length);
  };
  const row = (i: number) => page.locator('.part .name').nth(i);
  const { x, y } = await page.evaluate(() => parsel.stage()?.projectMean([0, 0, 0]) ?? { x: 0, y: 0 });
  await measure('select in the list', () => row(2).dispatchEvent('click'));
  await measure('select another', () => row(4).dispatchEvent('click'));
  await measure('hover over the view', async () => {
    for (let i = 0; i < 5; i++) await page.mouse.move(x + 10 * i, y);
  });
  await measure('click in the view', () => page.mouse.click(x, y));
  await measure('turn the view', async () => {
    await page.mouse.move(x, y + 60);
    await page.mouse.down();
    await page.mouse.move(x + 80, y + 60, { steps: 8 });
    await page.mouse.up();
  });
  await measure('search in the list', async () => {
    await page.getByLabel('Find a part').pressSequentially('drawer 77');
  });
  await measure('clear the search', () => page.getByLabel('Find a part').fill(''));
  await measure('select all', async () => {
    await page.mouse.click(8, 8);
    await page.keyboard.press('Control+a');
  });
  await measure('let go of all', () => page.keyboard.press('Escape'));
  await measure('hide one', async () => {
    await row(3).dispatchEvent('click');
    await page.keyboard.press('h');
  });
  await measure('show it', () => page.keyboard.press('Alt+h'));
  await measure('show one alone', async () => {
    await row(3).dispatchEvent('click');
    await page.keyboard.press('i');
  });
  await measure('undo', () => page.keyboard.press('Control+z'));
  await measure('parts apart', async () => {
    await page.keyboard.press('e');
    await page.waitForTimeout(800);
  });
  await measure('parts together', async () => {
    await page.keyboard.press('e');
    await page.waitForTimeout(800);
  });
  await measure('type a request', async () => {
    await page.getByLabel('What to change').pressSequentially('raise drawer');
  });
});
