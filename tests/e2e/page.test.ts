import { createServer } from 'node:http';
import type { AddressInfo } from 'node:net';
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { toGlb } from '../../web/tools/glb.mjs';
import { stool, stoolGltf } from './fixture';
import { openModel, openPage, outputFolder, useSite, withoutGallery } from './harness';

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
      .poll(() => page.locator('.status-line').getByRole('status').textContent())
      .toMatch(/could not be loaded .* Reload the page/);
    await context.close();
  });
});

describe('the theme', () => {
  const ground = (page: Page) => page.evaluate(() => getComputedStyle(document.documentElement).backgroundColor);
  const choose = async (page: Page, name: string) => {
    await page.getByRole('button', { name: 'View and help' }).click();
    await page.getByRole('menuitem', { name, exact: true }).click();
  };
  const light = 'rgb(243, 243, 240)';
  const dark = 'rgb(23, 24, 26)';

  it.each([
    ['light', light, 'Dark', dark],
    ['dark', dark, 'Light', light],
  ] as const)('of a system that is %s can be chosen otherwise, and back', async (colorScheme, before, name, after) => {
    const { page } = await openModel(site.browser, site.url, stool, { colorScheme });
    expect(await ground(page)).toBe(before);
    await choose(page, name);
    expect(await ground(page)).toBe(after);
    await page.screenshot({ path: `${outputFolder}/theme-${name}-on-${colorScheme}.png` });
    const [panel, text] = await page.evaluate(() => {
      const style = getComputedStyle(document.querySelector('.side') as Element);
      return [style.backgroundColor, style.color].map((colour) => Number(/[\d.]+/.exec(colour)?.[0]));
    });
    expect((panel as number) > (text as number)).toBe(name === 'Light');
    await page.reload();
    expect(await ground(page)).toBe(after);
    await page.locator('.part').first().waitFor();
    await choose(page, name === 'Dark' ? 'Light' : 'Dark');
    expect(await ground(page)).toBe(before);
    await page.context().close();
  });
});

describe('on a phone', () => {
  it('the sheet is folded and unfolded by its tabs, which stay in reach', async () => {
    const { page } = await openModel(site.browser, site.url, stool, {
      viewport: { width: 390, height: 844 },
      hasTouch: true,
    });
    const tab = page.locator('.tabs').getByRole('button', { name: 'Edits' });
    const hand = page.getByRole('button', { name: 'Edit by hand' });
    await hand.waitFor();
    await tab.tap();
    await hand.waitFor({ state: 'detached' });
    await page.screenshot({ path: `${outputFolder}/phone-folded.png` });
    await tab.tap(); // Playwright refuses when something lies over it
    await hand.waitFor();
    await page.screenshot({ path: `${outputFolder}/phone-unfolded.png` });
    await page.context().close();
  });
});

describe('names', () => {
  const long = 'a'.repeat(60);
  it.each([
    ['that are long words', long],
    ['of many words', 'the very long name of a part that somebody has written out in full'],
  ])('%s stay inside of what shows them', async (_, name) => {
    const model = toGlb(stoolGltf((old) => `${name} ${old}`));
    const { page } = await openModel(site.browser, site.url, model, { name: `${long}.glb` });
    await page.locator('.part .name').first().click();
    await page.getByLabel('What to change').fill(`${'b'.repeat(900)} `);
    await page.getByRole('button', { name: 'Edit by hand' }).click();
    await page.getByRole('button', { name: 'Mention' }).click();
    await page.locator('.mention button').first().waitFor();
    await page.screenshot({ path: `${outputFolder}/long-names-${name.length}.png` });
    const outside = await page.evaluate(() =>
      ['.side.left', '.side.right', '.composer', '.bar', '.dimensions'].flatMap((selector) => {
        const box = document.querySelector(selector)?.getBoundingClientRect();
        if (box === undefined) return [`${selector} is missing`];
        if (box.left < 0 || box.right > innerWidth) return [`${selector} is outside of the window`];
        const visible = (element: Element) =>
          element.getClientRects().length > 0 && !element.closest('.visually-hidden');
        return [...document.querySelectorAll(`${selector} :is(button, input, select, textarea, p, span, h2, h3)`)]
          .filter((element) => visible(element) && !element.matches('.name > *, .model-name, .mention > *'))
          .filter((element) => {
            const { left, right } = element.getBoundingClientRect();
            return left < box.left - 1 || right > box.right + 1;
          })
          .map((element) => `${selector} ${element.tagName} ${element.className} ${element.textContent?.slice(0, 20)}`);
      }),
    );
    expect(outside).toEqual([]);
    await page.context().close();
  });
});

describe('licences', () => {
  it('and the source are linked, and are there', async () => {
    const { page } = await openPage(site.browser, site.url, {}, withoutGallery);
    const address = (name: string) => page.locator('.foot').getByRole('link', { name }).getAttribute('href');
    const text = await page.request.get(new URL((await address('licences')) ?? '', site.url).href);
    expect(await text.text()).toMatch(/GNU GENERAL PUBLIC LICENSE.*CLN 1.*three\.js authors/s);
    const source = await page.request.get(new URL((await address('source')) ?? '', site.url).href);
    const bytes = await source.body();
    expect([...bytes.subarray(0, 2)]).toEqual([0x1f, 0x8b]); // gzip
    expect(bytes.length).toBeGreaterThan(500_000);
    await page.screenshot({ path: `${outputFolder}/footer.png` });
    await page.context().close();
  });
});

describe('inside a page of another site', () => {
  /** The page in the frame of another, and how to close both. */
  async function framed(search: string) {
    const outside = createServer((_request, response) =>
      response
        .writeHead(200, { 'Content-Type': 'text/html' })
        .end(`<iframe src="${site.url}${search}" width="900" height="600"></iframe>`),
    );
    await new Promise<void>((resolve) => outside.listen(0, '127.0.0.1', resolve));
    const page = await site.browser.newPage();
    await page.goto(`http://127.0.0.1:${(outside.address() as AddressInfo).port}/`);
    const close = async () => {
      await page.close();
      outside.close();
    };
    return { frame: page.frameLocator('iframe'), close };
  }

  it('the full page does not start, and says so', async () => {
    const { frame, close } = await framed('');
    expect(await frame.locator('.notice').textContent()).toMatch(/does not run inside another site/);
    expect(await frame.getByRole('link', { name: 'Open it by itself' }).getAttribute('href')).toBe(site.url);
    expect(await frame.locator('canvas').count()).toBe(0);
    await close();
  });

  it('the viewer does', async () => {
    const { frame, close } = await framed('?embed');
    await frame.locator('canvas').waitFor();
    await close();
  });

  it('of its own site it runs', async () => {
    const { page } = await openPage(site.browser, site.url, {}, withoutGallery);
    await page.evaluate((url) => {
      document.body.replaceChildren(Object.assign(document.createElement('iframe'), { src: url }));
    }, site.url);
    await page.frameLocator('iframe').locator('.bar').waitFor();
    await page.context().close();
  });
});
