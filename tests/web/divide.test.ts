// A request of several changes that share a slider, each given its own, without a page, a core or a language model.
import { signal } from '@preact/signals';
import { describe, expect, it, vi } from 'vitest';
import type { Source } from '../../web/src/llm/source';
import type { Statement } from '../../web/src/program/types';
import { divide, isDivisible } from '../../web/src/session/divide';
import { emptyDocument } from '../../web/src/session/document';
import type { ModelCore } from '../../web/src/session/model_core';
import { createRequests, type Understood } from '../../web/src/session/request';
import { createSession } from '../../web/src/session/session';
import type { Inference } from '../../web/src/worker/protocol';
import { edit, fakeCore, moving, openModel, understood } from './fake_core';

const source: Source = {
  votes: () => 1,
  kept: async () => undefined,
  reply: async () => ({ text: 'moved', tokens: null }),
  discard: async () => {},
};
const title = (statement: Statement) => `move ${(statement as { part: string }).part}`;

/** Both boxes moved by one slider, which stands at 0.1. */
async function both() {
  const session = createSession();
  session.replaceDocument({ ...emptyDocument, model: openModel('boxes') }, 'open boxes');
  const core = fakeCore();
  const seed = [...edit('left').seed, ...edit('right').seed];
  const read = understood('left');
  core.inference = { ...read, edit: { ...(read.edit as NonNullable<Inference['edit']>), seed } };
  const requests = createRequests({
    session,
    models: signal<ModelCore | null>(core),
    questionOf: async (_, said, mentioned) => ({ request: said.told, title: said.typed, mentioned, source }),
    seen: () => 'right',
    votes: () => 3,
    play: vi.fn(),
    aim: vi.fn(),
  });
  requests.requestText.value = 'lift both';
  await requests.sendRequest();
  const state = requests.request.value as Understood;
  const [entry] = session.document.value.layers;
  session.setValue(entry?.key ?? 0, 0.1);
  const layers = () => session.document.value.layers;
  return { session, core, state, layers, key: entry?.key };
}

describe('changes that share a slider', () => {
  it('get one each, in the step that made it; the first stays where it is', async () => {
    const { session, core, state, layers, key } = await both();
    expect(isDivisible(state)).toBe(true);
    core.asked.length = 0;
    expect(await divide(session, core, state, title)).toBe(true);
    expect(core.asked).toEqual(['left', 'right']);
    expect(layers().map(({ layer, value }) => [layer.request, value])).toEqual([
      ['move left', 0.1],
      ['move right', 0],
    ]);
    expect(layers()[0]?.key).toBe(key);
    expect(new Set(layers().map(({ layer }) => layer.parameter.name)).size).toBe(2);
    const [, second] = layers();
    expect(second?.layer.statements[0]).toMatchObject({ amount: second?.layer.parameter.name });
    expect(layers().map(({ seen }) => seen)).toEqual(['right', 'right']);
    session.undo(); // of the slide: both are in the step before
    expect(layers().map(({ value }) => value)).toEqual([0, 0]);
    session.undo();
    expect(layers()).toEqual([]);
    session.redo();
    expect(layers()).toHaveLength(2);
  });

  it('keep it when one of them cannot be, which is said', async () => {
    const { session, core, state, layers } = await both();
    core.answer = async ({ seed }) => {
      if ((seed[0] as { part: string }).part === 'right') throw new Error('it is round');
      return moving('left');
    };
    const before = layers();
    expect(await divide(session, core, state, title)).toBe(false);
    expect(layers()).toBe(before);
    expect(session.notice.value?.text).toBe('It is round.');
  });

  it('are not divided once their step is undone, nor when there is one', async () => {
    const { session, core, state, layers } = await both();
    session.undo();
    session.undo();
    expect(await divide(session, core, state, title)).toBe(false);
    expect(layers()).toEqual([]);
    expect(isDivisible({ ...state, edit: { ...edit('left') } })).toBe(false);
    expect(isDivisible({ ...state, made: null })).toBe(false);
  });
});
