// The family of a CAD program in the built page, without a key: kinds, sliders, mixtures, what is shared, export.
import { readFile } from 'node:fs/promises';
import type { Page } from 'playwright-core';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import {
  download,
  openModel,
  openPage,
  outputFolder,
  pick,
  saved,
  stillPicture,
  useSite,
  withoutGallery,
} from './harness';
import { boxes } from './wall';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];

const shown = () => page.waitForFunction(() => parsel.stage()?.isShown());
const ready = () => page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
const slider = (name: string) => page.getByRole('slider', { name, exact: true });
const metres = (text: string | null) =>
  Number.parseFloat(text ?? '') / (text?.endsWith('mm') ? 1000 : text?.endsWith('cm') ? 100 : 1);
const reads = async (name: string) => metres(await slider(name).getAttribute('aria-valuetext'));

const file = (name: string, text: string) => ({ name, mimeType: 'text/plain', buffer: Buffer.from(text) });
const said = () => page.locator('.status-line').getByRole('status').textContent();

describe('what reads CAD programs', () => {
  const isModuleUrl = /parsel_cad[^/]*\.wasm/;
  const block = [file('block.scad', '// block\ncube([3, 4, 5]);\n')];
  const fetched: string[] = [];
  beforeAll(async () => {
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    page.on('request', (request) => isModuleUrl.test(request.url()) && fetched.push(request.url()));
    await ready();
  });

  it('is not fetched for other models; says what to do where it cannot be, and can be cancelled', async () => {
    await pick(page, [{ name: 'stool.glb', mimeType: 'model/gltf-binary', buffer: stool }]);
    await shown();
    expect(fetched).toEqual([]);
    await page.route(isModuleUrl, (route) => route.abort());
    await pick(page, block);
    await expect
      .poll(() => page.getByRole('alert').textContent())
      .toMatch(/What reads CAD programs could not be fetched .*look whether there is a network, and open it again/);
    await page.unroute(isModuleUrl);
    await page.route(isModuleUrl, () => {}); // never answers
    await pick(page, block);
    await expect.poll(said).toMatch(/fetching what reads CAD programs/);
    await page.getByRole('button', { name: 'Cancel' }).click();
    await expect.poll(said).toBe('');
    expect(await page.evaluate(() => parsel.document().model?.shape.name)).toBe('stool');
    await page.unroute(isModuleUrl);
    expect(complaints.filter((text) => !/ERR_FAILED/.test(text))).toEqual([]);
  });

  it('is fetched with the first program, once', async () => {
    fetched.length = 0;
    for (const name of ['block', 'brick']) {
      await pick(page, [file(`${name}.scad`, '// block\ncube([3, 4, 5]);\n')]);
      await expect.poll(() => page.evaluate(() => parsel.document().model?.shape.name)).toBe(name);
    }
    expect(fetched).toHaveLength(1);
    await page.context().close();
  });
});

describe('a CAD program', () => {
  beforeAll(async () => {
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    await ready();
    await page.locator('.bar .model').click();
    await page.getByRole('heading', { name: /OpenSCAD programs/ }).waitFor();
    await page.getByRole('button', { name: 'Chair', exact: true }).click();
    await shown();
  });

  it('opens with its six kinds and few sliders', async () => {
    const kinds = page.getByRole('region', { name: 'Variations' }).getByRole('listitem');
    await expect.poll(() => kinds.count()).toBe(7); // and as it is drawn
    expect(await page.getByRole('button', { name: 'as drawn' }).getAttribute('aria-pressed')).toBe('true');
    await expect.poll(() => page.locator('.variations img').count()).toBe(7);
    const count = await page.getByRole('region', { name: 'Sliders' }).getByRole('slider').count();
    expect(count).toBeGreaterThan(8);
    expect(count).toBeLessThan(20);
  });

  it('a slider moves, by keys and typed, and is undone', async () => {
    const before = await reads('leg height');
    await slider('leg height').focus();
    await page.keyboard.press('Shift+ArrowRight');
    const after = await reads('leg height');
    expect(after).toBeGreaterThan(before);
    const typed = page.getByRole('textbox', { name: 'leg height, type a value' });
    await typed.fill('50 cm');
    await typed.press('Enter');
    expect(await reads('leg height')).toBeCloseTo(0.5, 3);
    await page.getByRole('button', { name: /^Undo/ }).click();
    await page.getByRole('button', { name: /^Undo/ }).click();
    await expect.poll(() => reads('leg height')).toBeCloseTo(before, 6);
  });

  it('mixes towards the bar stool, and shows it whole', async () => {
    const before = await reads('leg height');
    await slider('Mix in bar stool').fill('0.5');
    const half = await reads('leg height');
    expect(half).toBeGreaterThan(before);
    await page.getByRole('button', { name: 'bar stool', exact: true }).click();
    expect(await reads('leg height')).toBeCloseTo(0.72, 3);
    expect(half).toBeCloseTo((before + 0.72) / 2, 2);
    expect(await page.getByRole('checkbox', { name: /arm/ }).isChecked()).toBe(false);
    expect(await page.evaluate(() => [...parsel.document().hidden].sort())).toEqual(['arm_left', 'arm_right']);
  });

  it('tells what they share, shows its faces, and another number of sliders follows at once', async () => {
    const sliders = page.getByRole('region', { name: 'Sliders' }).getByRole('slider');
    const before = await sliders.count();
    await page.getByText('In common', { exact: false }).first().click();
    const lines = page.locator('.shared').first().getByRole('checkbox');
    expect(await lines.count()).toBeGreaterThan(5);
    await page.getByText('By accident', { exact: false }).first().click();
    const accident = page.locator('.shared').nth(1).getByRole('checkbox').first();
    const plain = await stillPicture(page);
    await accident.hover();
    expect((await stillPicture(page)).equals(plain)).toBe(false);
    await accident.check();
    await expect.poll(() => page.locator('.status-line').getByRole('status').textContent()).toMatch(/^\d+ sliders/);
    const after = await sliders.count();
    expect(after).toBeLessThanOrEqual(before);
    await page.getByRole('button', { name: /^Undo/ }).click();
    await expect.poll(() => sliders.count()).toBe(before);
  });

  it('is exported as OpenSCAD that begins there, and as a GLB with the parts that are there', async () => {
    const scad = await readFile(await download(page, 'OpenSCAD with sliders'), 'utf8');
    expect(scad).toMatch(/^leg_height = 720; \/\/ \[/m);
    expect(scad).toMatch(/^with_arm = false;/m);
    const glb = await readFile(await download(page, 'Edited model'));
    const json = JSON.parse(glb.subarray(20, 20 + glb.readUInt32LE(12)).toString());
    const shownParts = json.scenes[0].nodes.map((node: number) => json.nodes[node].name);
    expect(shownParts).toContain('seat');
    expect(shownParts.filter((name: string) => name.startsWith('arm'))).toEqual([]);
  });

  it('comes back after a reload, and has no serious fault, on a phone either', async () => {
    await saved(page);
    await page.reload();
    await ready();
    await shown();
    await expect.poll(() => reads('leg height')).toBeCloseTo(0.72, 3);
    expect(await serious(page)).toEqual([]);
    await page.setViewportSize({ width: 390, height: 844 });
    await page.getByRole('button', { name: 'Family' }).waitFor();
    expect(await serious(page)).toEqual([]);
    await page.setViewportSize({ width: 1440, height: 900 });
    expect(complaints).toEqual([]);
  });

  it('of a person: opens by the picker, and is refused by its line', async () => {
    const stool =
      '// seat\ntranslate([-20, -20, 40]) cube([40, 40, 4]);\nmodule leg() cube([4, 4, 40]);\nfor (x = [-20, 16], y = [-20, 16]) translate([x, y, 0]) leg();\n';
    await pick(page, [file('stool.scad', stool)]);
    await expect.poll(() => page.evaluate(() => parsel.document().model?.shape.name)).toBe('stool');
    await shown();
    await expect
      .poll(() => page.getByRole('region', { name: 'Sliders' }).getByRole('slider').count())
      .toBeGreaterThan(1);
    await pick(page, [file('bad.scad', 'cube(1);\nminkowski() { cube(1); sphere(1); }\n')]);
    await expect.poll(() => page.getByRole('alert').textContent()).toMatch(/line 2/i);
    expect(await page.evaluate(() => parsel.document().model?.shape.name)).toBe('stool');
    expect(complaints).toEqual([]);
  });

  it('lacks a part that only cuts where its box is cleared: what is drawn, what looks chosen, after a reload', async () => {
    const block = `difference() {
  // block
  cube([40, 20, 10]);
  // hole
  translate([10, 10, -1]) cylinder(d = 6, h = 12);
}
`;
    const variations = [{ name: 'drilled' }, { name: 'plain', absent: ['hole'] }];
    await pick(page, [
      file('block.scad', block),
      file('block.variations.json', JSON.stringify({ format: 'parsel/variations', version: 1, variations })),
    ]);
    await expect.poll(() => page.evaluate(() => parsel.document().model?.shape.name)).toBe('block');
    await shown();
    const corners = () => page.evaluate(() => parsel.stage()?.trianglesOf(0).length ?? 0);
    const chosen = () =>
      page.getByRole('region', { name: 'Variations' }).locator('button[aria-pressed="true"]').allTextContents();
    const box = page.getByRole('checkbox', { name: 'hole' });
    await expect.poll(corners).toBeGreaterThan(36);
    expect(await box.isChecked()).toBe(true);
    expect(await chosen()).toEqual(['as drawn', 'drilled']);
    await box.uncheck();
    await expect.poll(corners).toBe(36);
    expect(await chosen()).toEqual(['plain']);
    await page.screenshot({ path: `${outputFolder}/family-plain.png` });
    await page.keyboard.press('Control+z');
    await expect.poll(corners).toBeGreaterThan(36);
    expect(await box.isChecked()).toBe(true);
    await page.getByRole('button', { name: 'plain', exact: true }).click();
    await expect.poll(corners).toBe(36);
    await saved(page);
    await page.reload();
    await ready();
    await shown();
    await expect.poll(corners).toBe(36);
    expect(await box.isChecked()).toBe(false);
    expect(complaints).toEqual([]);
  });
});

describe('a model that no program made', () => {
  /** Two boards on three posts, each part a box along the axes. */
  const board = (y: number) => ({ name: 'board', translation: [0, y, 0], scale: [1.2, 0.04, 0.4] });
  const post = (x: number) => ({ name: 'post', translation: [x, 0.35, 0], scale: [0.06, 0.66, 0.4] });
  const bench = boxes([board(0.7), board(0), post(-0.57), post(0), post(0.57)]);
  const variations = () => page.getByRole('region', { name: 'Variations' }).getByRole('listitem');
  const width = () =>
    page.evaluate(() => {
      const along = parsel.corners().filter((_, i) => i % 3 === 0);
      return (Math.max(...along) - Math.min(...along)) * (parsel.document().model?.shape.frame.scale ?? 1);
    });

  beforeAll(async () => {
    ({ page, complaints } = await openModel(site.browser, site.url, bench, { name: 'bench.glb' }));
    const field = page.getByLabel('What to change');
    await field.fill('wider');
    await field.press('Enter');
    await page.locator('.card').waitFor();
  });

  it('gets a family of its own: a state of its edits is kept, and sliders lead there', async () => {
    const keep = page.getByRole('button', { name: 'Keep as variation' });
    const edit = page.getByRole('slider', { name: /: amount$/ }).first();
    await edit.fill('0');
    const narrow = await width();
    await expect.poll(() => keep.isDisabled()).toBe(true);
    await edit.focus();
    await page.keyboard.press('End');
    const wide = await width();
    expect(wide).toBeGreaterThan(1.1 * narrow);
    await keep.click();
    await page.keyboard.type('long bench');
    await page.keyboard.press('Enter');
    await expect.poll(() => variations().count()).toBe(2);
    await expect.poll(() => page.locator('.variations img').count()).toBe(2);
    expect(await width()).toBeCloseTo(wide, 4);
    expect(await page.getByRole('button', { name: 'long bench', exact: true }).getAttribute('aria-pressed')).toBe(
      'true',
    );
    await page.getByRole('button', { name: 'as drawn' }).click();
    expect(await width()).toBeCloseTo(narrow, 4);
    await slider('Mix in long bench').fill('0.5');
    expect(await width()).toBeCloseTo((narrow + wide) / 2, 3);
    expect(await serious(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/family-kept.png` });
    await page.emulateMedia({ colorScheme: 'dark' });
    await page.screenshot({ path: `${outputFolder}/family-kept-dark.png` });
    await page.emulateMedia({ colorScheme: 'light' });
  });

  it('is there after a reload, and gone by undo', async () => {
    const half = await width();
    await saved(page);
    await page.reload();
    await shown();
    await page.getByRole('button', { name: 'Family', exact: true }).click();
    await expect.poll(() => variations().count()).toBe(2);
    expect(await width()).toBeCloseTo(half, 4);
    await page.getByRole('button', { name: 'Remove long bench' }).click();
    await expect.poll(() => variations().count()).toBe(0);
    expect(await page.locator('.card').count()).toBe(1);
    await page.getByRole('button', { name: /^Undo/ }).click();
    await expect.poll(() => variations().count()).toBe(2); // and the tab with it
    expect(complaints).toEqual([]);
  });
});
