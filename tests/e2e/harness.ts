// A static server for web/dist under a sub-path, and Debian's Chromium. A page that violates its
// Content-Security-Policy, throws, or logs an error fails the test that opened it.
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import {
  type Browser,
  type BrowserContext,
  type BrowserContextOptions,
  chromium,
  type Locator,
  type Page,
} from 'playwright-core';
import { afterAll, beforeAll } from 'vitest';
import type { Protocol } from '../../web/src/llm/providers';
import type { Program, Shape } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { type ProviderServer, startProviders } from '../web/provider_server';

export const dist = fileURLToPath(new URL('../../web/dist', import.meta.url));
export const outputFolder = fileURLToPath(new URL('../output', import.meta.url));

const types: Record<string, string> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.json': 'application/json',
  '.scad': 'text/plain',
  '.glb': 'model/gltf-binary',
  '.png': 'image/png',
  '.webmanifest': 'application/manifest+json',
};

/** A server and a browser for all tests of a file. */
export function useSite(): { readonly url: string; readonly browser: Browser } {
  let site: { url: string; server: Server; browser: Browser } | undefined;
  beforeAll(async () => {
    site = { ...(await serve()), browser: await launch() };
  });
  afterAll(async () => {
    await site?.browser.close();
    site?.server.close();
  });
  const started = () => {
    if (site === undefined) throw new Error('the site is used before it has started');
    return site;
  };
  return {
    get url() {
      return started().url;
    },
    get browser() {
      return started().browser;
    },
  };
}

/** A server that speaks the providers' protocols, for all tests of a file. */
export function useProviders(): Omit<ProviderServer, 'server'> {
  let started: ProviderServer | undefined;
  beforeAll(async () => {
    started = await startProviders();
  });
  afterAll(() => {
    started?.server.closeAllConnections();
    started?.server.close();
  });
  const providers = () => {
    if (started === undefined) throw new Error('the providers are used before they have started');
    return started;
  };
  return {
    get calls() {
      return providers().calls;
    },
    base: (protocol) => providers().base(protocol),
    behave: (behaviour) => providers().behave(behaviour),
  };
}

/** What a page that was built without a gallery, and a test's own gallery models, have in its place. */
function emptyAnswer(path: string): string | null {
  if (/^gallery\/(gallery|programs|nameless)\.json$/.test(path)) return '[]';
  return /^recordings\/[^/]+\.json$/.test(path) ? '{"requests":[],"replies":{},"models":[]}' : null;
}

/**
 * Serves web/dist, or another built page, at /some/where/; answers with the page's address.
 * @param headers sent with every file
 */
export async function serve(
  folder = dist,
  headers: Readonly<Record<string, string>> = {},
): Promise<{ url: string; server: Server }> {
  if (folder === dist && !existsSync(join(dist, 'index.html')))
    throw new Error('web/dist is not built: run ./web/start.sh --build-only');
  const base = '/some/where/';
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
    const relative = normalize(path.slice(base.length) || 'index.html');
    if (!path.startsWith(base) || relative.startsWith('..')) return response.writeHead(404).end();
    try {
      const bytes = await readFile(join(folder, relative));
      const type = types[extname(relative)] ?? 'application/octet-stream';
      response.writeHead(200, { ...headers, 'Content-Type': type }).end(bytes);
    } catch {
      const empty = emptyAnswer(relative);
      if (empty !== null) response.writeHead(200, { 'Content-Type': types['.json'] }).end(empty);
      else response.writeHead(404).end();
    }
  });
  await new Promise<void>((resolve) => server.listen(0, '127.0.0.1', resolve));
  return { url: `http://127.0.0.1:${(server.address() as AddressInfo).port}${base}`, server };
}

export function launch(extraArguments: string[] = []): Promise<Browser> {
  const folders = (process.env['PATH'] ?? '').split(':');
  const candidates = ['chromium', 'google-chrome'].flatMap((name) => folders.map((folder) => join(folder, name)));
  const executablePath = candidates.find(existsSync);
  if (executablePath === undefined) throw new Error('no Chromium on the PATH: apt-get install chromium');
  return chromium.launch({
    executablePath,
    headless: true,
    args: [
      '--no-sandbox',
      '--disable-quic',
      '--no-first-run',
      '--disable-background-networking',
      '--disable-component-update',
      '--disable-sync',
      '--use-angle=swiftshader',
      '--enable-unsafe-swiftshader',
      ...extraArguments,
    ],
  });
}

export interface WatchedPage {
  page: Page;
  /** Everything that must not happen, as text. Tests check that it is empty. */
  complaints: string[];
}

/**
 * A page in a fresh profile, watched for violations of its policy, errors and unhandled rejections. Without a service
 * worker unless the options allow it.
 */
export async function openPage(
  browser: Browser,
  url: string,
  options: BrowserContextOptions = {},
  prepare: (context: BrowserContext) => Promise<unknown> = async () => {},
): Promise<WatchedPage> {
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    serviceWorkers: 'block', // it would answer what tests answer for the server
    ...options,
  });
  context.setDefaultTimeout(120_000); // as in web/vitest.e2e.config.ts
  await prepare(context);
  const page = await context.newPage();
  const complaints: string[] = [];
  page.on('pageerror', (error) => complaints.push(`page error: ${error.message}`));
  page.on('console', (message) => {
    if (message.type() === 'error') complaints.push(`console: ${message.text()}`);
  });
  await page.exposeFunction('reportViolation', (text: string) => complaints.push(`policy violation: ${text}`));
  await page.addInitScript(() => {
    document.addEventListener('securitypolicyviolation', (event) => {
      const report = (window as unknown as { reportViolation(text: string): void }).reportViolation;
      report(`${event.violatedDirective} blocked ${event.blockedURI}`);
    });
  });
  await page.goto(url);
  return { page, complaints };
}

declare const parsel: DebugHandle;

/** The page with `?debug`, empty, with a model opened by the file picker. */
export async function openModel(
  browser: Browser,
  url: string,
  model: Buffer,
  options: BrowserContextOptions & { search?: string; name?: string } = {},
): Promise<WatchedPage> {
  const { search = '?debug', name = 'stool.glb', ...rest } = options;
  const watched = await openPage(browser, `${url}${search}`, rest, withoutGallery);
  await pick(watched.page, [{ name, mimeType: 'model/gltf-binary', buffer: model }]);
  await watched.page.waitForFunction(() => parsel.stage()?.isShown());
  return watched;
}

/** openModel() in place of the page that the test before left. */
export async function openInstead(
  last: Page | undefined,
  site: { readonly url: string; readonly browser: Browser },
  model: Buffer,
): Promise<WatchedPage & { shape: Shape }> {
  await last?.context().close();
  const watched = await openModel(site.browser, site.url, model);
  return { ...watched, shape: await shapeOf(watched.page) };
}

/** The shape of the model that is open. */
export async function shapeOf(page: Page): Promise<Shape> {
  const shape = await page.evaluate(() => parsel.document().model?.shape);
  if (!shape) throw new Error('no model is open');
  return shape;
}

/** Adds the layers of a program, and waits until their cards are there. */
export async function addEdits(page: Page, edits: Program): Promise<void> {
  const before = await page.locator('.card').count();
  await page.evaluate((all) => parsel.addProgram(all, 'test'), edits);
  await page
    .locator('.card')
    .nth(before + edits.layers.length - 1)
    .waitFor();
}

/** Fills in the dialog of the language model: a key for a server that speaks a protocol. The dialog stays open. */
export async function useKey(page: Page, protocol: Protocol, base: string, votes: number): Promise<void> {
  await page.getByRole('button', { name: /^Language model/ }).click();
  await page.getByLabel('Provider').selectOption(protocol);
  await page.getByLabel('Base URL').fill(base);
  await page.getByLabel('Base URL').press('Tab');
  await page.getByLabel('Key', { exact: true }).fill('sk-secret');
  await page.getByLabel('Model', { exact: true }).fill('tester');
  await page.getByLabel('Answers to each question').fill(String(votes));
  await page.getByLabel('Answers to each question').press('Tab');
}

/** A gallery of one model, which the page opens by itself. */
export const withGalleryOf =
  (model: Buffer) =>
  async (context: BrowserContext): Promise<void> => {
    await context.route('**/gallery/gallery.json', (route) =>
      route.fulfill({ json: [{ id: 'stool', title: 'A stool', requests: ['Widen it.'] }] }),
    );
    await context.route('**/gallery/stool.glb', (route) => route.fulfill({ body: model }));
  };

/** No gallery, so that the page starts empty. */
export const withoutGallery = (context: BrowserContext): Promise<unknown> =>
  context.route('**/gallery/gallery.json', (route) => route.fulfill({ json: [] }));

export async function pick(page: Page, files: { name: string; mimeType: string; buffer: Buffer }[]): Promise<void> {
  await page.locator('.bar .model').click();
  const input = page.getByLabel('Open files');
  await expectEnabled(input);
  await input.setInputFiles(files);
}

async function expectEnabled(locator: Locator): Promise<void> {
  await locator.and(locator.page().locator(':enabled')).waitFor({ state: 'attached' });
}

/** Has the work written to the browser's store, without waiting for the pause that saving waits for. */
export async function saved(page: Page): Promise<void> {
  if (!(await page.evaluate(() => parsel.flushed()))) throw new Error('the browser keeps no work');
}

/** Exports through the menu; answers where the file is. */
export async function download(page: Page, item: string): Promise<string> {
  await page.getByRole('button', { name: 'Export' }).click();
  const [event] = await Promise.all([
    page.waitForEvent('download'),
    page.getByRole('menuitem', { name: item }).click(),
  ]);
  const path = `${outputFolder}/${event.suggestedFilename()}`;
  await event.saveAs(path);
  return path;
}

/** Until what the style sheets move has arrived: nothing fades or slides in any more. What turns for ever does not count. */
export async function settled(page: Page): Promise<void> {
  await page.evaluate(async () => {
    const frame = () => new Promise(requestAnimationFrame);
    for (;;) {
      // A frame for what has been clicked to be shown, and one for its transitions to begin.
      await frame();
      await frame();
      const passing = document
        .getAnimations()
        .filter(({ playState, effect }) => playState === 'running' && effect?.getComputedTiming().endTime !== Infinity);
      if (passing.length === 0) return;
      await Promise.allSettled(passing.map(({ finished }) => finished));
    }
  });
}

/** The canvas once nothing moves any more. */
export async function stillPicture(page: Page): Promise<Buffer> {
  let last = await page.locator('canvas').screenshot();
  for (let i = 0; i < 50; i++) {
    await page.waitForFunction(() => parsel.stage()?.isStill());
    const next = await page.locator('canvas').screenshot();
    if (next.equals(last)) return next;
    last = next;
  }
  throw new Error('the picture never came to rest');
}

/** Drops files as a person does: with the events that the page listens to. */
export async function drop(page: Page, files: Record<string, Buffer>): Promise<void> {
  const plain = Object.entries(files).map(([name, buffer]) => [name, buffer.toString('base64')] as const);
  await page.evaluate((list) => {
    const transfer = new DataTransfer();
    for (const [name, base64] of list) {
      const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
      transfer.items.add(new File([bytes], name));
    }
    for (const type of ['dragover', 'drop']) {
      document.body.dispatchEvent(new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }
  }, plain);
}
