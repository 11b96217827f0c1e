// Pictures of models with numbers on their parts, as the page sends them with a prompt.
//
//   node tests/eval/numbered.mjs OUT MODEL.glb …       writes OUT/<model>.png; needs the built page and Chromium
//
// The page itself is opened, told to ask a language model that is this script, and asked to suggest sliders.
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { createRequire } from 'node:module';
import { basename, extname, join, normalize } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from '../../web/tools/core.mjs';

const [out, ...models] = process.argv.slice(2);
const dist = join(root, 'web', 'dist');
function die(line) {
  process.stderr.write(`${line}\n`);
  process.exit(2);
}
if (models.length === 0) die('usage: node tests/eval/numbered.mjs OUT MODEL.glb …');
if (!existsSync(join(dist, 'index.html'))) die('web/dist is not built: run ./web/start.sh --build-only');
const executablePath = ['chromium', 'google-chrome']
  .flatMap((name) => (process.env.PATH ?? '').split(':').map((folder) => join(folder, name)))
  .find(existsSync);
if (!executablePath) die('no Chromium on the PATH: apt-get install chromium');
const inWeb = createRequire(join(root, 'web', 'package.json'));
const { chromium } = (await import(pathToFileURL(inWeb.resolve('playwright-core')).href)).default;

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.svg': 'image/svg+xml' };
types['.wasm'] = 'application/wasm';
types['.json'] = 'application/json';

/** Called with the picture of whoever is asked next. */
let sent = () => {};
const server = createServer(async (request, response) => {
  const path = decodeURIComponent(new URL(request.url, 'http://localhost').pathname);
  if (request.method === 'POST') {
    const chunks = [];
    for await (const chunk of request) chunks.push(chunk);
    const [, picture] = /data:image\/png;base64,([^"]+)/.exec(Buffer.concat(chunks).toString()) ?? [];
    if (picture) sent(Buffer.from(picture, 'base64'));
    const message = { role: 'assistant', content: 'Nothing.\n```json\n{"requests": []}\n```' };
    const choices = [{ index: 0, message, finish_reason: 'stop' }];
    response.writeHead(200, { 'Content-Type': 'application/json' }).end(JSON.stringify({ choices }));
    return;
  }
  const file = join(dist, normalize(path === '/' ? '/index.html' : path));
  if (path === '/gallery/gallery.json') response.writeHead(200, { 'Content-Type': types['.json'] }).end('[]');
  else if (!existsSync(file)) response.writeHead(404).end();
  else response.writeHead(200, { 'Content-Type': types[extname(file)] ?? 'text/plain' }).end(readFileSync(file));
});
await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
const url = `http://127.0.0.1:${server.address().port}/`;
const args = ['--no-sandbox', '--no-first-run', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'];
const browser = await chromium.launch({ executablePath, headless: true, args });

mkdirSync(out, { recursive: true });
const page = await browser.newPage({ viewport: { width: 1440, height: 1200 }, reducedMotion: 'reduce' });
page.setDefaultTimeout(300_000); // drawing in software, the page may be slow
await page.goto(`${url}?debug`);
const shown = () => globalThis.parsel.document().model?.shape.sha256 ?? null;
for (const [i, model] of models.entries()) {
  const before = await page.evaluate(shown);
  await page.locator('.bar .model').click();
  const input = page.getByLabel('Open files');
  await input.and(page.locator(':enabled')).waitFor({ state: 'attached' });
  await input.setInputFiles({ name: 'model.glb', mimeType: 'model/gltf-binary', buffer: readFileSync(model) });
  await page.waitForFunction(
    (old) => globalThis.parsel.document().model?.shape.sha256 !== old && globalThis.parsel.stage()?.isShown(),
    before,
  );
  if (i === 0) {
    await page.getByRole('button', { name: /^Language model/ }).click();
    await page.getByLabel('Provider').selectOption('openai');
    await page.getByLabel('Base URL').fill(`${url}v1`);
    await page.getByLabel('Base URL').press('Tab');
    await page.getByLabel('Key', { exact: true }).fill('none');
    await page.getByLabel('Model', { exact: true }).fill('none');
    await page.getByLabel('Model', { exact: true }).press('Tab');
    await page.getByRole('button', { name: 'Done' }).click();
  }
  const picture = new Promise((resolve) => {
    sent = resolve;
  });
  await page.getByRole('button', { name: 'Suggest sliders' }).click();
  writeFileSync(join(out, `${basename(model, '.glb')}.png`), await picture);
  process.stdout.write(`${basename(model, '.glb')}.png\n`);
}
await browser.close();
server.close();
