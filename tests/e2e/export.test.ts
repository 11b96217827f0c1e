// Export through the real core, and what another page makes of the file.
import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import type { Page } from 'playwright-core';
import { afterEach, beforeEach, describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import { gltfJson } from '../../web/src/session/files';
import type { DebugHandle } from '../../web/src/ui/debug';
import { compress } from '../web/compressed';
import { stool } from './fixture';
import { download, openModel, shapeOf, useSite } from './harness';

declare const parsel: DebugHandle;

const { validateBytes } = createRequire(new URL('../../web/package.json', import.meta.url))('gltf-validator');

const site = useSite();

const wider = {
  seed: [
    {
      op: 'scale_1d',
      part: 'seat',
      feature: [0, 0, 0],
      origin: { part: 'seat', at: [0, 0, 0] },
      direction: [1, 0, 0],
      amount: 'x',
    },
  ],
  disabled: [],
  hints: {},
};

let page: Page;
let complaints: string[];
/** The stool with a propagated layer whose slider stands at the given value. */
async function edited(model: Buffer, value: number): Promise<void> {
  ({ page, complaints } = await openModel(site.browser, site.url, model));
  await page.evaluate(
    async ([edit, to]) => {
      const { result } = await parsel.client().call('propagate', { edit });
      const [key] = parsel.addProgram(result.program as Parameters<typeof parsel.addProgram>[0], 'test') ?? [];
      parsel.slide(key ?? 0, to);
    },
    [wider, value] as const,
  );
  await page.getByRole('slider').first().fill(String(value));
}
beforeEach(() => edited(stool, 0.25));
afterEach(async () => {
  expect(complaints).toEqual([]);
  await page.context().close();
});

/** Corners of the real parts in the model's own frame, by node and primitive. */
async function cornersOf(of: Page): Promise<Map<string, number[]>> {
  const { frame, parts } = await shapeOf(of);
  const corners = await of.evaluate(() => parsel.corners());
  const found = new Map<string, number[]>();
  for (const [i, { node, primitive, virtual }] of parts.entries()) {
    const own = corners
      .slice(24 * i, 24 * i + 24)
      .map((value, j) => (frame.centre[j % 3] as number) + frame.scale * value);
    if (!virtual) found.set(`${node}/${primitive}`, own);
  }
  return found;
}

async function reopen(path: string, then: (fresh: Page) => Promise<void>): Promise<void> {
  const fresh = await openModel(site.browser, site.url, await readFile(path));
  await then(fresh.page);
  expect(fresh.complaints).toEqual([]);
  await fresh.page.context().close();
}

const relationsOf = ({ relations }: Shape) => relations.map(({ id, kind, parts }) => ({ id, kind, parts }));

describe('an exported model', () => {
  it('opens as the shape that was shown: same parts, corners and relations', async () => {
    const path = await download(page, 'Edited model');
    const [shape, corners] = [await shapeOf(page), await cornersOf(page)];
    await reopen(path, async (fresh) => {
      const again = await cornersOf(fresh);
      expect([...again.keys()]).toEqual([...corners.keys()]);
      const worst = [...corners].map(([key, own]) =>
        Math.max(...own.map((value, i) => Math.abs(value - (again.get(key)?.[i] as number)))),
      );
      expect(Math.max(...worst)).toBeLessThan(1e-5); // metres
      expect(relationsOf(await shapeOf(fresh))).toEqual(relationsOf(shape));
    });
  });

  it('is sound glTF with an animation, and opens', async () => {
    const path = await download(page, 'Animated by the last slider');
    const bytes = await readFile(path);
    const { issues } = await validateBytes(new Uint8Array(bytes));
    expect(issues.messages.filter(({ severity }: { severity: number }) => severity === 0)).toEqual([]);
    expect(gltfJson(bytes)?.['animations']).toHaveLength(1);
    await reopen(path, async (fresh) => expect((await cornersOf(fresh)).size).toBe(10));
  });

  it('holds the selected part alone', async () => {
    await page.getByRole('button', { name: 'seat', exact: true }).click();
    const path = await download(page, 'Selected part only');
    await reopen(path, async (fresh) => {
      expect((await shapeOf(fresh)).parts.map(({ id }) => id)).toEqual(['seat']);
      const lengths = ['width', 'height', 'depth'].map((name) =>
        fresh.getByLabel(`${name}, type a length`, { exact: true }).inputValue(),
      );
      expect(await Promise.all(lengths)).toEqual(['62.5', '4', '40']);
    });
  });

  it('is written after the worker has died', async () => {
    await page.evaluate(() =>
      parsel
        .client()
        .call('fail', { kind: 'abort' })
        .catch(() => null),
    );
    const path = await download(page, 'Edited model');
    expect((await readFile(path)).length).toBeGreaterThan(1000);
  });

  it('is plain when the file came compressed, and shows the edit', async () => {
    await page.context().close();
    await edited(await compress(stool, 'Draco'), 0.25);
    const path = await download(page, 'Edited model');
    expect(gltfJson(await readFile(path))?.['extensionsUsed'] ?? []).toEqual([]);
    const corners = await cornersOf(page);
    await reopen(path, async (fresh) => {
      const again = await cornersOf(fresh);
      for (const [key, own] of corners) {
        for (const [i, value] of own.entries()) expect(again.get(key)?.[i]).toBeCloseTo(value, 4);
      }
    });
  });
});
