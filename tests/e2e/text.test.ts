// Programs as text in the page: read, edited with errors in place, taken over, added from elsewhere. And the tour.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import { programText } from '../../web/src/program/text';
import type { Shape } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { program, stool } from './fixture';
import { addEdits, openInstead, saved, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];
let shape: Shape;
beforeEach(async () => {
  ({ page, complaints, shape } = await openInstead(page, site, stool));
  await addEdits(page, program(shape));
});

const text = () => page.getByRole('textbox', { name: 'Program', exact: true });
async function show(card: number): Promise<void> {
  await page.locator('.card').nth(card).getByRole('button', { name: 'More about' }).click();
  await page.getByRole('menuitem', { name: 'Show as text' }).click();
}

describe('a layer as text', () => {
  it('is complete, refuses what is wrong in its place, and moves the model when it is right', async () => {
    await show(0);
    const before = await text().inputValue();
    expect(before).toContain('scale_1d("seat", amount=x1');
    const apply = page.getByRole('button', { name: 'Apply' });
    expect(await apply.isDisabled()).toBe(true);

    await text().fill(before.replace('amount=x1', 'amount=y1'));
    const error = page.getByRole('button', { name: /^Line 5, column \d+: the amount names an unknown parameter/ });
    await error.click();
    const marked = await text().evaluate((field: HTMLTextAreaElement) =>
      field.value.slice(field.selectionStart, field.selectionStart + 2),
    );
    expect(marked).toBe('y1');
    expect(await apply.isDisabled()).toBe(true);

    await text().fill(before.replace('amount=x1', 'amount=2*x1'));
    await apply.click();
    await page.getByRole('slider').first().fill('0.2');
    expect(await page.getByLabel('seat width, type a value').inputValue()).toBe('70 cm');
    await page.locator('canvas').focus();
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    await page.getByRole('slider').first().fill('0.2');
    expect(await page.getByLabel('seat width, type a value').inputValue()).toBe('60 cm');
    expect(complaints).toEqual([]);
  });

  it('from a file is added behind the others', async () => {
    await page.getByRole('button', { name: 'Write as text' }).click();
    const content = programText({ ...program(shape), layers: program(shape).layers.slice(0, 1) });
    await page
      .getByLabel('Program from a file')
      .setInputFiles([{ name: 'a.txt', mimeType: 'text/plain', buffer: Buffer.from(content) }]);
    await expect.poll(() => text().inputValue()).toBe(content);
    await page.getByRole('button', { name: 'Add', exact: true }).click();
    await page.locator('.card').nth(3).waitFor();
    const names = await page.evaluate(() => parsel.document().layers.map(({ layer }) => layer.parameter.name));
    expect(new Set(names).size).toBe(4);
    expect(complaints).toEqual([]);
  });
});

describe('the tour', () => {
  const tour = () => page.getByRole('dialog', { name: /^Tour/ });

  it('is offered once, walks by keyboard, and starts again from the menu', async () => {
    const offer = page.getByRole('button', { name: 'Show me around' });
    expect(await offer.count()).toBe(0); // not to people with edits of their own
    await page.getByRole('button', { name: /^Undo/ }).click();
    await offer.click();
    const at = (number: number) => page.getByRole('dialog', { name: `Tour, ${number} of 5` }).waitFor();
    await at(1);
    await page.keyboard.press('Enter');
    await at(2);
    await page.keyboard.press('ArrowRight');
    await at(3);
    await page.keyboard.press('Escape');
    expect(await tour().count()).toBe(0);
    await page.getByRole('button', { name: /^Redo/ }).click();
    await saved(page);
    await page.reload();
    await page.locator('.card').first().waitFor();
    expect(await offer.count()).toBe(0);
    await page.getByRole('button', { name: 'View and help' }).click();
    await page.getByRole('menuitem', { name: 'Tour' }).click();
    for (const number of [1, 2, 3, 4, 5]) {
      await at(number);
      await page.keyboard.press('Enter');
    }
    await tour().waitFor({ state: 'detached' });
    expect(complaints).toEqual([]);
  });
});
