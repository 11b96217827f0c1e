// What a language model suggests about CAD programs and about models without names, in the built page, from recordings: kinds
// that become variations, and names for parts.
import type { Page } from 'playwright-core';
import { beforeAll, describe, expect, it } from 'vitest';
import type { DebugHandle } from '../../web/src/ui/debug';
import { readRecordings, renderKinds } from '../../web/tools/prompts.mjs';
import { callerOf, loadWithCad } from '../web/module';
import { serious } from './axe';
import { openPage, useKey, useProviders, useSite, withoutGallery } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
const providers = useProviders();

async function open(button: RegExp, group: RegExp): Promise<{ page: Page; complaints: string[] }> {
  const { page, complaints } = await openPage(site.browser, `${site.url}?debug`, {}, withoutGallery);
  await page.waitForFunction(() => 'parsel' in globalThis && parsel.isReady());
  await page.locator('.bar .model').click();
  await page.getByRole('heading', { name: group }).waitFor();
  await page.getByRole('button', { name: button }).click();
  await page.waitForFunction(() => parsel.stage()?.isShown());
  return { page, complaints };
}

describe('suggested kinds', () => {
  let page: Page;
  let complaints: string[];
  const cards = () => page.getByRole('region', { name: 'Suggested kinds' }).locator('.kind');
  const variations = () => page.getByRole('region', { name: 'Variations' }).getByRole('listitem');
  beforeAll(async () => {
    ({ page, complaints } = await open(/^Bottle$/, /OpenSCAD programs/));
  });

  it('come in as six cards with pictures, without a key', async () => {
    await page.getByRole('button', { name: 'Suggest kinds' }).click();
    await expect.poll(() => cards().count()).toBe(6);
    await expect.poll(() => cards().locator('img').count()).toBe(6);
    await page.getByText('6 drawn · recorded answers').waitFor();
    expect(await cards().first().textContent()).toContain('answers name it');
    await page.getByText('Also named').click();
    await page.getByText('needs a key').waitFor();
    expect(await serious(page)).toEqual([]);
  });

  it('are kept one by one and all together, dropped, and undone', async () => {
    const before = await variations().count();
    const milk = cards().filter({ has: page.getByRole('heading', { name: 'milk bottle' }) });
    await milk.getByRole('button', { name: 'Keep' }).click();
    await expect.poll(() => variations().count()).toBe(before + 1);
    await page.getByRole('button', { name: 'Drop wine bottle' }).click();
    await expect.poll(() => cards().count()).toBe(4);
    await page.getByRole('button', { name: /^Keep all 4/ }).click();
    await expect.poll(() => cards().count()).toBe(0);
    await page.getByRole('button', { name: 'Undo: keep 4 kinds' }).click();
    await expect.poll(() => variations().count()).toBe(before + 1);
    await page.getByRole('button', { name: 'Drop all suggested kinds' }).click();
    expect(await page.getByRole('region', { name: 'Suggested kinds' }).count()).toBe(0);
    expect(complaints).toEqual([]);
  });
});

/** Answers come from a server that stands for a provider. */
async function askServer(page: Page): Promise<void> {
  await useKey(page, 'openai', providers.base('openai'), 3);
  await page.getByRole('button', { name: 'Done' }).click();
}

describe('with a key', () => {
  it('kinds stream in, can be stopped and tried again, and one of your own is drawn', async () => {
    const core = callerOf(await loadWithCad());
    const recordings = readRecordings();
    const known = renderKinds(core, recordings).flatMap(({ model, request, prompts: [prompt] }) => {
      const reply = prompt && recordings.get(prompt.hash)?.replies[0]?.text;
      return model === 'bottle_program' && prompt && reply ? [{ request, text: prompt.text, reply }] : [];
    });
    const numbers = known.find(({ request }) => request === 'milk bottle')?.reply ?? '';
    /** The wine bottle's numbers never come while it is slow. */
    const replay = (slow: boolean) =>
      providers.behave(({ prompt }) => {
        const found = known.find(({ text }) => prompt.startsWith(text));
        const after = slow && found?.request === 'wine bottle' ? 60_000 : 0;
        return { kind: 'reply', text: found?.reply ?? numbers, after };
      });

    const { page, complaints } = await open(/^Bottle$/, /OpenSCAD programs/);
    await askServer(page);
    replay(true);
    const panel = page.getByRole('region', { name: 'Suggested kinds' });
    await page.getByRole('button', { name: 'Suggest kinds' }).click();
    await panel.getByText('Asking what they measure, 5 of 6').waitFor();
    await panel.getByText('0 of 3 answers').waitFor();
    await panel.getByRole('button', { name: 'Cancel' }).click();
    await panel.getByText('Not drawn: it was stopped.').waitFor();
    replay(false);
    await panel.getByRole('button', { name: 'Try again' }).click();
    await panel.getByText('6 drawn').waitFor();
    await page.getByRole('textbox', { name: 'A kind to draw' }).fill('ink bottle');
    await page.keyboard.press('Enter');
    const own = panel.locator('.kind').filter({ has: page.getByRole('heading', { name: 'ink bottle' }) });
    await own.getByRole('button', { name: 'Keep' }).click();
    await page.getByRole('button', { name: 'Undo: keep “ink bottle”' }).waitFor();
    expect(complaints).toEqual([]);
  });

  it('a picture with numbers goes along when names are asked for; senseless answers are said to be', async () => {
    const { page, complaints } = await open(/^Floor lamp, nameless/, /Models without names/);
    await askServer(page);
    providers.behave(() => ({
      kind: 'reply',
      text: 'A lamp.\n```json\n{"category": "lamp", "front": "up", "parts": {}}\n```',
    }));
    await page.getByRole('button', { name: 'Suggest names for the parts' }).click();
    const panel = page.getByRole('region', { name: 'Suggested names' });
    await expect.poll(() => panel.getByRole('alert').textContent()).toMatch(/none of \+z, -z, \+x and -x/);
    const bodies = providers.calls.slice(-3).map(({ body }) => JSON.stringify(body));
    for (const body of bodies) expect(body).toContain('data:image/png;base64,iVBOR');
    expect(complaints).toEqual([]);
  });
});

describe('suggested names', () => {
  it('are a list to correct, and label all parts in one step that is undone', async () => {
    const { page, complaints } = await open(/^Desk with drawers, nameless/, /Models without names/);
    const labels = () =>
      page.evaluate(() =>
        parsel.document().model?.shape.parts.flatMap(({ virtual, label }) => (virtual ? [] : [label])),
      );
    const before = await labels();
    await page.getByRole('button', { name: 'Suggest names for the parts' }).click();
    await page.getByRole('heading', { name: 'Looks like: desk' }).waitFor();
    expect(await serious(page)).toEqual([]);
    const rows = page.getByRole('region', { name: 'Suggested names' }).getByRole('combobox');
    expect(await rows.count()).toBe(12);
    await rows.first().fill('worktop');
    await page.getByRole('button', { name: 'Use these names' }).click();
    await expect.poll(labels).toContain('worktop');
    expect((await labels())?.filter((label) => label === 'drawer')).toHaveLength(3);
    await page.getByRole('button', { name: 'Undo: name the parts' }).click();
    await expect.poll(labels).toEqual(before);
    expect(complaints).toEqual([]);
  });
});
