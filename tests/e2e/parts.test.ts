// The outliner and the exploded view: labels that a person gives, why parts move, parts drawn apart.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { program, stool } from './fixture';
import { addEdits, openInstead, outputFolder, saved, stillPicture, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];
let shape: Shape;
beforeEach(async () => {
  ({ page, complaints, shape } = await openInstead(page, site, stool));
});

const partNames = () => page.locator('.part .name').allTextContents();
const label = () => page.getByLabel('Label', { exact: true });
const ids = () => page.evaluate(() => parsel.document().model?.shape.parts.map(({ id }) => id));

async function giveLabel(part: string, text: string): Promise<void> {
  await page.getByRole('button', { name: part, exact: true }).click();
  await label().fill(text);
  await label().press('Enter');
  await page.getByRole('button', { name: text, exact: true }).waitFor();
}

describe('a label', () => {
  it('renames the part and its id, keeps its edits, and is taken back by undo', async () => {
    await addEdits(page, program(shape));
    await page.getByRole('slider').first().fill('0.3');
    const before = await ids();
    const corners = await page.evaluate(() => parsel.corners());
    await giveLabel('seat', 'lid');
    expect(await ids()).toContain('lid');
    expect(await page.locator('.card.off').count()).toBe(0);
    expect(await page.evaluate(() => parsel.corners())).toEqual(corners);
    expect(await page.locator('.part.selected').textContent()).toContain('lid');
    await page.screenshot({ path: `${outputFolder}/relabelled.png` });
    await page.keyboard.press('Escape');
    await page.locator('canvas').focus();
    await page.keyboard.press('Control+z');
    await expect.poll(ids).toEqual(before);
    expect(complaints).toEqual([]);
  });

  it('dissolves a row; the edit of its count is kept, but rests', async () => {
    await addEdits(page, program(shape));
    const members = shape.relations.find(({ kind }) => kind === 'translation')?.parts ?? [];
    const middle = shape.parts.find(({ id }) => id === members[1]);
    await page.locator('.part .twist[aria-expanded]').first().click();
    await giveLabel(middle?.name ?? '', 'panel');
    await page.locator('.card.off .unfit').waitFor();
    expect(await page.locator('.card').count()).toBe(3);
    await page
      .getByRole('status')
      .filter({ hasText: /no longer fits/ })
      .waitFor();
    await page.getByRole('button', { name: 'Reset', exact: true }).click();
    await expect.poll(() => page.locator('.unfit').count()).toBe(0);
    expect(await ids()).toEqual(shape.parts.map(({ id }) => id));
    expect(complaints).toEqual([]);
  });

  it('is there again after a reload', async () => {
    await giveLabel('seat', 'lid');
    await saved(page);
    await page.reload();
    await page.getByRole('button', { name: 'lid', exact: true }).waitFor();
    expect(await partNames()).not.toContain('seat');
  });
});

describe('why a part moves', () => {
  it('is said of every part, also of one that stays', async () => {
    await page.getByRole('button', { name: 'seat', exact: true }).click();
    const handle = page.getByRole('button', { name: 'Move seat', exact: true });
    await handle.focus();
    await page.keyboard.press('ArrowUp');
    await page.locator('.handle.held .pull-reading').filter({ hasText: '→' }).waitFor();
    await page.keyboard.press('Enter');
    await page.locator('.card').waitFor();
    const why = page.getByRole('region', { name: 'Why it moves' });
    await expect.poll(() => why.textContent()).toMatch(/what was asked for/);
    const real = shape.parts.filter(({ members }) => members.length === 0);
    for (const { id } of real) {
      await page.evaluate((part) => parsel.select(part), id);
      const text = (await why.textContent()) ?? '';
      expect(text, id).toMatch(/\. ?$|\.How|\.$/);
      expect(text, id).toMatch(/asked for|joined|mirrors|follows|row|gives up|Stays/);
    }
    expect(complaints).toEqual([]);
  });
});

describe('parts apart', () => {
  it('are drawn and picked where they stand then, and the model is as it was', async () => {
    const corners = await page.evaluate(() => parsel.corners());
    const together = await stillPicture(page);
    await page.keyboard.press('e');
    const slider = page.getByLabel('How far the parts are drawn apart');
    await expect.poll(async () => Number(await slider.inputValue())).toBe(1);
    const apart = await stillPicture(page);
    expect(apart.equals(together)).toBe(false);
    expect(await page.evaluate(() => parsel.corners())).toEqual(corners);
    const leg = shape.parts.findIndex(({ node }) => node === 2);
    const at = await page.evaluate((part) => {
      const drawn = parsel.stage()?.corners.slice(part * 24, part * 24 + 24) ?? [];
      return parsel.stage()?.projectMean(drawn) ?? { x: 0, y: 0 };
    }, leg);
    await page.mouse.click(at.x, at.y);
    await expect.poll(() => page.locator('.part.selected').textContent()).toContain(shape.parts[leg]?.name);
    await page.screenshot({ path: `${outputFolder}/apart.png` });
    await page.keyboard.press('Escape');
    await page.getByRole('button', { name: 'Put the parts together' }).click();
    await slider.waitFor({ state: 'detached' });
    expect(await page.evaluate(() => [...(parsel.stage()?.corners ?? [])])).toEqual(corners);
    expect(complaints).toEqual([]);
  });
});
