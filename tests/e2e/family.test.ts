// The family of a CAD program in the built page, without a key: kinds, sliders, mixtures, what is shared, export.
import { readFile } from 'node:fs/promises';
import type { Page } from 'playwright-core';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import { download, openPage, pick, saved, stillPicture, useSite, withoutGallery } from './harness';

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
});
