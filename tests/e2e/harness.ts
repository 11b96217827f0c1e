// A static server for web/dist under a sub-path, and Debian's Chromium. A page that violates its
// Content-Security-Policy, throws, or logs an error fails the test that opened it.
import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { type Browser, type BrowserContextOptions, chromium, type Page } from 'playwright-core';

const dist = fileURLToPath(new URL('../../web/dist', import.meta.url));
export const outputFolder = fileURLToPath(new URL('../output', import.meta.url));

const types: Record<string, string> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.mjs': 'text/javascript',
  '.css': 'text/css',
  '.svg': 'image/svg+xml',
  '.wasm': 'application/wasm',
  '.json': 'application/json',
  '.glb': 'model/gltf-binary',
};

/** Serves web/dist at /some/where/; answers with the page's address. */
export async function serve(): Promise<{ url: string; server: Server }> {
  if (!existsSync(join(dist, 'index.html'))) throw new Error('web/dist is not built: run ./web/start.sh --build-only');
  const base = '/some/where/';
  const server = createServer(async (request, response) => {
    const path = decodeURIComponent(new URL(request.url ?? '/', 'http://localhost').pathname);
    const relative = normalize(path.slice(base.length) || 'index.html');
    if (!path.startsWith(base) || relative.startsWith('..')) return response.writeHead(404).end();
    try {
      const bytes = await readFile(join(dist, relative));
      response.writeHead(200, { 'Content-Type': types[extname(relative)] ?? 'application/octet-stream' }).end(bytes);
    } catch {
      response.writeHead(404).end();
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

/** A page in a fresh profile, watched for violations of its policy, errors and unhandled rejections. */
export async function openPage(
  browser: Browser,
  url: string,
  options: BrowserContextOptions = {},
): Promise<WatchedPage> {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 }, ...options });
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
