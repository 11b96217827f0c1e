// Names for parts, from the question to labels, without a page, a core or a language model.
import { signal } from '@preact/signals';
import { describe, expect, it, vi } from 'vitest';
import { AskError } from '../../web/src/llm/ask_error';
import type { Source } from '../../web/src/llm/source';
import { emptyDocument, partKey } from '../../web/src/session/document';
import type { ModelCore } from '../../web/src/session/model_core';
import { createNaming } from '../../web/src/session/naming';
import { createSession } from '../../web/src/session/session';
import { fakeCore, openModel, understood } from './fake_core';

function ready(reply: Source['reply'] = async () => ({ text: 'said', tokens: { input: 10, output: 1 } })) {
  const session = createSession();
  const model = openModel('boxes');
  session.replaceDocument({ ...emptyDocument, model }, 'open boxes');
  const core = fakeCore();
  core.readReplies = async (_, __, replies) => ({
    ...understood('left'),
    names: {
      category: 'pair of boxes',
      category_votes: 3,
      front: '-z',
      front_votes: 2,
      of: replies[0]?.texts.length ?? 0,
      parts: [
        { part: 'left', label: 'box', votes: 3 },
        { part: 'right', label: '', votes: 0 },
      ],
    },
  });
  const source: Source = { votes: () => 3, kept: async () => undefined, reply, discard: async () => {} };
  const relabel = vi.fn(async () => true);
  const isBlind = vi.fn();
  const naming = createNaming({
    session,
    models: signal<ModelCore | null>(core),
    askerOf: async () => ({ proposer: () => source, isBlind }),
    relabel,
  });
  return { session, model, naming, relabel, isBlind };
}

describe('names for parts', () => {
  it('are a list to correct, and label all parts in one step', async () => {
    const { model, naming, relabel } = ready();
    await naming.start(() => 'a picture');
    expect(naming.naming.value).toMatchObject({
      category: 'pair of boxes',
      front: '-z',
      of: 3,
      progress: null,
      spent: { calls: 3, tokens: { input: 30, output: 3 } },
    });
    naming.rename('right', ' lid ');
    expect(naming.naming.value?.rows[1]).toEqual({ part: 'right', label: ' lid ', votes: null });
    expect(await naming.accept()).toBe(true);
    const key = (id: string) =>
      partKey(model.shape.parts.find((part) => part.id === id) ?? { node: -1, primitive: -1 });
    expect(relabel).toHaveBeenCalledExactlyOnceWith(
      expect.anything(),
      new Map([
        [key('left'), 'box'],
        [key('right'), 'lid'],
      ]),
      'name the parts',
    );
    expect(naming.naming.value).toBeNull();
  });

  it('leave the label of a part that nobody names', async () => {
    const { naming, relabel } = ready();
    await naming.start(() => null);
    await naming.accept();
    expect((relabel.mock.calls as unknown as [unknown, Map<string, string>][])[0]?.[1].size).toBe(1);
  });

  it('are asked for without a picture where one is refused', async () => {
    let calls = 0;
    const { naming, isBlind } = ready(async () => {
      if (++calls <= 3) throw new AskError('request', '', 'no pictures', '');
      return { text: 'said', tokens: null };
    });
    await naming.start(() => 'a picture');
    expect(isBlind).toHaveBeenCalledOnce();
    expect(naming.naming.value).toMatchObject({ of: 3, failure: null });
  });

  it('can be cancelled, and are gone with the model', async () => {
    const { session, naming } = ready(
      (_, __, ___, aborted) =>
        new Promise((_, reject) => aborted.addEventListener('abort', () => reject(aborted.reason))),
    );
    const running = naming.start(() => null);
    await vi.waitFor(() => expect(naming.naming.value?.progress).toEqual({ done: 0, of: 3 }));
    naming.close();
    await running;
    expect(naming.naming.value).toBeNull();
    void naming.start(() => null);
    session.replaceDocument(emptyDocument, 'close');
    expect(naming.naming.value).toBeNull();
  });

  it('say why nobody can be asked', async () => {
    const { naming } = ready(async () => {
      throw new AskError('no_key', '', 'There is no key', 'Enter one');
    });
    await naming.start(() => null);
    expect(naming.naming.value).toMatchObject({ progress: null, failure: { isSetting: true } });
    expect(await naming.accept()).toBe(false);
  });
});
