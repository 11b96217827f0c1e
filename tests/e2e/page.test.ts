import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { openPage, useSite, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

describe('the page', () => {
  it('starts empty and says what to do when there is nothing to open', async () => {
    const { page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery);
    await page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
    expect(await page.locator('main').textContent()).toMatch(/Edits appear here/);
    expect(await page.locator('.bar .model').textContent()).toBe('Open a model');
    expect(complaints).toEqual([]);
  });

  it('would notice a violation of the policy', async () => {
    const { page, complaints } = await openPage(site.browser, site.url);
    await page.evaluate(() => fetch('https://example.org/').catch(() => null));
    await page.evaluate(() => {
      const script = document.createElement('script');
      script.textContent = 'window.injected = true';
      document.head.append(script);
    });
    await expect.poll(() => complaints.join('\n')).toMatch(/connect-src blocked https:\/\/example.org/);
    await expect.poll(() => complaints.join('\n')).toMatch(/script-src.* blocked inline/);
    expect(await page.evaluate(() => 'injected' in window)).toBe(false);
  });

  it.each([
    [
      'WebAssembly exceptions',
      () => {
        WebAssembly.validate = () => false;
      },
      /WebAssembly with exceptions/,
    ],
    [
      'WebGL 2',
      () => {
        const original = HTMLCanvasElement.prototype.getContext;
        HTMLCanvasElement.prototype.getContext = function (this: HTMLCanvasElement, kind: string) {
          return kind === 'webgl2' ? null : Reflect.apply(original, this, [kind]);
        } as typeof original;
      },
      /WebGL 2 is missing/,
    ],
  ])('says in a sentence that the browser lacks %s', async (_, breakIt, sentence) => {
    const context = await site.browser.newContext();
    await context.addInitScript(breakIt);
    const page = await context.newPage();
    await page.goto(site.url);
    expect(await page.locator('main').textContent()).toMatch(sentence);
    await context.close();
  });

  it('says so when the core cannot be loaded', async () => {
    const context = await site.browser.newContext();
    await context.route('**/*.wasm', (route) => route.abort());
    const page = await context.newPage();
    await page.goto(site.url);
    await expect
      .poll(() => page.getByRole('status').first().textContent())
      .toMatch(/could not be loaded .* Reload the page/);
    await context.close();
  });
});
