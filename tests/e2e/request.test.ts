// From words to a moving slider: with replies that a test wrote in place of the recorded ones, and with a server that
// speaks the providers' protocols from another origin, under the page's policy.
import type { BrowserContextOptions, Page } from 'playwright-core';
import { describe, expect, it } from 'vitest';
import type { Protocol } from '../../web/src/llm/providers';
import type { Recordings } from '../../web/src/llm/recordings';
import type { Statement } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import type { Task } from '../../web/src/worker/protocol';
import { renderRequests } from '../../web/tools/prompts.mjs';
import { callerOf, loadModule } from '../web/module';
import type { Behaviour, ReceivedCall } from '../web/provider_server';
import { serious } from './axe';
import { stool } from './fixture';
import { openModel, openPage, outputFolder, pick, useKey, useProviders, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();
const providers = useProviders();

const reply = (answer: unknown) => `Somebody at a desk wrote this.\n\n\`\`\`json\n${JSON.stringify(answer)}\n\`\`\`\n`;
const widenSeat = {
  edits: [
    {
      op: 'scale_1d',
      part: 'seat',
      direction: [1, 0, 0],
      origin: { part: 'seat', at: [0, 0, 0] },
      amount: 'x',
    },
  ],
};
const raiseSeat = {
  edits: [{ op: 'translate', part: 'seat', direction: [0, 1, 0], amount: 'x' }],
};
const keep = { keep: true };
const noHints = { hints: {} };

const field = (page: Page) => page.getByLabel('What to change');
const composer = (page: Page) => page.getByLabel('Request in words');
const layers = (page: Page) => page.evaluate(() => parsel.document().layers.map(({ layer }) => layer.request));

describe('without a key', () => {
  /** recordings/chair.json as web/tools/recordings.mjs would write it, with replies by hand. */
  async function recordings(): Promise<Recordings> {
    const [rendered] = renderRequests(callerOf(await loadModule()), [
      { model: 'chair', request: 'widen the chair', mentioned: [] },
    ]);
    const answers: Record<Task, unknown> = {
      seed_edit: widenSeat,
      type_hints: noHints,
      relation_validity_reflection: keep,
      relation_validity_group: keep,
    };
    return {
      requests: [{ request: 'widen the chair', mentioned: [] }],
      replies: Object.fromEntries((rendered?.prompts ?? []).map(({ hash, task }) => [hash, [reply(answers[task])]])),
      models: ['a test'],
    };
  }

  async function openChair() {
    const recorded = await recordings();
    const watched = await openPage(site.browser, `${site.url}?debug`, {}, (context) =>
      context.route('**/recordings/chair.json', (route) => route.fulfill({ json: recorded })),
    );
    const { page } = watched;
    await page.waitForFunction(() => parsel.stage()?.isShown() && parsel.document().layers.length > 0);
    await page.locator('.bar .model').click();
    await page.getByRole('button', { name: 'Chair with back slats', exact: true }).click();
    // Without the edit that a first visit begins with.
    await page.waitForFunction(() => parsel.document().layers.length === 0 && parsel.stage()?.isShown());
    return watched;
  }

  it('a typed request becomes a slider that moves the chair', async () => {
    const { page, complaints } = await openChair();
    await page.getByRole('button', { name: 'widen the chair', exact: true }).first().waitFor();
    const width = () =>
      page.evaluate(() => {
        const parts = parsel.document().model?.shape.parts ?? [];
        const seat = parts.findIndex(({ id }) => id === 'seat');
        const xs = parsel
          .corners()
          .slice(24 * seat, 24 * seat + 24)
          .filter((_, i) => i % 3 === 0);
        return Math.max(...xs) - Math.min(...xs);
      });
    const before = await width();
    await field(page).fill('Widen the chair.');
    await field(page).press('Enter');
    await composer(page).getByText('Understood:').waitFor();
    expect(await composer(page).textContent()).toMatch(/seat/);
    await expect.poll(() => field(page).inputValue()).toBe('');
    await expect.poll(() => layers(page)).toEqual(['widen the chair']);
    const slider = page.getByRole('slider').first();
    await slider.fill(String(await slider.getAttribute('max')));
    await expect.poll(width).toBeGreaterThan(1.2 * before);
    await page.getByRole('button', { name: /^Undo/ }).click();
    await page.getByRole('button', { name: /^Undo/ }).click();
    expect(await layers(page)).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('a request that nobody understands keeps its text, and shows those that are recorded', async () => {
    const { page, complaints } = await openChair();
    await field(page).fill('make it fly');
    await page.getByRole('button', { name: 'Send' }).click();
    const alert = composer(page).getByRole('alert');
    await expect.poll(() => alert.textContent()).toMatch(/not understood.*enter a key/);
    expect(await field(page).inputValue()).toBe('make it fly');
    expect(await composer(page).getByRole('button', { name: 'widen the chair' }).count()).toBe(1);
    await alert.getByRole('button', { name: 'Settings' }).click();
    await page.getByRole('dialog', { name: 'Language model' }).waitFor();
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

/** Opens the stool and enters a provider as a person does. */
async function ready(protocol: Protocol, { votes = 3, ...options }: BrowserContextOptions & { votes?: number } = {}) {
  const watched = await openModel(site.browser, site.url, stool, options);
  const { page } = watched;
  await useKey(page, protocol, providers.base(protocol), votes);
  return watched;
}
const done = (page: Page) => page.getByRole('button', { name: 'Done' }).click();

const taskOf = ({ body }: ReceivedCall) => /Reply to (\w+)/.exec(JSON.stringify(body))?.[1] as Task;
/** @param seeds answers to the seed task, in the order of the calls */
function answering(
  seeds: readonly unknown[],
  others: (task: Task) => unknown = (task) => (task === 'type_hints' ? noHints : keep),
) {
  let next = 0;
  providers.behave((call): Behaviour => {
    const task = taskOf(call);
    const answer = task === 'seed_edit' ? seeds[next++ % seeds.length] : others(task);
    return { kind: 'reply', text: reply(answer) };
  });
}

/** What the language model shall read says more than what is read without one: “nicely” is for it alone. */
async function say(page: Page, text: string) {
  await field(page).fill(text);
  await field(page).press('Enter');
}

describe.each(['openai', 'anthropic', 'gemini'] as const)('%s from the page', (protocol) => {
  it('is tested and asked across origins, under the policy; the key stays in memory', async () => {
    const { page, complaints } = await ready(protocol);
    providers.behave(() => ({ kind: 'reply', text: 'ready' }));
    await page.getByRole('button', { name: 'Test this key' }).click();
    await page.getByText(/It answered in .* for 1,200 tokens/).waitFor();
    await page.getByRole('button', { name: 'List models' }).click();
    await page.getByText('1 model: choose it in the field above.').waitFor();
    await done(page);

    answering([widenSeat]);
    await field(page).fill('widen the stool nicely');
    await page.getByText(/answers, about .* thousand tokens to send/).waitFor();
    await field(page).press('Enter');
    await composer(page).getByText('Understood:').waitFor();
    expect(await layers(page)).toEqual(['widen the stool nicely']);
    expect(new Set(providers.calls.map(({ headers }) => JSON.stringify(headers).includes('sk-secret')))).toEqual(
      new Set([true]),
    );
    const kept = await page.evaluate(() => JSON.stringify([{ ...localStorage }, { ...sessionStorage }]));
    expect(kept).not.toContain('sk-secret');
    expect(kept).toContain('tester');

    // The same again is not paid for again.
    const before = providers.calls.length;
    await page.getByRole('button', { name: /^Undo/ }).click();
    await say(page, 'widen the stool nicely');
    await expect.poll(() => layers(page)).toEqual(['widen the stool nicely']);
    expect(providers.calls.length).toBe(before);
    expect(complaints).toEqual([]);
    await page.context().close();
  });
});

it('the settings name a model by default, say what is sent, to the letter, and what it has cost', async () => {
  const { page, complaints } = await openModel(site.browser, site.url, stool);
  await field(page).fill('widen the stool nicely');
  await page.getByRole('button', { name: /^Language model/ }).click();
  const dialog = page.getByRole('dialog', { name: 'Language model' });
  await dialog.getByLabel('Provider').selectOption('anthropic');
  const model = await dialog.getByLabel('Model', { exact: true }).getAttribute('placeholder');
  expect(model).toMatch(/^claude-/);
  await dialog.getByLabel('Base URL').fill(providers.base('anthropic'));
  await dialog.getByLabel('Base URL').press('Tab');
  await dialog.getByLabel('Key', { exact: true }).fill('sk-secret');
  await dialog.getByLabel('Answers to each question').fill('2');
  await dialog.getByText('Nothing was asked of a provider').waitFor();
  await dialog.getByText('What is sent').click();
  const question = dialog.getByLabel('First question to the letter');
  await expect.poll(() => question.inputValue()).toMatch(/widen the stool nicely/);
  const shown = await question.inputValue();
  expect(await serious(page)).toEqual([]);
  await page.screenshot({ path: `${outputFolder}/request-sent.png` });
  await done(page);

  answering([widenSeat]);
  await field(page).press('Enter');
  await composer(page).getByText('Understood:').waitFor();
  expect(new Set(providers.calls.map((call) => call.model))).toEqual(new Set([model]));
  // Held to a schema, the last lines about the form are put otherwise: see structuredPrompt().
  expect(providers.calls.some(({ prompt }) => prompt.includes(shown.slice(0, 2000)))).toBe(true);
  const answers = providers.calls.length;
  await page.getByRole('button', { name: /^Language model/ }).click();
  const line = dialog.getByRole('region', { name: 'Cost so far' }).getByRole('listitem');
  await expect
    .poll(() => line.textContent())
    .toBe(
      `Anthropic, ${model}: ${answers} answers · ${(1000 * answers).toLocaleString('en')} tokens sent, ` +
        `${(200 * answers).toLocaleString('en')} received`,
    );
  await dialog.getByText('Prices and kept answers').click();
  await dialog.getByLabel('Price in').fill('3');
  await dialog.getByLabel('Price out').fill('15');
  await dialog.getByLabel('Price out').press('Tab');
  await expect
    .poll(() => line.textContent())
    .toContain(`cost ${(answers * 0.006).toFixed(answers * 0.006 < 0.1 ? 4 : 2)}`);
  await page.screenshot({ path: `${outputFolder}/request-cost.png` });
  expect(complaints).toEqual([]);
  await page.context().close();
});

describe('what was understood', () => {
  it('can be another reading when the answers differ; nothing is applied before', async () => {
    const { page } = await ready('openai', { votes: 2 });
    await done(page);
    answering([widenSeat, raiseSeat]);
    await say(page, 'more seat');
    await composer(page).getByText('Which one did you mean?').waitFor();
    expect(await layers(page)).toEqual([]);
    expect(await field(page).inputValue()).toBe('more seat');
    const readings = composer(page).getByRole('group', { name: 'Readings' }).getByRole('radio');
    expect(await readings.count()).toBe(2);
    await readings.nth(1).check();
    await composer(page).getByRole('button', { name: 'Apply this' }).click();
    await expect.poll(() => layers(page)).toEqual(['more seat']);
    const ops = () => page.evaluate(() => parsel.document().layers[0]?.layer.statements.map(({ op }) => op));
    const applied = await ops();

    // Another reading takes the place of the first, and both together are one step back.
    await readings.nth(0).check();
    await expect
      .poll(async () => [await layers(page), JSON.stringify(await ops()) === JSON.stringify(applied)])
      .toEqual([['more seat'], false]);
    await page.getByRole('button', { name: 'Undo: more seat' }).click();
    expect(await layers(page)).toEqual([]);
    await page.context().close();
  });

  it('shows hints and relations, and each can be taken back', async () => {
    const { page } = await ready('anthropic');
    await done(page);
    answering([widenSeat], (task) =>
      task === 'type_hints' ? { hints: { leg_front_left: 'translate' } } : { keep: false },
    );
    await say(page, 'widen the seat nicely');
    await composer(page).getByText('Understood:').click();
    await composer(page).getByText('What other parts should do · 1').click();
    await composer(page).getByRole('button', { name: 'Forget front left leg' }).click();
    await composer(page).getByText('What other parts should do', { exact: true }).waitFor();
    const disabled = () =>
      page.evaluate(
        () => parsel.document().layers[0]?.layer.relations.filter(({ status }) => status === 'disabled').length,
      );
    await expect.poll(disabled).toBeGreaterThan(0);
    const boxes = composer(page).getByRole('checkbox');
    for (let i = 0; i < (await boxes.count()); i++) await boxes.nth(i).check();
    await expect.poll(disabled).toBe(0);
    expect(await layers(page)).toEqual(['widen the seat nicely']);
    await page.context().close();
  });

  it('is corrected field by field, each time in place of the layer before', async () => {
    const { page, complaints } = await ready('openai');
    await done(page);
    answering([
      {
        edits: [
          {
            op: 'translate',
            part: 'seat',
            direction: [0.6, 0.8, 0],
            amount: '-2*x',
          },
          ...widenSeat.edits,
        ],
      },
    ]);
    await say(page, 'change the seat');
    await composer(page).getByText('Understood:').click();
    await composer(page).getByText('Correct the 2 edits').click();
    const seeds = () =>
      page.evaluate(() =>
        parsel.document().layers[0]?.layer.statements.filter(({ why }) => why?.kind === 'seed'),
      ) as Promise<Statement[]>;
    const [first, second] = [0, 1].map((i) => composer(page).locator('.seeds fieldset').nth(i));
    expect(await first?.getByLabel('Direction').inputValue()).toBe('other'); // no axis of the list
    await first?.getByLabel('Direction').selectOption({ label: 'front–back' });
    await expect.poll(async () => (await seeds())[0]).toMatchObject({ op: 'translate', direction: [0, 0, 1] });
    expect((await seeds())[0]).toMatchObject({ amount: '-2*x1' }); // what was not touched stays
    await second?.getByRole('radio', { name: 'Grow' }).check({ force: true });
    await expect.poll(async () => (await seeds())[1]).toMatchObject({ op: 'scale_3d', part: 'seat', amount: 'x1' });
    await second?.getByLabel('Part to edit').selectOption('leg_front_left');
    await expect
      .poll(async () => (await seeds())[1])
      .toMatchObject({
        op: 'scale_3d',
        part: 'leg_front_left',
        origin: { part: 'leg_front_left', at: [0, 0, 0] },
      });
    expect(await layers(page)).toEqual(['change the seat']);
    await page.getByRole('button', { name: 'Undo: change the seat' }).click();
    expect(await layers(page)).toEqual([]);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('says why a request is unclear, as text, and keeps what was typed', async () => {
    const { page, complaints } = await ready('gemini');
    await done(page);
    answering([{ unclear: '<img src=x onerror=alert(1)> colour is not geometry' }]);
    await say(page, 'paint it red');
    await composer(page)
      .getByText(/unclear.*<img src=x.*colour is not geometry/)
      .waitFor();
    expect(await field(page).inputValue()).toBe('paint it red');
    expect(await composer(page).locator('img').count()).toBe(0);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('says so when no answer can be used, and asks anew the next time', async () => {
    const { page } = await ready('openai');
    await done(page);
    answering([
      {
        edits: [
          {
            op: 'translate',
            part: 'no such part',
            direction: [0, 1, 0],
            amount: 'x',
          },
        ],
      },
    ]);
    await say(page, 'raise it nicely');
    await composer(page)
      .getByText(/No answer could be used/)
      .waitFor();
    answering([raiseSeat]);
    await field(page).press('Enter');
    await expect.poll(() => layers(page)).toEqual(['raise it nicely']);
    await page.context().close();
  });
});

describe('what goes wrong', () => {
  it.each<[string, Behaviour, RegExp]>([
    [
      'a wrong key',
      { kind: 'status', status: 401, body: { error: { message: 'bad key' } } },
      /does not accept the key.*Check the key/,
    ],
    [
      'a wrong key behind a gateway without CORS',
      { kind: 'status', status: 401, body: {}, cors: false },
      /wrong key that way.*Check the key first/,
    ],
    ['a reply that is cut off', { kind: 'cut_off' }, /cut the reply off/],
    ['a reply that is no reply', { kind: 'raw', body: '<html>' }, /cannot read/],
  ])('%s is said beside the request, which stays', async (_, behaviour, sentence) => {
    const { page } = await ready('openai');
    await done(page);
    providers.behave(() => behaviour);
    await say(page, 'widen the stool nicely');
    await expect.poll(() => composer(page).getByRole('alert').textContent()).toMatch(sentence);
    if (behaviour.kind === 'status') expect(providers.calls).toHaveLength(1);
    expect(await field(page).inputValue()).toBe('widen the stool nicely');
    expect(await layers(page)).toEqual([]);
    await page.context().close();
  });

  it('a missing key and an address that the policy forbids are said before anything is sent', async () => {
    const { page, complaints } = await openModel(site.browser, site.url, stool);
    await page.getByRole('button', { name: /^Language model/ }).click();
    await page.getByLabel('Provider').selectOption('openai');
    await page.getByLabel('Model', { exact: true }).fill('m');
    await page.getByLabel('Base URL').fill('https://gateway.example/v1');
    await page.getByLabel('Base URL').press('Tab');
    await page.getByText(/may only talk to the listed providers/).waitFor();
    await done(page);
    await say(page, 'widen nicely');
    await expect
      .poll(() => composer(page).getByRole('alert').textContent())
      .toMatch(/not an address that this page may talk to/);
    await composer(page).getByRole('button', { name: 'Settings' }).click();
    await page.getByLabel('Base URL').fill('');
    await page.getByLabel('Base URL').press('Tab');
    await done(page);
    await field(page).press('Enter');
    await expect.poll(() => composer(page).getByRole('alert').textContent()).toMatch(/OpenAI wants a key/);
    expect(complaints).toEqual([]);
    await page.context().close();
  });

  it('Escape cancels; what was typed and the mentioned part stay', async () => {
    const { page } = await ready('openai');
    await done(page);
    providers.behave(() => ({
      kind: 'reply',
      text: reply(widenSeat),
      after: 60_000,
    }));
    await field(page).fill('widen it nicely');
    await page.locator('.part').filter({ hasText: 'seat' }).first().locator('.name').click();
    await page.getByRole('button', { name: 'Do not mention seat' }).waitFor();
    await field(page).press('Enter');
    await composer(page)
      .getByText(/Reading the request, 0 of \d+ answers/)
      .waitFor();
    await field(page).press('Escape');
    await expect.poll(() => composer(page).getByText('Reading the request').count()).toBe(0);
    expect(await field(page).inputValue()).toBe('widen it nicely');
    expect(await page.getByRole('button', { name: 'Do not mention seat' }).count()).toBe(1);
    await page.context().close();
  });

  it('is forgotten with the model that it was about; what was typed stays', async () => {
    const { page } = await ready('openai');
    await done(page);
    answering([{ unclear: 'colour is not geometry' }]);
    await say(page, 'paint it red');
    await composer(page)
      .getByText(/unclear/)
      .waitFor();
    await pick(page, [{ name: 'second.glb', mimeType: 'model/gltf-binary', buffer: stool }]);
    await expect.poll(() => page.evaluate(() => parsel.document().model?.files.name)).toBe('second');
    expect(
      await composer(page)
        .getByText(/unclear/)
        .count(),
    ).toBe(0);
    expect(await field(page).inputValue()).toBe('paint it red');
    await page.context().close();
  });

  it('Shift+Enter makes a line, Enter alone in an empty field does nothing', async () => {
    const { page } = await openModel(site.browser, site.url, stool);
    await field(page).press('Enter');
    await field(page).pressSequentially('a');
    await field(page).press('Shift+Enter');
    await field(page).pressSequentially('b');
    expect(await field(page).inputValue()).toBe('a\nb');
    await page.context().close();
  });
});

describe.each([
  ['light', { width: 1440, height: 900 }],
  ['dark', { width: 1440, height: 900 }],
  ['light', { width: 390, height: 844 }],
  ['dark', { width: 390, height: 844 }],
] as const)('in the %s, %o', (colorScheme, viewport) => {
  it('axe finds nothing serious in any state', async () => {
    const { page } = await ready('openai', { colorScheme, viewport, votes: 2 });
    const found: string[] = [];
    const look = async (name: string) => {
      found.push(...(await serious(page)).map((text) => `${name}: ${text}`));
      await page.screenshot({
        path: `${outputFolder}/request-${name}-${colorScheme}-${viewport.width}.png`,
      });
    };
    await look('settings');
    await done(page);
    await look('empty');
    await field(page).fill('widen the stool nicely, but leave the legs where they are');
    await page.getByText(/thousand tokens to send/).waitFor();
    await look('typing');
    providers.behave(() => ({
      kind: 'reply',
      text: reply(widenSeat),
      after: 60_000,
    }));
    await field(page).press('Enter');
    await composer(page)
      .getByText(/Reading the request, 0 of/)
      .waitFor();
    await look('working');
    await field(page).press('Escape');
    answering([widenSeat], (task) =>
      task === 'type_hints' ? { hints: { slat_group: 'change_delta' } } : { keep: false },
    );
    await field(page).press('Enter');
    await composer(page).getByText('Understood:').waitFor();
    await look('understood');
    await composer(page).getByText('Understood:').click();
    await look('corrections');
    answering([widenSeat, raiseSeat]);
    await say(page, 'more seat');
    await composer(page).getByText('Which one did you mean?').waitFor();
    await look('split');
    answering([{ unclear: 'the request is about colour' }]);
    await say(page, 'paint it');
    await composer(page)
      .getByText(/unclear/)
      .waitFor();
    await look('unclear');
    providers.behave(() => ({
      kind: 'status',
      status: 401,
      body: {},
      cors: false,
    }));
    await say(page, 'raise the back nicely');
    await expect.poll(() => composer(page).getByRole('alert').textContent()).toMatch(/wrong key/);
    await look('error');
    expect(found).toEqual([]);
    await page.context().close();
  });
});
