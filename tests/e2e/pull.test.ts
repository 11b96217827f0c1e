// Handles in the view: a face is pulled by the mouse and by the keyboard, the whole shape follows, and it is one step.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { stool } from './fixture';
import { openInstead, outputFolder, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
let page: Page;
let complaints: string[];
beforeEach(async () => {
  ({ page, complaints } = await openInstead(page, site, stool));
  await page.getByRole('button', { name: 'seat', exact: true }).click();
  await handle('Pull left of seat').waitFor();
  await page.waitForFunction(() => parsel.stage()?.isStill()); // the camera has arrived
});

const handle = (name: string) => page.getByRole('button', { name, exact: true });
const corners = () => page.evaluate(() => parsel.corners());
const layers = () => page.evaluate(() => parsel.document().layers.map(({ layer, value }) => ({ layer, value })));

/** Presses a handle and drags it; the button stays down. */
async function drag(name: string, by: readonly [number, number]): Promise<void> {
  const box = await handle(name).boundingBox();
  if (box === null) throw new Error(`${name} is not there`);
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + by[0] / 2, y + by[1] / 2);
  await page.locator('.handle.held .pull-reading').filter({ hasText: '→' }).waitFor();
  await page.mouse.move(x + by[0], y + by[1], { steps: 4 });
}

describe('pulling a face', () => {
  it('moves the shape under the hand, and leaves one layer with a slider, in one step', async () => {
    const rest = await corners();
    await drag('Pull left of seat', [40, 10]);
    const held = await corners();
    expect(held).not.toEqual(rest);
    expect(await page.locator('.card').count()).toBe(0); // nothing is done before the hand lets go
    await page.screenshot({ path: `${outputFolder}/pulling.png` });
    await page.mouse.up();
    await page.locator('.card').waitFor();
    expect(await corners()).toEqual(held);
    const [made] = await layers();
    expect(made?.layer.statements[0]).toMatchObject({ op: 'scale_1d', part: 'seat', direction: { part: 'seat' } });
    expect(made?.value).not.toBe(0);
    expect(await page.locator('.card h3').textContent()).toBe('Pull left of seat');
    await page.keyboard.press('Control+z');
    expect(await corners()).toEqual(rest);
    expect(await page.locator('.card').count()).toBe(0);
    await page.keyboard.press('Control+Shift+z');
    expect(await corners()).toEqual(held);
    expect(complaints).toEqual([]);
  });

  it('keeps the point under the pointer', async () => {
    const where = async () => {
      const box = await handle('Pull left of seat').boundingBox();
      return box ? box.x + box.width / 2 : Number.NaN;
    };
    const before = await where();
    await drag('Pull left of seat', [30, 0]);
    // Along the axis, so the pointer's own way counts as far as the axis runs across the screen.
    await expect.poll(where).toBeGreaterThan(before + 15);
    expect(await where()).toBeLessThan(before + 45);
    await page.mouse.up();
  });

  it('is left by Escape as if it had not been', async () => {
    const rest = await corners();
    await drag('Pull left of seat', [40, 10]);
    expect(await corners()).not.toEqual(rest);
    await page.keyboard.press('Escape');
    expect(await corners()).toEqual(rest);
    await page.mouse.up();
    expect(await layers()).toEqual([]);
    expect(await page.getByRole('button', { name: 'Undo', exact: true }).isDisabled()).toBe(true);
  });

  it('again goes on with the same slider', async () => {
    for (const _ of [1, 2]) {
      await drag('Pull left of seat', [20, 5]);
      await page.mouse.up();
      await page.locator('.card').waitFor();
    }
    expect((await layers()).length).toBe(1);
  });

  it('goes by keyboard too: arrows pull, Enter keeps', async () => {
    const rest = await corners();
    await handle('Pull left of seat').focus();
    await page.keyboard.press('ArrowRight');
    await page.locator('.handle.held .pull-reading').filter({ hasText: '→' }).waitFor();
    await page.keyboard.press('Shift+ArrowRight');
    await page.keyboard.press('Enter');
    await page.locator('.card').waitFor();
    expect(await corners()).not.toEqual(rest);
    expect(complaints).toEqual([]);
  });
});

describe('moving a part', () => {
  it('goes along the axis that is nearest to the drag', async () => {
    await drag('Move seat', [0, -40]);
    await page.mouse.up();
    await page.locator('.card').waitFor();
    const [made] = await layers();
    expect(made?.layer.statements[0]).toMatchObject({ op: 'translate', part: 'seat', direction: [0, 1, 0] });
    expect(made?.value).toBeGreaterThan(0);
    expect(complaints).toEqual([]);
  });

  it('says in a sentence when the core refuses', async () => {
    await page.evaluate(() => {
      const no = () => Promise.reject(new Error('the seat cannot do that; choose another operator'));
      Object.assign(parsel.client(), { call: no });
    });
    const box = await handle('Move seat').boundingBox();
    await page.mouse.move((box?.x ?? 0) + 16, (box?.y ?? 0) + 16);
    await page.mouse.down();
    await page.mouse.move((box?.x ?? 0) + 16, (box?.y ?? 0) - 30, { steps: 3 });
    await expect
      .poll(() => page.getByRole('alert').textContent())
      .toBe('The seat cannot do that; choose another operator.');
    await page.mouse.up();
    expect(await layers()).toEqual([]);
  });
});

describe('whole centimetres', () => {
  it('are what a pull and a slider stop at while they are on, by keyboard as well', async () => {
    await page.getByRole('button', { name: 'Snap to 1 cm' }).click();
    await drag('Pull left of seat', [37, 9]);
    await page.mouse.up();
    const typed = page.locator('.card .typed');
    await typed.waitFor();
    const width = async () => Number.parseFloat(await typed.inputValue());
    const whole = await width();
    expect(await typed.inputValue()).toMatch(/^\d+ cm$/);
    expect(whole).not.toBe(50);
    const slider = page.locator('.card').getByRole('slider');
    await slider.press('ArrowRight');
    expect(await width()).toBe(whole + 1);
    await slider.press('ArrowLeft');
    await slider.press('ArrowLeft');
    expect(await width()).toBe(whole - 1);
    await page.keyboard.press('s');
    expect(await page.getByRole('button', { name: 'Snap to 1 cm' }).getAttribute('aria-pressed')).toBe('false');
    expect(complaints).toEqual([]);
  });
});

describe('the ruler', () => {
  it('measures between two clicks, goes along with the parts, and between parts of the list', async () => {
    await page.keyboard.press('Escape');
    await page.keyboard.press('r');
    const card = page.getByRole('region', { name: 'Ruler' });
    await card.getByText('Click two points').waitFor();
    const seats = await page.evaluate(() => {
      const shape = parsel.document().model?.shape;
      const index = shape?.parts.findIndex(({ name }) => name === 'seat') ?? -1;
      const at = parsel.corners().slice(24 * index, 24 * index + 24);
      const top = [2, 3, 6, 7].map((k) => at.slice(3 * k, 3 * k + 3));
      const mid = (a: readonly number[] = [], b: readonly number[] = []) => a.map((x, i) => (9 * x + (b[i] ?? 0)) / 10);
      return [mid(top[2], top[1]), mid(top[3], top[0])].map((point) => parsel.stage()?.projectMean(point));
    });
    for (const place of seats) await page.mouse.click(place?.x ?? 0, place?.y ?? 0);
    const reading = async () => (await card.getByRole('status').textContent()) ?? '';
    await expect.poll(reading).toMatch(/^\d+(\.\d)? cm on seat · /);
    await page.screenshot({ path: `${outputFolder}/ruler.png` });
    const before = Number.parseFloat(await reading());
    expect(before).toBeGreaterThan(30);
    expect(before).toBeLessThan(50.5);
    // By keyboard: the parts of the list, from middle to middle.
    const row = (name: string) => page.locator('.part').filter({ hasText: name }).first().locator('.name');
    await row('seat').click();
    await row('leg').click();
    await expect.poll(reading).toMatch(/cm from seat to .*leg/);
    await card.getByRole('button', { name: 'Put the ruler away' }).click();
    expect(await card.count()).toBe(0);
    expect(complaints).toEqual([]);
  });
});
