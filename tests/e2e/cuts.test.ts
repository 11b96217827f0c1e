// A program that cuts: drawn as it is cut, at rest exactly, also after its sliders and edits have moved, and exported so.
import { readFile } from 'node:fs/promises';
import type { Page } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { partsOf } from '../../web/src/solid/parts';
import { volumeOf, weld } from '../../web/src/solid/weld';
import type { DebugHandle } from '../../web/src/ui/debug';
import { download, openPage, outputFolder, pick, useSite, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];

const text = `// A shelf with a hole for cables, and a round notch.
difference() {
  cube([600, 300, 20]); // board
  translate([280, 200, 0]) cube([40, 50, 20]); // cable hole
  translate([0, 150, -1]) cylinder(h = 22, r = 60); // notch
}
translate([0, 0, -200]) cube([20, 300, 200]); // left side
translate([580, 0, -200]) cube([20, 300, 200]); // right side
`;
const halfDisc = (24 * 60 ** 2 * Math.sin((2 * Math.PI) / 48)) / 2;

/** Of what the graphics card draws of the board, in cubic millimetres. */
async function drawn(): Promise<number> {
  const [vertices, triangles, scale] = await page.evaluate(async () => {
    const { parts = [], frame } = parsel.document().model?.shape ?? {};
    const part = parts.findIndex(({ id }) => id === 'board');
    const found = [...((await parsel.stage()?.readVertices(part, 'positions')) ?? [])];
    return [found, parsel.stage()?.trianglesOf(part) ?? [], 1000 * (frame?.scale ?? 0)] as const;
  });
  return volumeOf({
    positions: Float64Array.from(vertices, (x) => scale * x),
    triangles: Uint32Array.from(triangles),
  });
}

describe('a program that cuts', () => {
  beforeAll(async () => {
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    await page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
    await pick(page, [{ name: 'shelf.scad', mimeType: 'text/plain', buffer: Buffer.from(text) }]);
    await page.waitForFunction(() => parsel.stage()?.isShown());
  });
  afterAll(async () => {
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('is drawn cut from its first picture on', async () => {
    expect(await drawn()).toBeCloseTo((600 * 300 - 40 * 50 - halfDisc) * 20, -3);
    await page.screenshot({ path: `${outputFolder}/cuts.png` });
  });

  it('at rest is cut as it stands after a slider has moved', async () => {
    const names = await page.getByRole('slider').evaluateAll((all) => all.map((one) => one.getAttribute('aria-label')));
    expect(names).toContain('board width');
    await page.getByRole('textbox', { name: 'board width, type a value' }).fill('700 mm');
    await page.keyboard.press('Enter');
    // The hole is as wide as it was, whatever the board is.
    await expect.poll(drawn).toBeCloseTo((700 * 300 - 40 * 50 - halfDisc) * 20, -3);
    await page.screenshot({ path: `${outputFolder}/cuts-wide.png` });
  });

  it('is exported cut, and one solid for printers', async () => {
    const glb = await readFile(await download(page, 'Edited model'));
    const parts = await partsOf(new Uint8Array(glb), new Map());
    const board = parts.find(({ name }) => name === 'board');
    if (board === undefined) throw new Error(`no board among ${parts.map(({ name }) => name)}`);
    const mesh = weld(board, 1e-3);
    expect(mesh.open).toBe(0);
    expect(volumeOf(mesh)).toBeCloseTo(await drawn(), -3);
  });
});
