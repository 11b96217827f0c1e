// For everybody: axe finds nothing serious in either theme and on a phone, and the keyboard reaches everything.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { program, stool } from './fixture';
import { addEdits, openModel, outputFolder, shapeOf, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

/** With a broken, a disabled and a sampled relation, so that all their colours are on the page. */
async function prepared(options: Parameters<typeof openModel>[3]): Promise<{ page: Page; complaints: string[] }> {
  const watched = await openModel(site.browser, site.url, stool, options);
  const shape = await shapeOf(watched.page);
  const edits = program(shape);
  const [first, ...rest] = edits.layers;
  if (first === undefined) throw new Error('the program has no layer');
  const relations = shape.relations.map(({ id }, i) => ({
    id,
    status: (['broken', 'disabled'] as const)[i] ?? ('held' as const),
    worst: 0.01,
    proof: 'sampled' as const,
  }));
  await addEdits(watched.page, {
    ...edits,
    layers: [{ ...first, relations }, ...rest],
  });
  return watched;
}

describe.each([
  ['light', { width: 1440, height: 900 }],
  ['dark', { width: 1440, height: 900 }],
  ['light', { width: 390, height: 844 }],
] as const)('in the %s, %o', (colorScheme, viewport) => {
  it('axe finds nothing serious in any state', async () => {
    const { page, complaints } = await prepared({ colorScheme, viewport });
    const states: [string, () => Promise<unknown>][] = [
      ['main', async () => page.locator('summary').first().click()],
      ['hand', async () => page.getByRole('button', { name: 'Edit by hand' }).click()],
      ['selected', async () => page.evaluate(() => parsel.select('seat'))],
      [
        'apart',
        async () => {
          await page.locator('canvas').focus();
          await page.keyboard.press('e');
        },
      ],
      [
        'tour',
        async () => {
          await page.getByRole('button', { name: 'View and help' }).click();
          await page.getByRole('menuitem', { name: 'Tour' }).click();
        },
      ],
      ['export', async () => page.getByRole('button', { name: 'Export' }).click()],
      ['open', async () => page.locator('.bar .model').click()],
      ['share', async () => page.getByRole('button', { name: 'Share' }).click()],
      [
        'text',
        async () => {
          await page.getByRole('button', { name: 'More about' }).first().click();
          await page.getByRole('menuitem', { name: 'Show as text' }).click();
        },
      ],
      ['help', async () => page.keyboard.press('?')],
    ];
    const found: string[] = [];
    for (const [name, enter] of states) {
      await enter();
      found.push(...(await serious(page)).map((text) => `${name}: ${text}`));
      await page.screenshot({ path: `${outputFolder}/${name}-${colorScheme}-${viewport.width}.png` });
      if (!['main', 'hand', 'selected', 'apart'].includes(name)) await page.keyboard.press('Escape');
    }
    expect(found).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('the keyboard', () => {
  it('reaches every control in the order of the page', async () => {
    const { page } = await prepared({});
    await page.locator('canvas').focus();
    const reached = new Set<string>();
    for (let i = 0; i < 120; i++) {
      await page.keyboard.press('Tab');
      reached.add(
        await page.evaluate(() => {
          const element = document.activeElement;
          return element?.getAttribute('aria-label') ?? element?.textContent ?? '';
        }),
      );
    }
    for (const name of ['stool', 'Share', 'Export', 'seat', 'Hide seat', 'Widen the seat: amount', 'Edit by hand']) {
      expect(
        [...reached].filter((text) => text.includes(name)),
        name,
      ).not.toEqual([]);
    }
    await page.context().close();
  });

  it('turns, hides, shows, selects and looks', async () => {
    const { page } = await prepared({});
    await page.getByRole('button', { name: 'seat', exact: true }).click();
    await page.keyboard.press('h');
    expect(await page.evaluate(() => [...parsel.document().hidden])).toEqual(['seat']);
    await page.keyboard.press('Alt+h');
    expect(await page.evaluate(() => [...parsel.document().hidden])).toEqual([]);
    const pose = () => page.evaluate(() => parsel.stage()?.rig.pose ?? []);
    await page.keyboard.press('1');
    await expect.poll(async () => (await pose()).slice(0, 2)).toEqual([0, 1.571]);
    await page.keyboard.press('7');
    await expect.poll(async () => (await pose())[1]).toBe(0);
    await page.locator('canvas').focus();
    await page.keyboard.press('3');
    await page.keyboard.press('ArrowLeft');
    await expect.poll(async () => (await pose())[0]).toBeCloseTo(1.571 - 0.15, 2);
    await page.context().close();
  });
});
