// Joints and mirror images put right by hand: by a click on two parts, kept, taken back, and heeded by the edits.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import { openInstead, outputFolder, saved, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];
beforeEach(async () => {
  ({ page, complaints } = await openInstead(page, site, stool));
});

/** How many joints there are between the seat and real parts of a label. */
const joints = (label: string) =>
  page.evaluate((wanted) => {
    const { parts, relations } = parsel.document().model?.shape ?? { parts: [], relations: [] };
    const of = new Set(parts.filter((part) => part.label === wanted && !part.virtual).map(({ id }) => id));
    return relations
      .filter(
        ({ kind, parts: [a = '', b = ''] }) =>
          /point|line|face|volume/.test(kind) && (a === 'seat' || b === 'seat') && (of.has(a) || of.has(b)),
      )
      .map(({ kind }) => kind);
  }, label);
const mirrors = () =>
  page.evaluate(() => parsel.document().model?.shape.relations.filter(({ kind }) => kind === 'reflection').length);
/** A row's says how many it has. */
const part = (name: string) => page.getByRole('button', { name: new RegExp(`^${name}( \\d+)?$`) });
const chip = (name: string) => page.locator('section[aria-label="Joint"]').getByRole('button', { name, exact: true });
const status = (text: RegExp) => page.getByRole('status').filter({ hasText: text }).waitFor();

async function choose(first: string, second: string): Promise<void> {
  await part(first).click();
  await part(second).click({ modifiers: ['Shift'] });
}

describe('a joint', () => {
  it('is removed for a leg and its mirror images, and taken back by undo, by hand, and after a reload', async () => {
    expect(await joints('leg')).toHaveLength(4);
    await choose('seat', 'front left leg');
    await chip('Remove the joint').click();
    await status(/4 joints removed/);
    expect(await joints('leg')).toEqual([]);
    await chip('Add a joint').waitFor();
    await page.screenshot({ path: `${outputFolder}/joint-removed.png` });
    await saved(page);
    await page.reload();
    await page
      .getByRole('button', { name: /: not joined$/ })
      .first()
      .waitFor();
    expect(await joints('leg')).toEqual([]);
    await page.getByRole('button', { name: /^Take back/ }).click();
    await expect.poll(() => joints('leg')).toHaveLength(4);
    await page.locator('canvas').focus();
    await page.keyboard.press('Control+z');
    await expect.poll(() => joints('leg')).toEqual([]);
    expect(complaints).toEqual([]);
  });

  it('that is gone no longer carries an edit: the edit is worked out again', async () => {
    await page.getByRole('textbox', { name: /change/i }).fill('make the seat wider');
    await page.keyboard.press('Enter');
    await page.locator('.card').first().waitFor();
    const edited = () =>
      page.evaluate(() =>
        parsel.document().layers[0]?.layer.statements.flatMap((one) => ('part' in one ? [one.part] : [])),
      );
    await expect.poll(edited).toEqual(expect.arrayContaining([expect.stringMatching(/^leg/)]));
    await choose('seat', 'front left leg');
    await chip('Remove the joint').click();
    await status(/1 edit worked out again/);
    expect((await edited())?.filter((id) => id.startsWith('leg'))).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/joint-removed-edit.png` });
    expect(complaints).toEqual([]);
  });
});

describe('a mirror image', () => {
  it('is removed with its images, and added', async () => {
    const before = await mirrors();
    await choose('front left leg', 'front right leg');
    await chip('Remove the mirror image').click();
    await status(/mirror images removed/);
    expect(await mirrors()).toBe((before ?? 0) - 2);
    await chip('Add a mirror image').click();
    await expect.poll(mirrors).toBe(before);
  });

  it('that cannot be is refused in a sentence', async () => {
    await choose('seat', 'front left leg');
    await chip('Add a mirror image').click();
    await page
      .getByRole('alert')
      .or(page.getByRole('status'))
      .filter({ hasText: /That cannot be/ })
      .first()
      .waitFor();
  });
});

describe('the card', () => {
  it('is reached from a relation of the selected part, by keyboard alone', async () => {
    await part('seat').click();
    await page.getByRole('button', { name: /^joined to front left leg/ }).focus();
    await page.keyboard.press('Enter');
    await chip('Remove the joint').focus();
    await page.keyboard.press('Enter');
    await status(/4 joints removed/);
  });

  it.each(['light', 'dark'] as const)('is accessible in the %s theme and on a phone', async (colorScheme) => {
    await page.emulateMedia({ colorScheme });
    await choose('seat', 'front left leg');
    await chip('Remove the joint').click();
    await page.getByRole('button', { name: /^Take back/ }).waitFor();
    expect(await serious(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/joint-${colorScheme}.png` });
    await page.setViewportSize({ width: 390, height: 844 });
    await page.getByRole('button', { name: 'Parts', exact: true }).click();
    await chip('Add a joint').waitFor();
    expect(await serious(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/joint-phone-${colorScheme}.png` });
    await chip('Add a joint').click();
    await expect.poll(() => joints('leg')).toHaveLength(4);
  });
});
