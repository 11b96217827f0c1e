// The work of a person: sliders by hand and by keyboard, edits by hand, undo and redo, what a reload and a dead worker
// leave.
import type { Page } from 'playwright-core';
import { beforeEach, describe, expect, it } from 'vitest';
import type { Layer, Shape, Statement } from '../../web/src/program/types';
import type { DebugHandle } from '../../web/src/ui/debug';
import { program, stool } from './fixture';
import { addEdits, openInstead, saved, useSite } from './harness';

declare const parsel: DebugHandle;

const site = useSite();

let page: Page;
let complaints: string[];
let shape: Shape;
beforeEach(async () => {
  ({ page, complaints, shape } = await openInstead(page, site, stool));
  await addEdits(page, program(shape));
});

/** Everything that undo covers, as text. */
const state = () =>
  page.evaluate(() => {
    const { layers, hidden, names, model } = parsel.document();
    const plain = layers.map(({ layer, enabled, value }) => ({ layer, enabled, value }));
    return JSON.stringify({ plain, hidden: [...hidden], names: [...names], model: model?.shape.name });
  });
const seatWidth = () => page.getByLabel('seat width, type a value');

describe('a slider', () => {
  it('moves the shape, shows the length it changes, and takes typed lengths', async () => {
    const slider = page.getByRole('slider').first();
    expect(await seatWidth().inputValue()).toBe('50 cm');
    await slider.fill('0.5');
    expect(await seatWidth().inputValue()).toBe('75 cm');
    expect(await page.getByLabel('width, type a length', { exact: true }).inputValue()).toBe('75');
    await seatWidth().fill('60');
    await seatWidth().press('Enter');
    expect(Number(await slider.inputValue())).toBeCloseTo(0.2, 6);
    await seatWidth().fill('0.4 m');
    await seatWidth().press('Enter');
    expect(Number(await slider.inputValue())).toBeCloseTo(-0.2, 6);
    await seatWidth().fill('wide');
    await seatWidth().press('Enter');
    expect(await seatWidth().getAttribute('aria-invalid')).toBe('true');
    await page.getByText('Type a number, such as 40 cm.').waitFor();
    await seatWidth().fill('999');
    await seatWidth().press('Enter');
    await page.getByText('The slider goes no further.').waitFor();
    expect(await seatWidth().inputValue()).toBe('300 cm'); // six times as wide: amounts reach no further
    expect(Number(await slider.getAttribute('max'))).toBeCloseTo(5, 3);
    expect(complaints).toEqual([]);
  });

  it('tells moves and turns with their sign, and not what other edits do', async () => {
    const [edits] = [program(shape)];
    const layerOf = (request: string, name: string, statements: Statement[]) => ({
      ...(edits.layers[0] as Layer),
      request,
      parameter: { name, min: -0.35, max: 0.35, value: 0 },
      statements,
      relations: [],
    });
    const origin = [0, 0, 0] as const;
    await addEdits(page, {
      ...edits,
      layers: [
        layerOf('lift', 'y1', [
          { op: 'translate', part: 'seat', feature: [0, 0, 0], direction: [0, 1, 0], amount: 'y1' },
        ]),
        layerOf('tilt', 'y2', [
          { op: 'rotate', part: 'seat', feature: [0, 0, 0], origin, axis: [1, 0, 0], amount: 'y2' },
        ]),
      ],
    });
    const cards = page.locator('.card');
    const slider = (i: number) => cards.nth(i).getByRole('slider');
    await slider(3).fill('0.35');
    await slider(4).fill('-0.35');
    const turned = page.getByLabel('seat turned, type a value');
    expect(await turned.inputValue()).toBe('−20.1°');
    expect(await slider(4).getAttribute('aria-valuetext')).toBe('seat turned 0° to −20.1°');
    await turned.fill('10');
    await turned.press('Enter');
    expect(Number(await slider(4).inputValue())).toBeCloseTo(Math.PI / 18, 4);
    await turned.fill('-5');
    await turned.press('Enter');
    expect(Number(await slider(4).inputValue())).toBeCloseTo(-Math.PI / 36, 4);
    // The lift is told apart from the turn that follows it, and from the seat's width.
    await slider(4).fill('0');
    const lifted = await page.getByLabel('seat moved, type a value').inputValue();
    await slider(0).fill('0.4');
    expect(await page.getByLabel('seat moved, type a value').inputValue()).toBe(lifted);
    await slider(3).fill('-0.35');
    expect(await page.getByLabel('seat moved, type a value').inputValue()).toBe(`−${lifted}`);
    expect(complaints).toEqual([]);
  });

  it('obeys the keyboard and resets on a double click', async () => {
    const slider = page.getByRole('slider').first();
    const value = async () => Number(await slider.inputValue());
    await slider.focus();
    await page.keyboard.press('ArrowRight');
    expect(await value()).toBeCloseTo(0.005, 9);
    await page.keyboard.press('Shift+ArrowRight');
    expect(await value()).toBeCloseTo(0.055, 9);
    await page.keyboard.press('Alt+ArrowLeft');
    expect(await value()).toBeCloseTo(0.0545, 9);
    await page.keyboard.press('Home');
    expect(await value()).toBe(-0.5);
    await page.keyboard.press('End');
    expect(await value()).toBe(0.5);
    expect(await slider.getAttribute('aria-valuetext')).toBe('seat width 50 cm to 75 cm');
    await slider.dblclick({ position: { x: 40, y: 14 } });
    expect(await value()).toBe(0);
  });

  it('is played and comes back', async () => {
    const slider = page.getByRole('slider').first();
    await page.getByRole('button', { name: 'Animate Widen the seat' }).click();
    await expect.poll(async () => Math.abs(Number(await slider.inputValue()))).toBeGreaterThan(0.2);
    await page.getByRole('button', { name: 'Stop Widen the seat' }).click();
    expect(Number(await slider.inputValue())).toBe(0);
  });
});

describe('undo and redo', () => {
  it('go over ten mixed actions and back', async () => {
    const card = (i: number) => page.locator('.card').nth(i);
    const command = async (i: number, name: string) => {
      await card(i).getByRole('button', { name: 'More about' }).click();
      await page.getByRole('menuitem', { name }).click();
    };
    const part = (name: string) => page.locator('.part').filter({ hasText: name }).first();
    const actions: (() => Promise<unknown>)[] = [
      () => card(0).getByRole('slider').fill('0.3'),
      () => card(1).getByRole('slider').fill('-0.2'),
      () => command(1, 'Switch off'),
      () => command(0, 'Move down'),
      async () => {
        await command(0, 'Rename');
        await page.getByLabel('Name of the edit').fill('something else');
        await page.keyboard.press('Enter');
      },
      async () => {
        await part('seat').hover();
        await part('seat').getByRole('button', { name: 'Hide' }).click();
      },
      async () => {
        await part('seat').locator('.name').dblclick();
        await page.getByLabel('New name of seat').fill('<img src=x onerror=alert(1)>');
        await page.keyboard.press('Enter');
      },
      () => card(2).getByRole('slider').fill('7.4'),
      () => command(0, 'Remove'),
      () => page.getByRole('button', { name: 'Show the hidden one' }).click(),
    ];
    const states = [await state()];
    for (const act of actions) {
      await act();
      states.push(await state());
    }
    expect(new Set(states).size).toBe(11);
    expect(await page.locator('.part').first().textContent()).toContain('<img'); // text, not markup
    for (let i = 9; i >= 0; i--) {
      await page.keyboard.press('Control+z');
      expect(await state()).toBe(states[i]);
    }
    for (let i = 1; i <= 10; i++) {
      await page.keyboard.press('Control+Shift+z');
      expect(await state()).toBe(states[i]);
    }
    expect(complaints).toEqual([]);
  });
});

describe('the work', () => {
  it('is there again after a reload', async () => {
    await page.getByRole('slider').first().fill('0.31');
    const content = () =>
      page.evaluate(() =>
        parsel.document().layers.map(({ layer: { request, statements, parameter }, value }) => ({
          request,
          statements,
          name: parameter.name,
          value,
        })),
      );
    const before = await content();
    const corners = await page.evaluate(() => parsel.corners());
    await saved(page);
    await page.reload();
    await page.locator('.card').nth(2).waitFor();
    expect(await content()).toEqual(before);
    expect(await page.evaluate(() => parsel.corners())).toEqual(corners);
  });

  it('outlives the worker, which has the model again', async () => {
    const before = await state();
    await page.evaluate(() =>
      parsel
        .client()
        .call('fail', { kind: 'abort' })
        .catch(() => null),
    );
    expect(await state()).toBe(before);
    const respawned = await page.evaluate(() => parsel.client().respawns);
    expect(respawned).toBe(1);
    const { version } = await page.evaluate(async () => (await parsel.client().call('version', {})).result);
    expect(version).toMatch(/^\d/);
  });
});

describe('an edit by hand', () => {
  it('hands the core the part, feature, operator and relations that were chosen, and shows the layer', async () => {
    const [edits] = [program(shape)];
    await page.evaluate((answer) => {
      const seen: unknown[] = [];
      Object.assign(globalThis, { seen });
      const client = parsel.client();
      const asked = client.call.bind(client) as (...all: unknown[]) => Promise<unknown>;
      const answered = async (method: string, parameters: object, ...rest: unknown[]) => {
        if (method !== 'propagate') return asked(method, parameters, ...rest);
        seen.push((parameters as { edit: unknown }).edit);
        const trace = { steps: [], notes: [], stop: '' };
        return { result: { program: { ...answer, layers: answer.layers.slice(0, 1) }, trace }, buffers: [] };
      };
      Object.assign(client, { call: answered });
    }, edits);
    await page.getByRole('button', { name: 'Edit by hand' }).click();
    await page.getByLabel('Part to edit').selectOption('seat');
    await page.getByRole('radio', { name: 'Stretch' }).check({ force: true });
    await page.getByLabel('The whole part or a face').selectOption('0,1,0');
    await page.getByLabel('Direction').selectOption({ label: 'front–back' });
    await page.getByLabel('Point that stays').selectOption('0,0,-1');
    await page.getByText('What may come apart').click();
    await page.getByRole('checkbox', { name: 'all even rows' }).check();
    await page.getByText('What other parts should do').click();
    await page.getByLabel('Add a part').selectOption({ index: 1 });
    await page.getByRole('button', { name: 'Apply' }).click();
    await page.locator('.card').nth(3).waitFor();
    const [edit] = await page.evaluate(() => (globalThis as unknown as { seen: unknown[] }).seen);
    expect(edit).toMatchObject({
      seed: [
        {
          op: 'scale_1d',
          part: 'seat',
          feature: [0, 1, 0],
          origin: { part: 'seat', at: [0, 0, -1] },
          direction: [0, 0, 1],
          amount: 'x',
        },
      ],
      disabled: ['kind:translation'],
    });
    expect(Object.values((edit as { hints: object }).hints)).toEqual(['keep_fixed']);
    expect(await page.locator('.card h3').last().textContent()).toBe('Stretch top of seat');
    const names = await page.evaluate(() => parsel.document().layers.map(({ layer }) => layer.parameter.name));
    expect(new Set(names).size).toBe(4);
    expect(complaints).toEqual([]);
  });

  it('says in a sentence when the core refuses, and loses nothing', async () => {
    const before = await state();
    await page.evaluate(() => {
      const no = () => Promise.reject(new Error('the seat cannot do that; choose another operator'));
      Object.assign(parsel.client(), { call: no });
    });
    await page.getByRole('button', { name: 'Edit by hand' }).click();
    await page.getByLabel('Part to edit').selectOption('seat');
    await page.getByRole('button', { name: 'Apply' }).click();
    await expect
      .poll(() => page.getByRole('alert').textContent())
      .toBe('The seat cannot do that; choose another operator.');
    expect(await state()).toBe(before);
    expect(await page.getByLabel('Part to edit').inputValue()).toBe('seat');
  });
});
