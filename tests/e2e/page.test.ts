import type { Server } from 'node:http';
import type { Browser } from 'playwright-core';
import { afterAll, beforeAll, describe, expect, it } from 'vitest';
import { launch, openPage, outputFolder, serve } from './harness';

let url: string;
let server: Server;
let browser: Browser;
beforeAll(async () => {
  ({ url, server } = await serve());
  browser = await launch();
});
afterAll(async () => {
  await browser?.close();
  server?.close();
});

describe('the page', () => {
  it('solves in the worker, evaluates in a closure and moves the scene, under its policy', async () => {
    const { page, complaints } = await openPage(browser, url);
    await page.getByTestId('solution').waitFor();
    expect(await page.getByRole('status').textContent()).toMatch(/core \d+\.\d+\.\d+, ready/);

    const shown = async () => Number.parseFloat((await page.getByTestId('angle').textContent()) ?? '');
    const slider = page.getByRole('slider');
    for (const x of [-0.35, 0, 0.2, 0.35]) {
      await slider.fill(String(x));
      expect(await shown()).toBeCloseTo((Math.acos(0.6 + x) * 180) / Math.PI, 1);
    }

    const canvas = page.locator('canvas');
    await slider.fill('-0.35');
    const steep = await canvas.screenshot();
    await slider.fill('0.35');
    const flat = await canvas.screenshot({ path: `${outputFolder}/page.png` });
    expect(steep.equals(flat)).toBe(false);
    await slider.focus();
    await page.keyboard.press('Home');
    expect(await slider.inputValue()).toBe('-0.35');
    expect(complaints).toEqual([]);
  });

  it('would notice a violation of the policy', async () => {
    const { page, complaints } = await openPage(browser, url);
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
    const context = await browser.newContext();
    await context.addInitScript(breakIt);
    const page = await context.newPage();
    await page.goto(url);
    expect(await page.locator('main').textContent()).toMatch(sentence);
    await context.close();
  });

  it('says so when the core cannot be loaded', async () => {
    const context = await browser.newContext();
    await context.route('**/*.wasm', (route) => route.abort());
    const page = await context.newPage();
    await page.goto(url);
    await expect.poll(() => page.getByRole('status').textContent()).toMatch(/could not be loaded .* Reload the page/);
    await context.close();
  });
});
