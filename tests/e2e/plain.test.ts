// Plain words without a key, and before a language model: read at once, shown, corrected, offered when not sure.
import type { Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { serious } from './axe';
import { stool } from './fixture';
import { openModel, outputFolder, saved, useKey, useProviders, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
const providers = useProviders();

const field = (page: Page) => page.getByLabel('What to change');
const composer = (page: Page) => page.getByLabel('Request in words');
const layers = (page: Page) => page.evaluate(() => parsel.document().layers.map(({ layer }) => layer.request));
const value = (page: Page) => page.evaluate(() => parsel.document().layers[0]?.value ?? Number.NaN);

async function say(page: Page, text: string) {
  await field(page).fill(text);
  await field(page).press('Enter');
}

/** Extent of the seat along an axis, in metres. */
const seat = (page: Page, axis: number) =>
  page.evaluate((along) => {
    const { shape } = parsel.document().model ?? {};
    const index = shape?.parts.findIndex(({ id }) => id === 'seat') ?? -1;
    const places = parsel
      .corners()
      .slice(24 * index, 24 * index + 24)
      .filter((_, i) => i % 3 === along);
    return (Math.max(...places) - Math.min(...places)) * (shape?.frame.scale ?? 1);
  }, axis);

describe('a model of one’s own, without a key', () => {
  it('follows a plain sentence at once, and says how it was read', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await say(page, 'make the seat wider');
    await composer(page).getByText('Understood:').waitFor();
    await composer(page).getByText('Read without a language model').waitFor();
    expect(await composer(page).textContent()).toMatch(/widen seat/);
    expect(await layers(page)).toEqual(['make the seat wider']);
    expect(await field(page).inputValue()).toBe('');
    await page.getByRole('button', { name: 'Undo: make the seat wider' }).click();
    expect(await layers(page)).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('puts the slider where a size says', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    const before = await seat(page, 0);
    await say(page, 'make the seat 3 cm wider');
    await composer(page).getByText('Understood:').waitFor();
    await expect.poll(() => value(page)).toBeGreaterThan(0);
    expect(await seat(page, 0)).toBeCloseTo(before + 0.03, 4);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('gives each of two changes a slider of its own, in the same step', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await say(page, 'make the seat wider and the legs longer');
    await composer(page).getByText('Understood:').waitFor();
    expect(await layers(page)).toHaveLength(1);
    await composer(page).getByText('2 changes by one slider').waitFor();
    await page.screenshot({ path: `${outputFolder}/changes_by_one_slider.png` });
    await composer(page).getByRole('button', { name: 'A slider for each' }).click();
    await expect.poll(() => layers(page)).toHaveLength(2);
    expect(new Set(await layers(page)).size).toBe(2);
    await expect.poll(() => composer(page).getByText('2 changes by one slider').count()).toBe(0);
    await page.screenshot({ path: `${outputFolder}/slider_for_each.png` });
    await page.getByRole('button', { name: /^Undo/ }).click();
    expect(await layers(page)).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('offers what may be meant, to be clicked', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await say(page, 'make the seat 10 wider');
    await composer(page)
      .getByText(/Not sure: it gives a number without a unit/)
      .waitFor();
    expect(await layers(page)).toEqual([]);
    expect(await field(page).inputValue()).toBe('make the seat 10 wider');
    await composer(page)
      .getByRole('button', { name: /^widen seat.*by 10 cm$/ })
      .click();
    await expect.poll(() => layers(page)).toEqual(['make the seat 10 wider']);
    await composer(page)
      .getByText(/Understood:/)
      .waitFor();
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('says what it does not understand, and what would', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await say(page, 'make it nicer');
    const alert = composer(page).getByRole('alert');
    await expect.poll(() => alert.textContent()).toMatch(/“nicer” is not understood.*enter a key/);
    expect(await field(page).inputValue()).toBe('make it nicer');
    expect(await layers(page)).toEqual([]);
    await alert.getByRole('button', { name: 'Settings' }).click();
    await page.getByRole('dialog', { name: 'Language model' }).waitFor();
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('means its own sides, or those of whoever looks; says which, and reads the other with a click', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    const moved = () =>
      page.evaluate(() =>
        parsel
          .document()
          .layers.map(({ layer, seen }) => [
            (layer.statements.find(({ why }) => why?.kind === 'seed') as { part: string }).part,
            seen,
          ]),
      );
    await field(page).fill('make the front left leg thicker');
    await composer(page).getByText('Left, right, front and back are the object’s own').waitFor();
    await field(page).press('Enter');
    await composer(page).getByText('Sides: the object’s own').waitFor();
    await expect.poll(moved).toEqual([['leg_front_left', undefined]]);

    await composer(page).getByRole('button', { name: 'Read it from where I look' }).click();
    await composer(page).getByText('as you look at its front; read as “make the front right leg thicker”').waitFor();
    await expect.poll(moved).toEqual([['leg_front_right', 'front']]);
    await composer(page).getByRole('button', { name: 'Read it with its own sides' }).click();
    await expect.poll(moved).toEqual([['leg_front_left', undefined]]);
    await page.getByRole('button', { name: 'Undo: make the front left leg thicker' }).click();
    expect(await moved()).toEqual([]);

    // The switch beside the compass counts for what is sent from then on, and is part of the work.
    const own = page.getByLabel('Sides of the model').getByRole('button', { name: 'From where I look' });
    await own.click();
    expect(await own.getAttribute('aria-pressed')).toBe('true');
    await page.getByRole('button', { name: 'Look from its left' }).click();
    await field(page).fill('make the front left leg thicker');
    await composer(page).getByText('Sides are yours, as you look at its left').waitFor();
    await page.screenshot({ path: `${outputFolder}/plain-sides.png` });
    expect(await serious(page)).toEqual([]);
    await field(page).press('Enter');
    // What is in front of me is its left, what is on my left its front.
    await expect.poll(moved).toEqual([['leg_front_left', 'left']]);
    await page.getByText('Its sides were said looking at its left').waitFor();
    await page.screenshot({ path: `${outputFolder}/plain-sides-read.png` });
    await saved(page);
    await page.reload();
    await page.waitForFunction(() => parsel.stage()?.isShown());
    expect(await moved()).toEqual([['leg_front_left', 'left']]);
    expect(await own.getAttribute('aria-pressed')).toBe('true');
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('can be corrected like any other reading', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await say(page, 'make the seat wider');
    await composer(page).getByText('Understood:').click();
    await composer(page).getByText('Correct the edit').click();
    await composer(page).locator('.seeds fieldset').first().getByRole('radio', { name: 'Grow' }).check({ force: true });
    await expect
      .poll(() => page.evaluate(() => parsel.document().layers[0]?.layer.statements[0]))
      .toMatchObject({ op: 'scale_3d', part: 'seat' });
    expect(await layers(page)).toEqual(['make the seat wider']);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe('with a key', () => {
  it('what is sure costs nothing, and a language model can be asked instead', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await useKey(page, 'openai', providers.base('openai'), 5);
    await page.getByRole('button', { name: 'Done' }).click();
    const answer = {
      edits: [{ op: 'translate', part: 'seat', direction: [0, 1, 0], amount: 'x' }],
      hints: {},
      keep: true,
    };
    providers.behave(({ body }) => {
      const task = /Reply to (\w+)/.exec(JSON.stringify(body))?.[1];
      const own =
        task === 'seed_edit' ? { edits: answer.edits } : task === 'type_hints' ? { hints: {} } : { keep: true };
      return { kind: 'reply', text: `\`\`\`json\n${JSON.stringify(own)}\n\`\`\`\n` };
    });
    await say(page, 'make the seat wider');
    await composer(page).getByText('Read without a language model').waitFor();
    expect(providers.calls).toEqual([]);
    await composer(page).getByRole('button', { name: 'Ask a language model instead' }).click();
    await expect
      .poll(() => page.evaluate(() => parsel.document().layers[0]?.layer.statements[0]?.op))
      .toBe('translate');
    expect(providers.calls.length).toBeGreaterThan(0);
    expect(await layers(page)).toEqual(['make the seat wider']);
    expect(await composer(page).getByText('Read without a language model').count()).toBe(0);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

describe.each([
  ['light', { width: 1440, height: 900 }],
  ['dark', { width: 1440, height: 900 }],
  ['light', { width: 390, height: 844 }],
  ['dark', { width: 820, height: 1180 }],
] as const)('in the %s, %o', (colorScheme, viewport) => {
  it('axe finds nothing serious when a request is read plainly, sure or not', async () => {
    const { page } = await openModel(site.browser, site.url, stool, { colorScheme, viewport });
    const found: string[] = [];
    const look = async (name: string) => {
      found.push(...(await serious(page)).map((text) => `${name}: ${text}`));
      await page.screenshot({ path: `${outputFolder}/plain-${name}-${colorScheme}-${viewport.width}.png` });
    };
    await say(page, 'make the seat 10 wider');
    await composer(page)
      .getByText(/Not sure/)
      .waitFor();
    await look('unsure');
    await say(page, 'make the seat wider');
    await composer(page).getByText('Understood:').waitFor();
    await look('sure');
    await say(page, 'make it nicer');
    await composer(page).getByRole('alert').waitFor();
    await look('not-understood');
    expect(found).toEqual([]);
    await page.context().close();
  });
});
