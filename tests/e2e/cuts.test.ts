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

const text = `// board
difference() {
  // board
  cube([600, 300, 20]);
  // cable hole
  translate([280, 200, 0]) cube([40, 50, 20]);
  // notch
  translate([0, 150, -1]) cylinder(h = 22, r = 60);
}
// side
translate([0, 0, -200]) cube([20, 300, 200]);
// side
translate([580, 0, -200]) cube([20, 300, 200]);
`;
/** Of the round notch, a polygon of 48 corners about 0 in which the board's left end is: what lies in the board. */
function notch(left: number): number {
  const corner = (k: number) => [60 * Math.cos((k * Math.PI) / 24), 60 * Math.sin((k * Math.PI) / 24)] as const;
  let area = 0;
  for (let k = 0; k < 48; k++) {
    const [[ax, ay], [bx, by]] = [corner(k), corner(k + 1)];
    // Trapezoids between each side and the line of the left end.
    const [from, to] = [Math.max(ax, left), Math.max(bx, left)];
    const at = (x: number) => (ax === bx ? ay : ay + ((x - ax) / (bx - ax)) * (by - ay));
    const [y0, y1] = [ax < left ? at(left) : ay, bx < left ? at(left) : by];
    if (ax >= left || bx >= left) area += ((from - left + (to - left)) / 2) * (y1 - y0);
  }
  return area;
}

/** What the graphics card draws of the board: cubic millimetres, and where it begins. */
async function drawn(): Promise<{ volume: number; left: number; right: number }> {
  const [vertices, triangles, scale, middle] = await page.evaluate(async () => {
    const { parts = [], frame } = parsel.document().model?.shape ?? {};
    const part = parts.findIndex(({ id }) => id === 'board');
    const found = [...((await parsel.stage()?.readVertices(part, 'positions')) ?? [])];
    return [
      found,
      parsel.stage()?.trianglesOf(part) ?? [],
      1000 * (frame?.scale ?? 0),
      1000 * (frame?.centre[0] ?? 0),
    ] as const;
  });
  const positions = Float64Array.from(vertices, (x) => scale * x);
  const x = positions.filter((_, i) => i % 3 === 0).map((own) => own + middle);
  const volume = volumeOf({ positions, triangles: Uint32Array.from(triangles) });
  return { volume, left: Math.min(...x), right: Math.max(...x) };
}

/** Of the volume that the board should have, how much is wrong. */
async function error(): Promise<number> {
  const { volume, left, right } = await drawn();
  return Math.abs(volume / (((right - left) * 300 - 40 * 50 - notch(left)) * 20) - 1);
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
    const { left, right } = await drawn();
    expect([left, right].map((x) => Math.round(x) + 0)).toEqual([0, 600]);
    expect(await error()).toBeLessThan(1e-4);
    await page.screenshot({ path: `${outputFolder}/cuts.png` });
  });

  it('at rest is cut as it stands after a slider has moved', async () => {
    const names = await page.getByRole('slider').evaluateAll((all) => all.map((one) => one.getAttribute('aria-label')));
    expect(names).toContain('board width');
    await page.getByRole('textbox', { name: 'board width, type a value' }).fill('700 mm');
    await page.keyboard.press('Enter');
    // The hole and the notch are as wide as they were, whatever the board is, and the notch is round at its new place.
    await expect.poll(error).toBeLessThan(1e-4);
    const { left, right } = await drawn();
    expect(Math.round(right - left)).toBe(700);
    expect(left).toBeLessThan(-1);
    await page.screenshot({ path: `${outputFolder}/cuts-wide.png` });
  });

  it('is exported cut', async () => {
    const glb = await readFile(await download(page, 'Edited model'));
    const parts = await partsOf(new Uint8Array(glb), new Map());
    const board = parts.find(({ name }) => name === 'board');
    if (board === undefined) throw new Error(`no board among ${parts.map(({ name }) => name)}`);
    const mesh = weld(board, 1e-3);
    expect(mesh.open).toBe(0);
    const { volume } = await drawn();
    expect(Math.abs(volumeOf(mesh) / volume - 1)).toBeLessThan(1e-4);
  });
});

describe('the pictures of variations of a program that cuts', () => {
  const frame = `// frame
difference() {
  // frame
  cube([100, 10, 100]);
  // window
  translate([20, -1, 20]) cube([60, 12, 60]);
}
`;
  const variations = {
    format: 'parsel/variations',
    version: 1,
    variations: [
      {
        name: 'low',
        bounds: {
          window: [
            [20, 80],
            [4, 24],
            [-11, 1],
          ],
        },
      },
      { name: 'blind', absent: ['window'] },
    ],
  };
  /** How much the middle of each picture covers, 0 … 255. */
  const middles = () =>
    page.locator('.variations img').evaluateAll((images) =>
      (images as HTMLImageElement[]).map((image) => {
        const canvas = Object.assign(document.createElement('canvas'), { width: 1, height: 1 });
        const context = canvas.getContext('2d');
        context?.drawImage(image, -image.naturalWidth / 2, -image.naturalHeight / 2);
        return context?.getImageData(0, 0, 1, 1).data[3];
      }),
    );

  it('are cut as each of them is', async () => {
    ({ page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery));
    await page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
    const beside = Buffer.from(JSON.stringify(variations));
    await pick(page, [
      { name: 'frame.scad', mimeType: 'text/plain', buffer: Buffer.from(frame) },
      { name: 'frame.variations.json', mimeType: 'application/json', buffer: beside },
    ]);
    await page.waitForFunction(() => parsel.stage()?.isShown());
    await expect.poll(middles).toEqual([0, 255, 255]); // as drawn, low, blind
    await page.screenshot({ path: `${outputFolder}/cuts-variations.png` });
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});
