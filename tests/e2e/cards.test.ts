// Cards together: compared with the model as it was, reset, kept under names, folded, grouped, copied, reopened.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { program, stool } from './fixture';
import { addEdits, openInstead, outputFolder, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

let page: Page;
let complaints: string[];
beforeEach(async () => {
  const opened = await openInstead(page, site, stool);
  ({ page, complaints } = opened);
  await addEdits(page, program(opened.shape));
});

const values = () => page.evaluate(() => parsel.document().layers.map(({ value }) => value));
const width = () => page.getByLabel('width, type a length', { exact: true }).inputValue();
const menu = async (title: string, item: string) => {
  await page
    .getByRole('button', { name: `More about ${title}` })
    .first()
    .click();
  await page.getByRole('menuitem', { name: item }).click();
};

describe('the cards', () => {
  it('are compared with the model as it was while a button is held', async () => {
    await page.getByRole('slider').first().fill('0.5');
    expect(await width()).toBe('75');
    const compare = page.getByRole('button', { name: 'Compare' });
    await compare.hover();
    await page.mouse.down();
    await expect.poll(width).toBe('50');
    await page.mouse.up();
    await expect.poll(width).toBe('75');
    await compare.focus();
    await page.keyboard.down('Enter');
    await expect.poll(width).toBe('50');
    await page.keyboard.up('Enter');
    await expect.poll(width).toBe('75');
    expect((await values())[0]).toBe(0.5);
    await page.getByRole('button', { name: 'Reset all' }).click();
    expect(await values()).toEqual([0, 0, 0]);
    await page.getByRole('button', { name: 'Undo: reset all sliders' }).click();
    expect((await values())[0]).toBe(0.5);
    expect(complaints).toEqual([]);
  });

  it('keep positions as presets, which a reload keeps', async () => {
    await page.getByRole('slider').first().fill('0.5');
    const presets = page.getByRole('button', { name: 'Presets' });
    await presets.click();
    await page.getByRole('menuitem', { name: 'Keep these positions…' }).click();
    await page.getByLabel('Name of the preset').fill('wide');
    await page.getByLabel('Name of the preset').press('Enter');
    await page.getByRole('button', { name: 'Reset all' }).click();
    expect(await page.evaluate(() => parsel.flushed())).toBe(true);
    await page.reload();
    await page.locator('.card').nth(2).waitFor();
    await presets.click();
    await page.getByRole('menuitem', { name: 'wide', exact: true }).click();
    expect((await values())[0]).toBe(0.5);
    expect(complaints).toEqual([]);
  });

  it('fold to a line, one by one and all, and gather in groups', async () => {
    await page.getByRole('button', { name: 'Fold widen the seat' }).click();
    const first = page.locator('.card').first();
    expect(await first.getByRole('slider').count()).toBe(0);
    expect((await first.boundingBox())?.height ?? 99).toBeLessThan(60);
    await page.getByRole('button', { name: 'Fold all edits' }).click();
    expect(await page.locator('.card').getByRole('slider').count()).toBe(0);
    await page.getByRole('button', { name: 'Unfold all edits' }).click();
    expect(await page.locator('.card').getByRole('slider').count()).toBe(3);
    await menu('widen the seat', 'Group…');
    await page.getByLabel('Group of the edit').fill('sizes');
    await page.getByLabel('Group of the edit').press('Enter');
    const group = page.getByRole('listitem', { name: 'Group sizes' });
    expect(await group.locator('.card').count()).toBe(1);
    await page.screenshot({ path: `${outputFolder}/cards-group.png` });
    expect(await serious(page)).toEqual([]);
    await group.getByRole('button', { name: /^sizes/ }).click();
    expect(await page.locator('.card').count()).toBe(2);
    expect(complaints).toEqual([]);
  });

  it('are copied, and show how far they go', async () => {
    expect(await page.locator('.card').first().locator('.ends').innerText()).toMatch(/25 cm[\s\S]*75 cm/);
    await menu('widen the seat', 'Duplicate');
    expect(await values()).toHaveLength(4);
    expect(complaints).toEqual([]);
  });
});

describe('a count', () => {
  it('offers the other reading, and a card can be reopened and changed', async () => {
    await page.evaluate(() => parsel.client()); // the core has started
    await page.getByLabel('What to change').fill('two more slats');
    await page.getByLabel('What to change').press('Enter');
    await page.locator('.card').nth(3).waitFor();
    const anchor = () =>
      page.evaluate(() => {
        const seed = parsel.document().layers[3]?.layer.statements.find(({ why }) => why?.kind === 'seed');
        return seed?.op === 'change_count' ? seed.anchor : null;
      });
    expect(await anchor()).toBe('fit');
    const own = page.locator('.card').nth(3);
    await own.getByRole('button', { name: /^Keep the spacing instead/ }).click();
    await own.getByRole('button', { name: /^Keep the room instead/ }).waitFor();
    expect(await anchor()).toBe('middle');
    await page.getByRole('button', { name: 'Undo: change edit' }).click();
    expect(await anchor()).toBe('fit');
    await menu('two more slats', 'Change…');
    await page.getByLabel('Change the edit').getByRole('radio', { name: 'Spacing' }).check({ force: true });
    await page.getByLabel('Change the edit').getByRole('button', { name: 'Apply' }).click();
    await page.getByRole('button', { name: 'Undo: change edit' }).waitFor();
    expect(await anchor()).toBeNull();
    expect(await page.evaluate(() => parsel.document().layers[3]?.layer.request)).toBe('two more slats');
    expect(complaints).toEqual([]);
  });
});
