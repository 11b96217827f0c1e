// Several parts at once: by click, box, list and likeness; shown alone; edited together. And lists of a thousand parts.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import { openModel, outputFolder, shapeOf, useSite } from './harness';
import { wall } from './wall';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];
let shape: Shape;

async function open(model: Buffer, options: Parameters<typeof openModel>[3] = {}): Promise<void> {
  await page?.context().close();
  ({ page, complaints } = await openModel(site.browser, site.url, model, options));
  shape = await shapeOf(page);
}

const selected = () => page.evaluate(() => [...parsel.selected()]);
const hidden = () => page.evaluate(() => [...parsel.document().hidden]);
const legs = () => shape.parts.filter(({ label, virtual }) => label === 'leg' && !virtual).map(({ id }) => id);

/** Where the middle of a part is on screen. */
const middleOf = (id: string) =>
  page.evaluate((part) => {
    const on = parsel.stage();
    const at = parsel.document().model?.shape.parts.findIndex((other) => other.id === part) ?? 0;
    return on?.projectMean(on.corners.slice(at * 24, at * 24 + 24)) ?? { x: 0, y: 0 };
  }, id);

describe('several parts', () => {
  beforeEach(() => open(stool));

  it('are selected by Shift+click, all that are alike at once, and shown alone', async () => {
    const front = legs().filter((id) => id.includes('front'));
    for (const id of front) {
      const { x, y } = await middleOf(id);
      await page.keyboard.down('Shift');
      await page.mouse.click(x, y);
      await page.keyboard.up('Shift');
    }
    await expect.poll(async () => (await selected()).sort()).toEqual(front.sort());
    await page.getByRole('button', { name: 'All 4 like this' }).click();
    expect((await selected()).sort()).toEqual(legs().sort());
    await page.screenshot({ path: `${outputFolder}/several-light.png` });
    expect(await serious(page)).toEqual([]);
    await page.keyboard.press('i');
    const others = shape.parts.filter(({ id, virtual }) => !virtual && !legs().includes(id)).map(({ id }) => id);
    expect((await hidden()).sort()).toEqual(others.sort());
    await page.getByRole('button', { name: 'Show all', exact: true }).click();
    expect(await hidden()).toEqual([]);
    expect(complaints).toEqual([]);
  });

  it('are selected by a box, which does not turn the view', async () => {
    const pose = () => page.evaluate(() => parsel.stage()?.rig.pose);
    const before = await pose();
    const at = await Promise.all(legs().map(middleOf));
    const [left, right] = [Math.min(...at.map(({ x }) => x)) - 15, Math.max(...at.map(({ x }) => x)) + 15];
    const [top, bottom] = [Math.min(...at.map(({ y }) => y)) - 10, Math.max(...at.map(({ y }) => y)) + 40];
    await page.keyboard.down('Shift');
    await page.mouse.move(left, bottom);
    await page.mouse.down();
    await page.mouse.move((left + right) / 2, (top + bottom) / 2, { steps: 3 });
    await page.mouse.move(right, top, { steps: 3 });
    await page.locator('.box-select').waitFor();
    await page.mouse.up();
    await page.keyboard.up('Shift');
    expect((await selected()).sort()).toEqual(legs().sort());
    expect(await pose()).toEqual(before);
    expect(complaints).toEqual([]);
  });

  it('are edited together: each of them gets the edit', async () => {
    const [a = '', b = ''] = legs().filter((id) => id.includes('front'));
    await page.evaluate((ids) => parsel.selectAll(ids), [a, b]);
    await page.getByRole('button', { name: 'Edit together' }).click();
    await page.getByLabel('Thicken').check({ force: true });
    await page.getByLabel('Direction').selectOption('1');
    await page.getByRole('button', { name: 'Apply' }).click();
    await page.locator('.card').waitFor();
    const seeds = await page.evaluate(() =>
      parsel
        .document()
        .layers.flatMap(({ layer }) => layer.statements)
        .filter(({ why }) => why?.kind === 'seed')
        .map((statement) => [statement.op, 'part' in statement ? statement.part : '']),
    );
    expect(seeds.sort()).toEqual([
      ['scale_2d', a],
      ['scale_2d', b],
    ]);
    const name = await page.locator('.card h3').textContent();
    expect(name).toMatch(/^Thicken .* and /);
    expect(complaints).toEqual([]);
  });

  it('are moved together by a handle', async () => {
    const slats = shape.parts.filter(({ label, virtual }) => label === 'slat' && !virtual).map(({ id }) => id);
    await page.evaluate((ids) => parsel.selectAll(ids), [...slats, 'seat']);
    const handle = page.getByRole('button', { name: /^Move / });
    await handle.focus();
    await page.keyboard.press('ArrowUp');
    await page.locator('.handle.held .pull-reading').filter({ hasText: '→' }).waitFor();
    await page.keyboard.press('Enter');
    await page.locator('.card').waitFor();
    const group = shape.parts.find(({ members }) => slats.every((id) => members.includes(id)));
    const seeds = await page.evaluate(() =>
      (parsel.document().layers[0]?.layer.statements ?? [])
        .filter(({ why }) => why?.kind === 'seed')
        .map((statement) => ('part' in statement ? statement.part : '')),
    );
    expect(seeds.sort()).toEqual([group?.id, 'seat'].sort());
    expect(complaints).toEqual([]);
  });

  it('are selected from one row of the list to another by Shift+click', async () => {
    const names = page.locator('.part .name');
    const pressed = () => names.evaluateAll((all) => all.map((name) => name.getAttribute('aria-pressed') === 'true'));
    const count = await names.count();
    await names.nth(1).click();
    await names.nth(count - 1).click({ modifiers: ['Shift'] });
    await expect.poll(pressed).toEqual(Array.from({ length: count }, (_, i) => i >= 1));
    await names.nth(2).click({ modifiers: ['Shift'] }); // the first one stays where the range begins
    await expect.poll(pressed).toEqual(Array.from({ length: count }, (_, i) => i === 1 || i === 2));
    await names.nth(0).click({ modifiers: ['Shift'] });
    await expect.poll(pressed).toEqual(Array.from({ length: count }, (_, i) => i < 2));
    expect(complaints).toEqual([]);
  });

  it('are found by arrows in the list, which is one stop of the Tab key', async () => {
    await page.locator('.part .name').first().focus();
    await page.keyboard.press('Shift+ArrowDown');
    // As slow as people are: the view has followed the selection by then.
    await expect.poll(async () => (await selected()).length).toBe(2);
    await page.waitForFunction(() => parsel.stage()?.isStill());
    await page.keyboard.press('Shift+ArrowDown');
    await expect.poll(async () => (await selected()).length).toBe(3);
    expect(await page.locator('.parts [tabindex="0"]').count()).toBeLessThanOrEqual(3);
  });
});

describe('a thousand parts', () => {
  it('are listed by those in sight, and found by name', async () => {
    await open(wall(25, 40), { name: 'wall.glb' });
    await expect.poll(() => page.locator('.part').count()).toBeGreaterThan(10);
    expect(await page.locator('.part').count()).toBeLessThan(80);
    const find = page.getByLabel('Find a part');
    await find.fill('drawer 37');
    expect(await page.locator('.part .name').count()).toBeLessThan(60);
    await find.press('Enter');
    const found = await selected();
    expect(found.length).toBeGreaterThan(0);
    expect(found.filter((id) => !/drawer_\d*37/.test(id))).toEqual([]);
    await find.fill('');
    await page.locator('.parts.long').evaluate((list) => list.scrollTo(0, 1e6));
    await expect.poll(() => page.locator('.part').last().getAttribute('aria-posinset')).toMatch(/^\d{3,}$/);
    expect(await page.locator('.part').count()).toBeLessThan(80);
    await page.screenshot({ path: `${outputFolder}/thousand.png` });
    expect(complaints).toEqual([]);
  });

  it('and their labels are offered a few at a time, where one is typed', async () => {
    await page.getByLabel('Find a part').fill('');
    await page.locator('.part .name').nth(2).click();
    const field = page.getByLabel('Label', { exact: true });
    const offered = () =>
      page.locator('#part-labels option').evaluateAll((all) => all.map((one) => (one as HTMLOptionElement).value));
    await field.waitFor();
    expect(await offered()).toEqual([]);
    await field.focus();
    expect((await offered()).length).toBe(50);
    await field.fill('77');
    const like = await offered();
    expect(like.length).toBeGreaterThan(1);
    expect(like.filter((label) => !label.includes('77'))).toEqual([]);
    await field.press('Escape');
    expect(complaints).toEqual([]);
  });
});
