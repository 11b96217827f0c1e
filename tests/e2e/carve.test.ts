// Parts joined, split and cut by hand: in the view and by keyboard, undone, and kept.
import { readFile } from 'node:fs/promises';
import { WebIO } from '@gltf-transform/core';
import type { BrowserContext, Page } from 'playwright-core';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { toGlb } from '../../web/tools/glb.mjs';
import { serious } from './axe';
import { stool, stoolGltf } from './fixture';
import { openModel, outputFolder, saved, settled, useSite } from './harness';
import { tableInOnePiece } from './one_mesh';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let context: BrowserContext;
let complaints: string[];

async function open(model: Buffer, name: string, options = {}) {
  ({ page, complaints } = await openModel(site.browser, site.url, model, { name, ...options }));
  context = page.context();
}
afterEach(async () => {
  await context.close();
  expect(complaints).toEqual([]);
});

const names = () =>
  page.evaluate(() =>
    parsel
      .document()
      .model?.shape.parts.filter(({ virtual }) => !virtual)
      .map(({ name }) => name),
  );
const part = (name: string) => page.locator('.part').filter({ hasText: name }).first().locator('.name');
const selection = () => page.getByLabel('Selection');

describe('the stool', () => {
  beforeEach(() => open(stool, 'stool.glb'));

  it('is cut by a plane that is dragged in the view; undo takes it back, a reload keeps it', async () => {
    const before = await names();
    await part('seat').click();
    await selection().getByRole('button', { name: 'Cut…' }).click();
    const card = page.getByRole('region', { name: 'Cut' });
    expect(await card.getByRole('combobox').inputValue()).toBe('x'); // the longest way
    await card.getByText('25 + 25 cm').waitFor();
    await page.screenshot({ path: `${outputFolder}/carve-cut.png` });
    expect(await serious(page)).toEqual([]);

    const handle = page.getByRole('button', { name: 'Move the cut' });
    const box = await handle.boundingBox();
    if (box === null) throw new Error('the handle is not in sight');
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 60, y, { steps: 6 });
    await page.mouse.up();
    const share = () => card.getByLabel('Where the cut is').inputValue().then(Number);
    expect(await share()).toBeGreaterThan(0.55);
    await handle.press('ArrowLeft');
    const moved = await share();
    await card.getByRole('button', { name: 'Cut', exact: true }).click();
    await expect.poll(names).toEqual(expect.arrayContaining(['seat left', 'seat right']));
    expect((await names())?.length).toBe((before?.length ?? 0) + 1);
    expect(await selection().textContent()).toMatch(/2 parts selected/);
    const widths = await page.evaluate(() =>
      ['seat left', 'seat right'].map((name) => {
        const xs = parsel
          .document()
          .model?.shape.parts.find((one) => one.name === name)
          ?.corners.map(([first]) => first);
        return Math.max(...(xs ?? [])) - Math.min(...(xs ?? []));
      }),
    );
    expect((widths[1] ?? 0) / ((widths[0] ?? 0) + (widths[1] ?? 1))).toBeCloseTo(moved, 2);
    await page.screenshot({ path: `${outputFolder}/carve-cut-done.png` });

    await page.keyboard.press('Control+z');
    await expect.poll(names).toEqual(before);
    await page.keyboard.press('Control+Shift+z');
    await expect.poll(names).toContain('seat left');
    const now = await names();
    await saved(page);
    await page.reload();
    await page.waitForFunction(() => parsel.stage()?.isShown());
    expect(await names()).toEqual(now);
  });

  it('is cut with the keyboard alone, and not at all after Escape', async () => {
    await part('seat').click();
    const begin = selection().getByRole('button', { name: 'Cut…' });
    await begin.focus();
    await page.keyboard.press('Enter');
    const card = page.getByRole('region', { name: 'Cut' });
    await card.getByRole('combobox').selectOption({ label: 'Front from back' });
    await card.getByLabel('Where the cut is').press('ArrowRight');
    await page.keyboard.press('Escape');
    await expect.poll(() => card.count()).toBe(0);
    expect(await names()).not.toContain('seat front');
  });

  it('has two legs joined to one part; parts of several materials are refused in words', async () => {
    const before = (await names())?.length ?? 0;
    const legs = await page.evaluate(() =>
      parsel
        .document()
        .model?.shape.parts.filter(({ name }) => name.includes('leg'))
        .map(({ id }) => id),
    );
    expect(legs?.length).toBeGreaterThan(1);
    await part('seat').click();
    await page
      .locator('.part')
      .filter({ hasText: 'leg' })
      .first()
      .locator('.name')
      .click({ modifiers: ['Shift'] });
    await selection().getByRole('button', { name: 'Join to one part' }).click();
    await page.getByText(/several materials, and a part has one/).waitFor();
    expect((await names())?.length).toBe(before);
  });

  it('keeps its parts while edits are there, and says why', async () => {
    await page.getByLabel('What to change').fill('make the seat wider');
    await page.getByLabel('What to change').press('Enter');
    await expect.poll(() => page.evaluate(() => parsel.document().layers.length)).toBe(1);
    await part('seat').click();
    const cut = selection().getByRole('button', { name: 'Cut…' });
    expect(await cut.isDisabled()).toBe(true);
    expect(await cut.getAttribute('title')).toMatch(/Take the edits back first/);
  });
});

describe('a table in one piece', () => {
  it('is split by hand, two of its parts are joined again, and a link keeps both', async () => {
    await open(tableInOnePiece, 'table.glb');
    await page.locator('.part').first().locator('.name').click();
    await selection().getByRole('button', { name: 'Split into pieces' }).click();
    await expect.poll(async () => (await names())?.length).toBe(6);
    await page.locator('.part').nth(0).locator('.name').click();
    await page
      .locator('.part')
      .nth(1)
      .locator('.name')
      .click({ modifiers: ['Shift'] });
    await selection().getByRole('button', { name: 'Join to one part' }).click();
    await expect.poll(async () => (await names())?.length).toBeLessThan(6);
    await page.screenshot({ path: `${outputFolder}/carve-split.png` });
    const steps = await page.evaluate(() => parsel.document().model?.files.carved?.steps.map(({ kind }) => kind));
    expect(steps).toEqual(['divide', 'join']);
  });
});

it('on a phone the cut has room, in the dark as well', async () => {
  await open(stool, 'stool.glb', { viewport: { width: 390, height: 844 }, colorScheme: 'dark' });
  await page.getByRole('button', { name: 'Parts', exact: true }).click();
  await part('seat').click();
  await selection().getByRole('button', { name: 'Cut…' }).click();
  await page.getByRole('region', { name: 'Cut' }).waitFor();
  await settled(page);
  await page.screenshot({ path: `${outputFolder}/carve-phone.png` });
  expect(await serious(page)).toEqual([]);
});

describe('a model that lies on its back', () => {
  const height = () =>
    page.evaluate(() => {
      const { parts, frame } = parsel.document().model?.shape ?? {};
      const ys = (parts ?? []).flatMap(({ corners }) => corners.map(([, y]) => y));
      return (Math.max(...ys) - Math.min(...ys)) * (frame?.scale ?? 0);
    });

  it('is offered to be stood up, and exported as its file was', async () => {
    const lying = stoolGltf();
    const roots = (lying.json['scenes'] as { nodes: number[] }[])[0]?.nodes ?? [];
    const nodes = lying.json['nodes'] as Record<string, unknown>[];
    nodes.push({
      name: 'lying',
      rotation: [Math.SQRT1_2, 0, 0, Math.SQRT1_2],
      scale: [100, 100, 100],
      children: roots,
    });
    lying.json['scenes'] = [{ nodes: [nodes.length - 1] }];
    await open(toGlb(lying), 'lying.glb');
    const offer = page.getByRole('region', { name: 'How it stands' });
    await offer.getByText('It seems to lie on its back').waitFor();
    await page.screenshot({ path: `${outputFolder}/carve-lying.png` });
    const lyingHeight = await height();
    await offer.getByRole('button', { name: 'Stand it up' }).click();
    await offer.getByText(/This model is .* m high/).waitFor();
    const standing = await height();
    expect(standing).toBeGreaterThan(1.3 * lyingHeight);
    await offer.getByRole('button', { name: /^Make it .* cm high$/ }).click();
    await expect.poll(height).toBeCloseTo(standing / 100, 5);
    await expect.poll(() => offer.count()).toBe(0);
    await page.screenshot({ path: `${outputFolder}/carve-standing.png` });
    expect(await serious(page)).toEqual([]);

    const exported = async (name: string) => {
      await page.getByRole('button', { name: 'Export', exact: true }).click();
      const [download] = await Promise.all([
        page.waitForEvent('download'),
        page.getByRole('menuitem', { name }).click(),
      ]);
      const document = await new WebIO().readBinary(new Uint8Array(await readFile(await download.path())));
      const seat = document
        .getRoot()
        .listNodes()
        .find((node) => node.getName() === 'seat');
      return (seat?.getWorldMatrix() ?? []).map((value) => Math.round(value * 1e4) / 1e4 + 0);
    };
    const original = (await new WebIO().readBinary(new Uint8Array(toGlb(lying)))).getRoot().listNodes()[0];
    const inFile = original?.getWorldMatrix().map((value) => Math.round(value * 1e4) / 1e4 + 0);
    expect(await exported('Edited model .glb')).toEqual(inFile);
    expect(await exported('Edited model as it stands here .glb')).not.toEqual(inFile);
    await page.keyboard.press('Control+z');
    await expect.poll(height).toBeCloseTo(standing, 3);
  });
});
