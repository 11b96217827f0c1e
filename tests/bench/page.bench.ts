// Speed of the built page in a real browser. Needs web/dist (./web/start.sh --build-only); reads the furniture of
// PARSEL_DATA where there is some.
//
//   npm --prefix web run bench:page
//
// Prints CSV `benchmark,case,metric,value`; nothing is asserted. Without a graphics card everything is drawn by the
// processor, which picking and the cold start feel.
import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Page } from 'playwright-core';
import { expect, it } from 'vitest';
import type { Program, Shape, Statement } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { toGlb } from '../../web/tools/glb.mjs';
import { stoolGltf } from '../e2e/fixture';
import { openModel, openPage, useSite } from '../e2e/harness';

declare const parsel: DebugHandle;

const site = useSite();
/** Small, since it is drawn without a graphics card. */
const viewport = { width: 640, height: 400 };

const print = (name: string, metric: string, value: number, digits = 3) =>
  process.stdout.write(`page,${name},${metric},${value.toFixed(digits)}\n`);
const median = (values: readonly number[]) => [...values].sort((a, b) => a - b)[values.length >> 1] ?? Number.NaN;

it('a cold start to a moving slider', async () => {
  const times: number[] = [];
  for (let i = 0; i < 3; i++) {
    const { page } = await openPage(site.browser, site.url, { viewport }, (context) =>
      context.addInitScript(() => {
        const look = () => {
          const slider = document.querySelector<HTMLInputElement>('input[type=range]');
          if (slider !== null && Number(slider.value) !== 0) Object.assign(globalThis, { moved: performance.now() });
          else requestAnimationFrame(look);
        };
        requestAnimationFrame(look);
      }),
    );
    await page.waitForFunction(() => 'moved' in globalThis, null, { timeout: 60_000 });
    times.push(await page.evaluate(() => (globalThis as unknown as { moved: number }).moved));
    await page.context().close();
  }
  print('cold start to a moving slider', 'ms', median(times), 0);
  print('cold start to a moving slider', 'ms_least', Math.min(...times), 0);
});

/** Boxes that differ in size and place, so that nothing ties them. */
function boxes(count: number): Buffer {
  const { json, binary } = stoolGltf();
  const letters = (i: number) => String.fromCharCode(97 + (i % 10), 97 + Math.floor(i / 10));
  const nodes = Array.from({ length: count }, (_, i) => ({
    name: `box ${letters(i)}`,
    mesh: 0,
    translation: [i % 10, Math.floor(i / 10), 0.5 * Math.sin(7 * i)],
    scale: [1 + 0.3 * Math.sin(i), 4 + 2 * Math.sin(2 * i), 1 + 0.3 * Math.sin(3 * i)],
  }));
  return toGlb({ json: { ...json, nodes, scenes: [{ nodes: nodes.map((_, i) => i) }] }, binary });
}

/** Two statements a part. */
function programFor({ name, sha256, parts }: Shape): Program {
  const statements = parts.flatMap(({ id }): Statement[] => [
    {
      op: 'scale_1d',
      part: id,
      feature: [0, 0, 0],
      origin: { part: id, at: [0, 0, 0] },
      direction: [1, 0, 0],
      amount: 'x1/2',
    },
    {
      op: 'rotate',
      part: id,
      feature: [0, 0, 0],
      origin: { part: id, at: [0, -1, 0] },
      axis: [0, 0, 1],
      amount: 'atan2(x1, 2)',
    },
  ]);
  const layer = { request: 'all', parameter: { name: 'x1', min: -1, max: 1, value: 0 }, statements, relations: [] };
  return { format: 'parsel/program', version: 1, shape: { name, sha256 }, layers: [layer] };
}

/** Seconds of script that the page's thread has run. */
async function scriptSeconds(page: Page): Promise<() => Promise<number>> {
  const session = await page.context().newCDPSession(page);
  await session.send('Performance.enable');
  return async () => {
    const { metrics } = await session.send('Performance.getMetrics');
    return metrics.find(({ name }) => name === 'ScriptDuration')?.value ?? Number.NaN;
  };
}

it('a step of the slider with 100 parts', async () => {
  const { page } = await openModel(site.browser, site.url, boxes(100), { name: 'boxes.glb', viewport });
  const shape = (await page.evaluate(() => parsel.document().model?.shape)) as Shape;
  const [key = -1] = (await page.evaluate((edits) => parsel.addProgram(edits, 'bench'), programFor(shape))) ?? [];
  expect(shape.parts.length).toBe(100);
  await page.waitForFunction(() => parsel.stage()?.isStill());
  const evaluation = await page.evaluate(() => {
    const evaluator = parsel.evaluator();
    const values = new Float64Array(1);
    const times: number[] = [];
    for (let round = 0; round < 20; round++) {
      const begin = performance.now();
      for (let i = 0; i < 100; i++) {
        values[0] = Math.sin(100 * round + i);
        evaluator?.evaluate(values);
      }
      times.push((performance.now() - begin) / 100);
    }
    return times;
  });
  print('step with 100 parts', 'evaluation_ms', median(evaluation));
  const steps = 40;
  const script = await scriptSeconds(page);
  const slide = (count: number) =>
    page.evaluate(
      async ([layer, total]) => {
        for (let i = 0; i < total; i++) {
          parsel.slide(layer, Math.sin(i));
          await new Promise(requestAnimationFrame);
        }
      },
      [key, count] as const,
    );
  await slide(10); // warm
  const before = await script();
  await slide(steps);
  print('step with 100 parts', 'script_ms_with_drawing', (1000 * ((await script()) - before)) / steps);
  const step = await page.evaluate(async (layer) => {
    const times: number[] = [];
    for (let i = 0; i < 40; i++) {
      const begin = performance.now();
      parsel.slide(layer, Math.sin(i));
      times.push(performance.now() - begin);
      await new Promise(requestAnimationFrame);
    }
    return times;
  }, key);
  print('step with 100 parts', 'script_ms_without_drawing', median(step));
  await page.context().close();
});

const furniture = process.env['PARSEL_DATA'] ?? fileURLToPath(new URL('../../../shared/data', import.meta.url));
const shelf = join(furniture, 'furniture', 'shelf_ivar_0678.glb');

it.skipIf(!existsSync(shelf))('picking in a model of 257,000 triangles', async () => {
  const { page } = await openModel(site.browser, site.url, readFileSync(shelf), { name: 'shelf.glb', viewport });
  await page.waitForFunction(() => parsel.stage()?.isStill());
  const times = await page.evaluate(async () => {
    const stage = parsel.stage();
    const found: number[] = [];
    for (let i = 0; i < 15; i++) {
      const begin = performance.now();
      await stage?.pick(innerWidth / 2 + 3 * (i - 7), innerHeight / 2);
      found.push(performance.now() - begin);
    }
    return found;
  });
  print('picking in 257,000 triangles', 'ms', median(times));
  print('picking in 257,000 triangles', 'first_ms', times[0] ?? Number.NaN);
  await page.context().close();
});
