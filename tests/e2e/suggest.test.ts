// One click to a parametric model: suggested sliders of the gallery chair, from recordings and from a server that replays
// them as a language model would; siblings; other readings of a request.
import type { BrowserContextOptions, Page } from 'playwright-core';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { readProposals, readRecordings, renderProposals } from '../../web/tools/prompts.mjs';
import { call, loadModule } from '../web/module';
import { serious } from './axe';
import { stool } from './fixture';
import { openModel, openPage, outputFolder, useKey, useProviders, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
const providers = useProviders();

const panel = (page: Page) => page.getByRole('region', { name: 'Suggested sliders' });
const cards = (page: Page) => panel(page).locator('.proposal');
const sliders = (page: Page) => panel(page).getByRole('slider');
const layers = (page: Page) => page.evaluate(() => parsel.document().layers.map(({ layer }) => layer.request));
const values = (page: Page) => page.evaluate(() => parsel.document().layers.map(({ value }) => value));
const corners = (page: Page) => page.evaluate(() => parsel.corners());
const suggest = (page: Page) => page.getByRole('button', { name: 'Suggest sliders' }).click();
const finished = (page: Page) =>
  panel(page)
    .getByText(/\d of \d are clean/)
    .waitFor();

/** The gallery chair without edits. */
async function openChair(options: BrowserContextOptions = {}) {
  const watched = await openPage(site.browser, `${site.url}?debug`, options);
  const { page } = watched;
  await page.waitForFunction(() => parsel.stage()?.isShown() && parsel.document().layers.length > 0);
  await page.getByRole('button', { name: /^Undo/ }).click();
  await page.waitForFunction(() => parsel.document().layers.length === 0);
  return watched;
}

describe('without a key', () => {
  it('one click makes six sliders of the chair, each moving, and one step keeps those that are clean', async () => {
    const start = Date.now();
    const { page, complaints } = await openChair();
    const opening = Date.now() - start;
    const begin = Date.now();
    await suggest(page);
    await expect.poll(() => sliders(page).count()).toBe(6);
    // Ten seconds is the promise. A busy machine that draws in software is slow in everything: it is held against opening.
    expect(Date.now() - begin).toBeLessThan(Math.max(10_000, 3 * opening));
    await finished(page);
    await expect.poll(() => panel(page).locator('.strip img').count()).toBe(18);
    const rest = await corners(page);
    for (const slider of await sliders(page).all()) {
      await slider.fill(String(await slider.getAttribute('max')));
      expect(await corners(page)).not.toEqual(rest);
      expect(await layers(page)).toEqual([]);
    }
    const clean = Number(
      await panel(page)
        .getByRole('button', { name: /^Keep all \d/ })
        .textContent()
        .then((text) => text?.match(/\d+/)?.[0]),
    );
    const unclean = await panel(page).locator('.unclean').count();
    expect(clean + unclean).toBe(6);
    await panel(page)
      .getByRole('button', { name: /^Keep all \d/ })
      .click();
    await expect.poll(async () => (await layers(page)).length).toBe(clean);
    expect(await cards(page).count()).toBe(unclean);
    await page.getByRole('button', { name: `Undo: keep ${clean} suggested sliders` }).click();
    expect(await layers(page)).toEqual([]);
    expect(await cards(page).count()).toBe(6);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('cards are renamed, arranged, dropped and kept by keyboard', async () => {
    const { page } = await openChair();
    await page.getByRole('button', { name: 'Suggest sliders' }).focus();
    await page.keyboard.press('Enter');
    await finished(page);
    const names = () => cards(page).evaluateAll((all) => all.map((card) => card.getAttribute('aria-label') ?? ''));
    const [first = '', second = '', ...others] = await names();
    const menu = (name: string) => page.getByRole('button', { name: `More about the suggestion ${name}` });
    const choose = async (name: string, item: string) => {
      await menu(name).focus();
      await page.keyboard.press('Enter');
      await page.getByRole('menuitem', { name: item }).focus();
      await page.keyboard.press('Enter');
    };
    await choose(first, 'Move down');
    expect(await names()).toEqual([second, first, ...others]);
    await choose(first, 'Rename');
    await page.keyboard.press('ControlOrMeta+a');
    await page.keyboard.type('My slider');
    await page.keyboard.press('Enter');
    await choose(second, 'Drop');
    expect(await names()).toEqual(['My slider', ...others]);
    const rest = await corners(page);
    await page.getByLabel('My slider: amount').focus();
    await page.keyboard.press('Shift+ArrowRight');
    expect(await corners(page)).not.toEqual(rest);
    await cards(page).first().getByRole('button', { name: /^Keep/ }).focus();
    await page.keyboard.press('Enter');
    expect(await layers(page)).toEqual(['My slider']);
    expect((await values(page))[0]).not.toBe(0);
    await page.context().close();
  });

  it('says that there is nothing recorded for a model of one’s own', async () => {
    const { page } = await openModel(site.browser, site.url, stool);
    await suggest(page);
    await expect.poll(() => panel(page).getByRole('alert').textContent()).toMatch(/for gallery models only/);
    await page.context().close();
  });
});

describe('with a language model', () => {
  /** Texts of prompts with their recorded replies. */
  let recorded: readonly { readonly text: string; readonly task: string; readonly reply: string }[];
  beforeAll(async () => {
    const module = await loadModule();
    const recordings = readRecordings();
    const chair = readProposals().filter(({ model, task }) => model === 'chair' && task === 'procedural_requests');
    const rendered = renderProposals(
      (method, parameters, buffers) => call(module, method, parameters, buffers),
      chair,
      recordings,
    );
    recorded = rendered.flatMap(({ prompts }) =>
      prompts.map(({ text, task, hash }) => ({ text, task, reply: recordings.get(hash)?.replies[0]?.text ?? '' })),
    );
  });

  /** Replays the recordings, each reply after so many milliseconds. */
  function replay(delay: (task: string, number: number) => number): void {
    let number = 0;
    providers.behave((received) => {
      const found = recorded.find(({ text }) => received.prompt.startsWith(text));
      if (found === undefined) return { kind: 'status', status: 500, body: {} };
      return { kind: 'reply', text: found.reply, after: delay(found.task, number++) };
    });
  }

  async function ready() {
    const watched = await openChair();
    const { page } = watched;
    await useKey(page, 'openai', providers.base('openai'), 1);
    await page.getByRole('button', { name: 'Done' }).click();
    return watched;
  }

  it('a picture of the numbered parts goes along, and the first slider is there before the last reply', async () => {
    const { page, complaints } = await ready();
    replay((task, number) => (task === 'procedural_requests' ? 1500 : 800 + 400 * number));
    await suggest(page);
    await panel(page).getByText('Asking what could vary').waitFor();
    await sliders(page).first().waitFor();
    const answered = providers.calls.length;
    await finished(page);
    expect(providers.calls.length).toBeGreaterThan(answered);
    const messages = providers.calls.map(({ body }) => (body['messages'] as { content: unknown }[])[0]?.content);
    const pictures = messages.filter((content) => JSON.stringify(content).includes('data:image/png;base64,iVBOR'));
    expect(pictures).toHaveLength(1);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('cancel keeps what is finished; the others say so and can be read later', async () => {
    const { page } = await ready();
    let seeds = 0;
    replay((task) => (task === 'procedural_requests' ? 0 : task === 'seed_edit' && seeds++ > 0 ? 60_000 : 0));
    await suggest(page);
    await sliders(page).first().waitFor();
    await panel(page).getByRole('button', { name: 'Cancel' }).click();
    await panel(page).getByText('Not read: it was stopped.').first().waitFor();
    expect(await sliders(page).count()).toBe(1);
    replay(() => 0);
    await panel(page).getByRole('button', { name: 'Read it' }).first().click();
    await expect.poll(() => sliders(page).count()).toBe(2);
    await page.context().close();
  });

  it('one that cannot see is asked without a picture', async () => {
    const { page } = await ready();
    const withPicture = (body: unknown) => JSON.stringify(body).includes('image_url');
    let blind = 0;
    providers.behave(({ body, prompt }) => {
      if (withPicture(body)) {
        blind++;
        return { kind: 'status', status: 400, body: { error: { message: 'image_url is not supported' } } };
      }
      if (!prompt.includes('How many requests to propose')) return { kind: 'status', status: 500, body: {} };
      expect(prompt).not.toContain('The picture shows');
      return { kind: 'reply', text: 'Nothing.\n```json\n{"requests": []}\n```' };
    });
    await suggest(page);
    await expect.poll(() => panel(page).getByRole('alert').textContent()).toMatch(/it proposes nothing/);
    expect(blind).toBeGreaterThan(0);
    await page.context().close();
  });
});

describe('siblings', () => {
  async function withSliders() {
    const watched = await openChair();
    await suggest(watched.page);
    await finished(watched.page);
    await panel(watched.page)
      .getByRole('button', { name: /^Keep all \d/ })
      .click();
    return watched;
  }

  it('“Surprise me” puts all sliders in one step, “Explore” offers nine to click', async () => {
    const { page, complaints } = await withSliders();
    const before = await values(page);
    expect(before.every((value) => value === 0)).toBe(true);
    await page.getByRole('button', { name: 'Surprise me' }).click();
    await expect.poll(() => values(page)).not.toEqual(before);
    await page.getByRole('button', { name: 'Undo: surprise me' }).click();
    expect(await values(page)).toEqual(before);
    await page.getByRole('button', { name: 'Explore' }).click();
    const dialog = page.getByRole('dialog', { name: 'Siblings' });
    const siblings = dialog.getByRole('button', { name: /^Sibling \d/ });
    await expect.poll(() => siblings.count()).toBe(9);
    const pictures = () =>
      dialog.locator('img').evaluateAll((all) => all.map((image) => (image as HTMLImageElement).src));
    const first = await pictures();
    expect(new Set(first).size).toBe(9);
    await dialog.getByRole('button', { name: 'Nine others' }).click();
    await expect.poll(pictures).not.toEqual(first);
    await siblings.nth(4).click();
    await expect.poll(() => dialog.count()).toBe(0);
    expect(await values(page)).not.toEqual(before);
    await page.getByRole('button', { name: 'Undo: take a sibling' }).click();
    expect(await values(page)).toEqual(before);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('other readings', () => {
  it('stand side by side, and one takes the place of the layer', async () => {
    const { page, complaints } = await openChair({ reducedMotion: 'reduce' });
    await page.getByLabel('What to change').fill('widen the chair');
    await page.getByLabel('What to change').press('Enter');
    await expect.poll(() => layers(page)).toEqual(['widen the chair']);
    const doing = () => page.evaluate(() => JSON.stringify(parsel.document().layers[0]?.layer.statements));
    const before = await doing();
    await page.getByRole('button', { name: 'More about widen the chair' }).click();
    await page.getByRole('menuitem', { name: 'Other readings' }).click();
    const dialog = page.getByRole('dialog', { name: /^Other readings/ });
    const take = dialog.getByRole('button', { name: 'Take this' });
    await take.first().waitFor();
    await page.screenshot({ path: `${outputFolder}/suggest-readings.png` });
    expect(await serious(page)).toEqual([]);
    await dialog.getByLabel('How far, in all readings').fill('-1');
    await take.last().click();
    await expect.poll(() => dialog.count()).toBe(0);
    expect(await doing()).not.toBe(before);
    expect(await layers(page)).not.toEqual(['widen the chair']);
    await page.getByRole('button', { name: /^Undo: read it as/ }).click();
    expect(await doing()).toBe(before);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe.each([
  ['light', { width: 1440, height: 900 }],
  ['dark', { width: 390, height: 844 }],
] as const)('in the %s, %o', (colorScheme, viewport) => {
  it('axe finds nothing serious', async () => {
    const { page } = await openChair({ colorScheme, viewport, reducedMotion: 'reduce' });
    const found: string[] = [];
    const look = async (name: string) => {
      await page.screenshot({ path: `${outputFolder}/suggest-${name}-${colorScheme}-${viewport.width}.png` });
      found.push(...(await serious(page)).map((text) => `${name}: ${text}`));
    };
    await suggest(page);
    await finished(page);
    await expect.poll(() => panel(page).locator('.strip img').count()).toBe(18);
    await look('cards');
    await panel(page)
      .getByRole('button', { name: /^Keep all \d/ })
      .click();
    await page.getByRole('button', { name: 'Explore' }).click();
    await expect.poll(() => page.getByRole('button', { name: /^Sibling \d/ }).count()).toBe(9);
    await look('explore');
    expect(found).toEqual([]);
    await page.context().close();
  });
});
