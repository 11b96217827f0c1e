// The edited model for printers: one solid, its size and volume in the dialog, files that open in our own readers; and what
// is no solid, named.
import { readFile } from 'node:fs/promises';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import { convert } from '../../web/src/formats/convert';
import type { Format } from '../../web/src/formats/model';
import { fileLimits } from '../../web/src/session/files';
import { partsOf } from '../../web/src/solid/parts';
import { boundsOf, volumeOf, weld } from '../../web/src/solid/weld';
import type { DebugHandle } from '../../web/src/ui/debug';
import { toGlb } from '../../web/tools/glb.mjs';
import { serious } from './axe';
import { program, stool, stoolGltf } from './fixture';
import { addEdits, openModel, outputFolder, shapeOf, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

async function openDialog(page: Page) {
  await page.getByRole('button', { name: 'Export' }).click();
  await page.getByRole('menuitem', { name: 'For printing' }).click();
  return page.getByRole('dialog', { name: 'For printing' });
}

async function save(page: Page, format: Format) {
  const button = page.getByRole('button', { name: `Save ${format.toUpperCase()}` });
  const [event] = await Promise.all([page.waitForEvent('download'), button.click()]);
  expect(event.suggestedFilename()).toBe(`stool-edited.${format}`);
  const path = `${outputFolder}/${event.suggestedFilename()}`;
  await event.saveAs(path);
  const source = { path, main: new Uint8Array(await readFile(path)), external: new Map() };
  const { glb } = await convert(source, format, fileLimits.bytes);
  const parts = await partsOf(glb, new Map());
  expect(parts).toHaveLength(1);
  return weld(parts[0] as (typeof parts)[number], 1e-6);
}

const fact = async (page: Page, name: string) =>
  page.locator('.facts dt', { hasText: name }).locator('xpath=following-sibling::dd[1]').textContent();

describe('a model for printing', () => {
  it('is one closed solid of the size and volume that the dialog says, as it is edited', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    const fetched: string[] = [];
    page.on('request', (request) => fetched.push(request.url()));
    const shape = await shapeOf(page);
    const edits = program(shape);
    await page.evaluate(
      (all) => {
        const keys = parsel.addProgram(all, 'test') ?? [];
        parsel.slide(keys[0] ?? 0, 0.4);
      },
      { ...edits, layers: edits.layers.slice(0, 1) },
    );
    await page.getByRole('slider').first().fill('0.4');
    expect(fetched.filter((url) => /manifold/.test(url))).toEqual([]);

    const dialog = await openDialog(page);
    await dialog.getByRole('button', { name: 'Save STL' }).and(page.locator(':enabled')).waitFor();
    expect(fetched.filter((url) => /manifold[^/]*\.wasm/.test(url))).toHaveLength(1);
    await page.screenshot({ path: `${outputFolder}/print.png` });
    expect(await serious(page)).toEqual([]);
    const corners = await page.evaluate(() => parsel.corners());
    const { scale } = shape.frame;
    const { low, high } = boundsOf(corners);
    const size = [0, 2, 1].map((axis) => 1000 * scale * ((high[axis] ?? 0) - (low[axis] ?? 0)));
    expect((await fact(page, 'Size'))?.replace(' mm', '').split(' × ').map(Number)).toEqual(
      size.map((x) => Math.round(x)),
    );
    const said = Number.parseFloat((await fact(page, 'Volume'))?.replace(',', '') ?? '');

    for (const format of ['stl', '3mf'] as const) {
      const mesh = await save(page, format);
      expect(mesh.open).toBe(0);
      expect(volumeOf(mesh) / 1000 / said).toBeCloseTo(1, 3);
      const bounds = boundsOf(mesh.positions);
      for (const [axis, x] of bounds.high.entries())
        expect(x - (bounds.low[axis] ?? 0)).toBeCloseTo(size[axis] ?? 0, 1);
    }

    await page.getByLabel('Longest side').fill('100');
    await page.getByLabel('Longest side').press('Tab');
    expect(await fact(page, 'Size')).toMatch(/100 mm$|100 × /);
    const small = await save(page, 'stl');
    const bounds = boundsOf(small.positions);
    expect(Math.max(...bounds.high.map((x, i) => x - (bounds.low[i] ?? 0)))).toBeCloseTo(100, 3);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it.each([
    ['light', { width: 1440, height: 900 }],
    ['dark', { width: 390, height: 844 }],
  ] as const)(
    'whose part is open is named, nothing is saved, and the rest can be: %s',
    async (colorScheme, viewport) => {
      const { json, binary } = stoolGltf();
      const accessors = json['accessors'] as { count: number }[];
      const [{ indices }] = (json['meshes'] as { primitives: [{ indices: number }] }[])[2]?.primitives ?? [
        { indices: 0 },
      ];
      (accessors[indices] as { count: number }).count -= 3; // a triangle less for every slat
      const { page, complaints } = await openModel(site.browser, site.url, toGlb({ json, binary }), {
        colorScheme,
        viewport,
      });
      const dialog = await openDialog(page);
      await dialog
        .getByText(/slat.* is open at 3 edges\./)
        .first()
        .waitFor();
      expect(await dialog.getByRole('button', { name: 'Save STL' }).isDisabled()).toBe(true);
      expect(await serious(page)).toEqual([]);
      await page.screenshot({ path: `${outputFolder}/print-open-${colorScheme}.png` });
      await dialog.getByRole('button', { name: 'Leave them out' }).click();
      await dialog.getByText('Left out').waitFor();
      expect((await save(page, '3mf')).open).toBe(0);
      await page.keyboard.press('Escape');
      await dialog.waitFor({ state: 'detached' });
      expect(complaints).toEqual([]);
      await page.context().close();
    },
  );

  it('whose parts an edit has pulled apart is in pieces, and one again where its gaps are closed', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    const shape = await shapeOf(page);
    const [first] = program(shape).layers;
    if (first === undefined) throw new Error('the program has no layer');
    const raise = { op: 'translate', part: 'seat', feature: [0, 0, 0], direction: [0, 1, 0], amount: 'x1' } as const;
    const raised = { ...first, request: 'raise the seat', statements: [raise] };
    await addEdits(page, { ...program(shape), layers: [raised] });
    await page.getByRole('slider').first().fill('0.05');

    const dialog = await openDialog(page);
    await dialog.getByText(/It is in \d+ pieces/).waitFor();
    await dialog.getByRole('checkbox', { name: /Close gaps/ }).check();
    await dialog.getByText(/Gaps are closed: longer are .*leg by/).waitFor();
    expect(await dialog.getByText(/It is in/).count()).toBe(0);
    expect(await serious(page)).toEqual([]);
    await page.screenshot({ path: `${outputFolder}/print-gaps.png` });
    expect((await save(page, 'stl')).open).toBe(0);
    await page.keyboard.press('Escape');

    await page.getByRole('button', { name: 'Export' }).click();
    const [event] = await Promise.all([
      page.waitForEvent('download'),
      page.getByRole('menuitem', { name: 'Edited, gaps closed' }).click(),
    ]);
    const parts = await partsOf(new Uint8Array(await readFile(await event.path())), new Map());
    const top = (name: string) =>
      Math.max(...parts.filter((part) => part.name === name).map(({ positions }) => boundsOf(positions).high[2] ?? 0));
    const seat = parts.find(({ name }) => name === 'seat');
    expect(top('leg')).toBeCloseTo(boundsOf(seat?.positions ?? []).low[2] ?? 0, 1);
    await page.getByText(/Gaps are closed/).waitFor();
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('is filled where surfaces are apart, by a module that is fetched when it is asked for', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    const fetched: string[] = [];
    page.on('request', (request) => fetched.push(request.url()));
    const shape = await page.evaluate(() => parsel.document().model?.shape);
    const [first] = shape === undefined ? [] : program(shape).layers;
    const leg = shape?.parts.find(({ node }) => node === 1)?.id;
    if (!shape || first === undefined || leg === undefined) throw new Error('no model');
    const sink = { op: 'translate', part: leg, feature: [0, 0, 0], direction: [0, -1, 0], amount: 'x1' } as const;
    const layer = { ...first, request: 'sink a leg', statements: [sink] };
    await addEdits(page, { ...program(shape), layers: [layer] });
    await page.getByRole('slider').first().fill('0.01');

    const exported = async () => {
      await page.getByRole('button', { name: 'Export' }).click();
      const [event] = await Promise.all([
        page.waitForEvent('download'),
        page.getByRole('menuitem', { name: 'Edited, gaps filled' }).click(),
      ]);
      return partsOf(new Uint8Array(await readFile(await event.path())), new Map());
    };
    const parts = await exported();
    await page.getByText(/Gaps are closed|Filled between/).waitFor();
    expect(parts.length).toBe(10);
    expect(fetched.filter((url) => /poisson.*\.wasm/.test(url)).length).toBe(1);
    await page.screenshot({ path: `${outputFolder}/filled.png` });
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});
