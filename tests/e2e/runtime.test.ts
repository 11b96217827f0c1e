// What others do with the package: the examples of its README as they stand there, under a strict policy, and the file
// that holds model and sliders in the page itself.
import { existsSync } from 'node:fs';
import { copyFile, mkdir, mkdtemp, readFile, rm, symlink, writeFile } from 'node:fs/promises';
import type { Server } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';
import type { Browser, Page } from 'playwright-core';
import { afterAll, afterEach, beforeAll, describe, expect, it } from 'vitest';
import { compile, embedProgram, loadProgram } from '../../web/runtime/src/index';
import type { ParselViewer } from '../../web/runtime/src/viewer/element';
import { slidersOf } from '../../web/src/program/sliders';
import type { Shape } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { call, loadModule } from '../web/module';
import { serious } from './axe';
import { program, stool } from './fixture';
import { addEdits, download, launch, openModel, openPage, saved, serve, shapeOf, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const web = fileURLToPath(new URL('../../web', import.meta.url));
/** Nothing but the site's own files, no text as code or markup. */
const policy =
  "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self'; " +
  "require-trusted-types-for 'script'";

let folder: string;
let site: { url: string; server: Server };
let browser: Browser;
let shape: Shape;

/** The blocks of one language in the README, in order. */
async function blocks(language: string): Promise<string[]> {
  const text = await readFile(join(web, 'runtime/README.md'), 'utf8');
  return [...text.matchAll(new RegExp(`^\`\`\`${language}\\n(.*?)^\`\`\``, 'gms'))].map(([, code]) => code ?? '');
}

async function bundle(input: string, file: string): Promise<void> {
  const path = pathToFileURL(join(web, 'node_modules/rolldown/dist/index.mjs')).href;
  const { rolldown } = (await import(/* @vite-ignore */ path)) as typeof import('rolldown');
  const built = await rolldown({ input });
  await built.write({ file, format: 'esm', codeSplitting: false });
}

/** Draws the stool white on nothing with the sliders where they are put; answers the box of what is drawn, in pixels. */
const silhouette = `
import { attachSliders } from 'parsel-runtime/three';
import * as three from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
const canvas = document.querySelector('canvas');
const renderer = new three.WebGLRenderer({ canvas, alpha: true, preserveDrawingBuffer: true });
const camera = new three.OrthographicCamera(-1, 1, 1, -1, 0.1, 10);
camera.position.set(0, 0.5, 5);
const scene = new three.Scene();
const gltf = await new GLTFLoader().loadAsync('chair.glb');
gltf.scene.traverse((object) => { if (object.isMesh) object.material = new three.MeshBasicMaterial(); });
gltf.scene.position.x = 0.125;
scene.add(gltf.scene);
const sliders = attachSliders(gltf);
window.silhouetteAt = (values) => {
  for (const [name, value] of Object.entries(values)) sliders.set(name, value);
  renderer.render(scene, camera);
  const { width, height } = canvas;
  const gl = renderer.getContext();
  const pixels = new Uint8Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  const box = [width, height, -1, -1];
  for (let i = 0; i < width * height; i++) {
    if (pixels[4 * i + 3] === 0) continue;
    const [x, y] = [i % width, Math.floor(i / width)];
    box[0] = Math.min(box[0], x); box[1] = Math.min(box[1], y);
    box[2] = Math.max(box[2], x + 1); box[3] = Math.max(box[3], y + 1);
  }
  return box;
};
window.dispose = () => sliders.dispose();
`;

beforeAll(async () => {
  const standalone = join(web, 'runtime/dist/viewer.standalone.js');
  if (!existsSync(standalone)) throw new Error('web/runtime/dist is not built: run npm run runtime in web/');
  const core = await loadModule();
  shape = call<{ shape: Shape }>(core, 'open', { name: 'stool', external: [] }, [stool]).result.shape;
  const edits = program(shape);
  folder = await mkdtemp(join(tmpdir(), 'parsel-examples-'));
  await mkdir(join(folder, 'node_modules'));
  await symlink(join(web, 'runtime'), join(folder, 'node_modules/parsel-runtime'));
  await symlink(join(web, 'node_modules/three'), join(folder, 'node_modules/three'));
  const [pages, [shop = '', main = ''], [style = '']] = await Promise.all([
    blocks('html'),
    blocks('js'),
    blocks('css'),
  ]);
  expect(pages).toHaveLength(3);
  for (const [i, page] of pages.entries()) {
    const own = join(folder, String(i + 1));
    await mkdir(own);
    await writeFile(join(own, 'index.html'), page);
    await copyFile(standalone, join(own, 'viewer.standalone.js'));
    await writeFile(join(own, 'chair.glb'), i === 1 ? stool : embedProgram(stool, edits, shape));
  }
  await writeFile(join(folder, '2/shop.css'), style);
  await writeFile(join(folder, '2/shop.js'), shop);
  await writeFile(join(folder, '2/chair.sliders.json'), JSON.stringify(slidersOf(edits, shape)));
  const other = { ...shape, frame: { ...shape.frame, scale: 9 * shape.frame.scale } };
  await writeFile(join(folder, '2/other.sliders.json'), JSON.stringify(slidersOf(edits, other)));
  await writeFile(join(folder, '2/newer.sliders.json'), JSON.stringify({ ...slidersOf(edits, shape), version: 2 }));
  await writeFile(join(folder, 'main.js'), main);
  await bundle(join(folder, 'main.js'), join(folder, '3/main.js'));
  await writeFile(join(folder, 'silhouette.js'), silhouette);
  await bundle(join(folder, 'silhouette.js'), join(folder, '3/silhouette.js'));
  await writeFile(
    join(folder, '3/silhouette.html'),
    '<!doctype html><canvas width="400" height="400"></canvas><script type="module" src="silhouette.js"></script>',
  );
  site = await serve(folder, { 'Content-Security-Policy': policy });
  browser = await launch();
}, 240_000);

afterAll(async () => {
  await browser?.close();
  site?.server.close();
  await rm(folder, { recursive: true, force: true });
});

/** Pages that draw all the time take time from those of the tests behind them. */
afterEach(async () => {
  for (const context of browser.contexts()) await context.close();
});

/** Browsers ask every site for an icon, and complain when it has none. */
const example = (path: string, options = {}) =>
  openPage(browser, `${site.url}${path}`, options, (context) =>
    context.route('**/favicon.ico', (route) => route.fulfill({ status: 204 })),
  );
const viewer = (page: Page) => page.locator('parsel-viewer');
const values = (page: Page) => viewer(page).evaluate((element) => (element as unknown as ParselViewer).values);
const ready = (page: Page) => page.getByRole('slider').first().waitFor();

describe('the first example', () => {
  it('shows a model with the sliders that are in it', async () => {
    const { page, complaints } = await example('1/index.html');
    await ready(page);
    const names = await page
      .getByRole('slider')
      .evaluateAll((all) => all.map((one) => one.ariaLabel ?? (one as HTMLInputElement).labels?.[0]?.textContent));
    expect(names).toEqual(['Widen the seat', 'Tilt a leg', 'More slats']);
    await page.getByRole('img', { name: 'A chair that can be widened' }).waitFor();
    const rest = await viewer(page).screenshot();
    await viewer(page).evaluate((element) => (element as unknown as ParselViewer).set('x1', 9));
    expect(await values(page)).toEqual({ x1: 0.5, x2: 0, x3: 0 });
    await expect.poll(async () => (await viewer(page).screenshot()).equals(rest)).toBe(false);
    expect(complaints).toEqual([]);
  });

  it('is worked by keys alone', async () => {
    const { page, complaints } = await example('1/index.html');
    await ready(page);
    const slider = page.getByRole('slider', { name: 'Widen the seat' });
    await slider.focus();
    for (const key of ['ArrowRight', 'Shift+ArrowRight', 'Alt+ArrowLeft', 'PageUp']) await page.keyboard.press(key);
    expect((await values(page))['x1']).toBeCloseTo((1 + 10 - 0.1 + 10) / 200, 9);
    expect(await slider.getAttribute('aria-valuetext')).toBe('+0.105');
    await page.getByRole('button', { name: 'Reset: Widen the seat' }).press('Enter');
    expect((await values(page))['x1']).toBe(0);
    await slider.press('End');
    expect((await values(page))['x1']).toBe(0.5);
    await slider.dblclick();
    expect((await values(page))['x1']).toBe(0);
    await page.locator('canvas').focus();
    const before = await viewer(page).screenshot();
    await page.keyboard.press('ArrowLeft');
    await expect.poll(async () => (await viewer(page).screenshot()).equals(before)).toBe(false);
    expect(complaints).toEqual([]);
  });

  it.each(['light', 'dark'] as const)('is one that axe finds nothing serious in, in the %s', async (colorScheme) => {
    const { page, complaints } = await example('1/index.html', { colorScheme, reducedMotion: 'reduce' });
    await ready(page);
    expect(await serious(page)).toEqual([]);
    const [red = 0] = await viewer(page).evaluate(
      (element) => getComputedStyle(element).backgroundColor.match(/\d+/g)?.map(Number) ?? [],
    );
    expect(red < 128).toBe(colorScheme === 'dark');
    expect(complaints).toEqual([]);
  });
});

describe('the second example', () => {
  it('has the page’s own style, controls and words', async () => {
    const { page, complaints } = await example('2/index.html');
    await ready(page);
    expect(await page.getByText('Widen the seat').evaluate((label) => getComputedStyle(label).fontWeight)).toBe('600');
    await page.getByRole('slider', { name: 'Widen the seat' }).press('ArrowRight');
    await expect.poll(() => page.locator('#chosen').textContent()).toBe('x1 0.01, x2 0.00, x3 0.00');
    await page.getByRole('button', { name: 'Start again' }).click();
    await expect.poll(() => page.locator('#chosen').textContent()).toBe('x1 0.00, x2 0.00, x3 0.00');
    expect(await serious(page)).toEqual([]);
    expect(complaints).toEqual([]);
  });

  it.each([
    ['a file that is not there', { src: 'nothing.glb' }, /nothing\.glb: it could not be fetched \(404\)/],
    ['what is no model', { src: 'shop.css', program: null }, /this is no GLB/],
    ['a model without sliders', { program: null }, /the file holds no sliders.*export “Model with sliders”/],
    [
      'sliders of another model',
      { program: 'other.sliders.json' },
      /does not lie in its hexahedron.*use the program with the model/,
    ],
    ['sliders of a newer version', { program: 'newer.sliders.json' }, /version 2 is unknown.*use version 1/],
  ])('says what is wrong with %s, and shows the next', async (_, attributes, message) => {
    const { page, complaints } = await example('2/index.html');
    await ready(page);
    const change = (to: Record<string, string | null>) =>
      viewer(page).evaluate((element, list) => {
        for (const [name, value] of Object.entries(list)) {
          if (value === null) element.removeAttribute(name);
          else element.setAttribute(name, value);
        }
      }, to);
    await change(attributes as Record<string, string | null>);
    const alert = page.getByRole('alert');
    await expect.poll(() => alert.textContent()).toMatch(message);
    expect(await page.locator('#chosen').textContent()).toMatch(/^not to be had: /);
    expect(await page.getByRole('slider').count()).toBe(0);
    await change({ src: 'chair.glb', program: 'chair.sliders.json' });
    await ready(page);
    expect(await alert.count()).toBe(0);
    expect(complaints.filter((text) => !/Failed to load resource.*404/.test(text))).toEqual([]);
  });
});

describe('the third example', () => {
  it('moves a scene of its own', async () => {
    const { page, complaints } = await example('3/index.html');
    const canvas = page.locator('canvas');
    const pictureAt = async (key: string) => {
      await page.getByRole('slider').press(key);
      await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve))));
      return canvas.screenshot();
    };
    // There and back: the model that comes into view changes the picture as well, but once.
    await expect
      .poll(async () => {
        const [there, back, again] = [await pictureAt('End'), await pictureAt('Home'), await pictureAt('End')];
        return there.equals(again) && !there.equals(back);
      })
      .toBe(true);
    expect(complaints).toEqual([]);
  });

  it('is drawn where the program says, and as it was when that is over', async () => {
    const { page, complaints } = await example('3/silhouette.html');
    await page.waitForFunction(() => 'silhouetteAt' in globalThis);
    type Box = readonly [number, number, number, number];
    const drawnAt = (at: Record<string, number>) =>
      page.evaluate((all) => (globalThis as unknown as { silhouetteAt(at: unknown): Box }).silhouetteAt(all), at);
    const evaluate = compile(loadProgram(program(shape)), shape);
    const { centre, scale } = shape.frame;
    /** What lies in hexahedra lies within their bounds; the seat and the slats fill theirs, from the front. */
    const expectedAt = (at: Record<string, number>): Box => {
      const corners = evaluate(at);
      const box = [9e9, 9e9, -9e9, -9e9];
      const take = (list: Float64Array, from: number, to: number) => {
        for (let i = from; i < to; i += 3) {
          const x = 200 * (1 + centre[0] + 0.125 + scale * (list[i] ?? 0));
          const y = 200 * (1 + centre[1] - 0.5 + scale * (list[i + 1] ?? 0));
          Object.assign(box, [
            Math.min(box[0] ?? 0, x),
            Math.min(box[1] ?? 0, y),
            Math.max(box[2] ?? 0, x),
            Math.max(box[3] ?? 0, y),
          ]);
        }
      };
      for (const [i, { virtual }] of shape.parts.entries()) if (!virtual) take(corners, 24 * i, 24 * i + 24);
      for (const group of evaluate.groups) if (group && group.source >= 0) take(group.instances, 0, 24 * group.count);
      return box as unknown as Box;
    };
    const boxes: Box[] = [];
    for (const at of [
      { x1: 0, x2: 0, x3: 0 },
      { x1: 0.5, x2: 0, x3: 0 },
      { x1: -0.4, x2: 0, x3: 6 },
    ]) {
      const drawn = await drawnAt(at);
      for (const [i, edge] of expectedAt(at).entries()) expect(Math.abs((drawn[i] ?? 0) - edge)).toBeLessThan(2);
      boxes.push(drawn);
    }
    expect(new Set(boxes.map(String)).size).toBe(3);
    await page.evaluate(() => (globalThis as unknown as { dispose(): void }).dispose());
    expect(await drawnAt({})).toEqual(boxes[0]);
    expect(complaints).toEqual([]);
  });
});

describe('a model with sliders in the page', () => {
  let page: { url: string; server: Server };
  let file: Buffer;
  const layers = (of: Page) =>
    of.evaluate(() =>
      parsel
        .document()
        .layers.map(({ layer, value, enabled }) => [layer.request, layer.statements.length, value, enabled]),
    );
  const expected = [
    ['widen the seat', 1, 0.25, true],
    ['tilt a leg', 3, 0, false],
    ['more slats', 1, 0, true],
  ];

  beforeAll(async () => {
    page = await serve();
  });
  afterAll(() => page?.server.close());

  it('is written by the export menu', async () => {
    const { page: own, complaints } = await openModel(browser, page.url, stool);
    const edits = program(await shapeOf(own));
    const [first, ...others] = edits.layers;
    await addEdits(own, {
      ...edits,
      layers: [{ ...first, parameter: { ...first?.parameter, value: 0.25 } }, ...others] as typeof edits.layers,
    });
    await own.getByRole('button', { name: 'More about Tilt a leg' }).click();
    await own.getByRole('menuitem', { name: 'Switch off' }).click();
    await saved(own);
    expect(await layers(own)).toEqual(expected);
    const path = await download(own, 'Model with sliders');
    expect(path).toMatch(/stool-sliders\.glb$/);
    file = await readFile(path);
    expect(complaints).toEqual([]);
  });

  it('opens as it was', async () => {
    const { page: own, complaints } = await openModel(browser, page.url, file, { name: 'stool-sliders.glb' });
    expect(await layers(own)).toEqual(expected);
    expect(complaints).toEqual([]);
  });

  it.each([
    ['the page', '?debug&model=models/stool.glb'],
    ['the viewer', '?debug&embed&model=models/stool.glb'],
  ])('is opened by a link to %s', async (_, search) => {
    const { page: own, complaints } = await openPage(browser, `${page.url}${search}`, {}, async (context) => {
      await withoutGallery(context);
      await context.route('**/models/stool.glb', (route) => route.fulfill({ body: file }));
    });
    await own.waitForFunction(() => parsel.stage()?.isShown());
    expect(await layers(own)).toEqual(expected);
    const isViewer = search.includes('embed');
    expect(await own.locator('.bar').count()).toBe(isViewer ? 0 : 1);
    expect(own.url().includes('model=')).toBe(isViewer); // else it describes a moment, not the page
    expect(await own.getByRole('slider').count()).toBeGreaterThanOrEqual(2);
    expect(complaints).toEqual([]);
  });

  it('is only offered by a link to somewhere else on the site', async () => {
    let asked = 0;
    const { page: own, complaints } = await openPage(
      browser,
      `${page.url}?debug&model=/elsewhere/stool.glb`,
      {},
      async (context) => {
        await withoutGallery(context);
        await context.route(/:\d+\/elsewhere\/stool\.glb$/, (route) => {
          asked++;
          return route.fulfill({ body: file });
        });
      },
    );
    await own.getByText('This link names a model, to be fetched from').waitFor();
    expect(asked).toBe(0);
    await own.getByRole('button', { name: 'Fetch it' }).click();
    await own.waitForFunction(() => parsel.stage()?.isShown());
    expect(await layers(own)).toEqual(expected);
    expect(asked).toBe(1);
    expect(await own.getByText('This link names a model').count()).toBe(0);
    expect(complaints).toEqual([]);
  });
});
