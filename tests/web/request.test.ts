// A request from what is typed to its layer, and its corrections, without a page, a core or a language model.
import { signal } from '@preact/signals';
import { describe, expect, it, vi } from 'vitest';
import { AskError } from '../../web/src/llm/ask_error';
import type { Source } from '../../web/src/llm/source';
import { emptyDocument } from '../../web/src/session/document';
import type { ModelCore } from '../../web/src/session/model_core';
import { createRequests, type RequestParts } from '../../web/src/session/request';
import { createSession } from '../../web/src/session/session';
import { edit, fakeCore, moving, openModel, readPlainly, understood } from './fake_core';

const source: Source = {
  votes: () => 1,
  kept: async () => undefined,
  reply: async () => ({ text: 'moved', tokens: null }),
  discard: async () => {},
};

function ready(change: Partial<RequestParts> = {}) {
  const session = createSession();
  session.replaceDocument({ ...emptyDocument, model: openModel('boxes') }, 'open boxes');
  const core = fakeCore();
  const play = vi.fn();
  const aim = vi.fn();
  const requests = createRequests({
    session,
    models: signal<ModelCore | null>(core),
    questionOf: async (_, said, mentioned) => ({ request: said.told, title: said.typed, mentioned, source }),
    seen: () => null,
    votes: () => 3,
    play,
    aim,
    ...change,
  });
  requests.requestText.value = 'lift it';
  const moved = () => session.document.value.layers.map(({ layer }) => (layer.statements[0] as { part: string }).part);
  return { session, core, play, aim, requests, moved };
}
const settled = (made: ReturnType<typeof ready>) => vi.waitFor(() => expect(made.session.task.value).toBe(null));

describe('a request', () => {
  it('becomes a layer in one step, is shown once, and empties the field', async () => {
    const { session, play, requests, moved } = ready();
    requests.mention('left');
    await requests.sendRequest();
    expect(moved()).toEqual(['left']);
    expect(session.undoLabel.value).toBe('lift it');
    expect(requests.requestLayer.value?.request).toBe('lift it');
    expect(play).toHaveBeenCalledExactlyOnceWith(session.document.value.layers[0]?.key);
    expect([requests.requestText.value, requests.mentioned.value]).toEqual(['', []]);
  });

  it('keeps what is typed meanwhile', async () => {
    const { requests } = ready();
    const sending = requests.sendRequest();
    requests.requestText.value = 'and then';
    await sending;
    expect(requests.requestText.value).toBe('and then');
  });

  it('that is not decided is not applied before one chooses', async () => {
    const made = ready();
    const { core, requests, moved } = made;
    core.inference = { ...understood('left'), seed: { ...understood('left').seed, outcome: 'split' } };
    await requests.sendRequest();
    expect(moved()).toEqual([]);
    requests.chooseReading(1);
    await settled(made);
    expect(moved()).toEqual([]); // chosen, not applied
    await requests.applyRequest();
    expect(moved()).toEqual(['right']);
  });

  it('that cannot be asked says so and whether the settings help', async () => {
    const refusal = new AskError('no_key', '', 'There is no key', 'Enter one');
    const { requests } = ready({ questionOf: () => Promise.reject(refusal) });
    await requests.sendRequest();
    expect(requests.request.value).toEqual({ kind: 'failed', text: 'There is no key. Enter one.', isSetting: true });
    expect(requests.requestText.value).toBe('lift it');
    requests.dismiss();
    expect(requests.request.value).toEqual({ kind: 'idle' });
  });

  it('can be cancelled, and keeps what was typed', async () => {
    const { requests } = ready({
      questionOf: async (_, said, mentioned) => ({
        request: said.told,
        title: said.typed,
        mentioned,
        source: {
          ...source,
          reply: (_prompt, _vote, _schema, stop) =>
            new Promise((_resolve, reject) => stop.addEventListener('abort', () => reject(stop.reason))),
        },
      }),
    });
    const sending = requests.sendRequest();
    await vi.waitFor(() => expect(requests.request.value).toMatchObject({ kind: 'asking', tasks: [{ of: 1 }] }));
    requests.cancelRequest();
    await sending;
    expect(requests.request.value).toEqual({ kind: 'idle' });
    expect(requests.requestText.value).toBe('lift it');
  });

  it('is forgotten with its model; parts of the other that are not there are no longer mentioned', async () => {
    const { session, requests } = ready();
    const stop = requests.forgetOtherModels();
    await requests.sendRequest();
    requests.mention('left');
    requests.mention('lid');
    session.replaceDocument({ ...emptyDocument, model: openModel('another') }, 'open another');
    expect(requests.request.value).toEqual({ kind: 'idle' });
    expect(requests.mentioned.value).toEqual(['left']);
    stop();
  });
});

describe('sides', () => {
  it('are told from where they are said, kept with the layer, and read with the others in its place', async () => {
    const made = ready({ seen: () => 'left', votes: () => null });
    const { session, core, requests } = made;
    const prompts = vi.spyOn(core, 'prompts');
    requests.requestText.value = 'lift the right one';
    await requests.sendRequest();
    const seen = () => session.document.value.layers.map((entry) => entry.seen);
    expect(prompts.mock.calls[0]?.[1]).toMatch(/^lift the right one\n\(I say sides as I see them, looking at its left/);
    expect(session.document.value.layers.map(({ layer }) => layer.request)).toEqual(['lift the right one']);
    expect(seen()).toEqual(['left']);

    const state = requests.request.value;
    if (state.kind !== 'understood') throw new Error('it is not understood');
    await requests.readFrom(state, null);
    expect(prompts.mock.calls[1]?.[1]).toBe('lift the right one');
    expect(seen()).toEqual([undefined]);
    session.undo();
    expect(seen()).toEqual([]);
  });

  it('are put into the object’s own where no language model is asked', async () => {
    const { core, requests } = ready({ seen: () => 'front' });
    core.plain = readPlainly(['left'], true);
    const read = vi.spyOn(core, 'readPlainly');
    requests.requestText.value = 'lift the right one';
    await requests.sendRequest();
    expect(read.mock.calls[0]?.[1]).toBe('lift the left one');
    expect(requests.request.value).toMatchObject({ said: { own: 'lift the left one', seen: 'front' } });
  });

  it('are the object’s own by default: nothing is added', async () => {
    const { core, requests, session } = ready({ votes: () => null });
    const prompts = vi.spyOn(core, 'prompts');
    requests.requestText.value = 'lift the right one';
    await requests.sendRequest();
    expect(prompts.mock.calls[0]?.[1]).toBe('lift the right one');
    expect(session.document.value.layers[0]).not.toHaveProperty('seen');
  });
});

describe('a plain request', () => {
  const noRecording = () => Promise.reject(new AskError('no_recording', '', 'There is none', 'Enter a key'));
  const keyless: Partial<RequestParts> = { questionOf: noRecording, votes: () => null };

  it('is read without a language model where there is no key and nothing recorded', async () => {
    const made = ready(keyless);
    made.core.plain = readPlainly(['right'], true);
    await made.requests.sendRequest();
    expect(made.moved()).toEqual(['right']);
    expect(made.requests.request.value).toMatchObject({ kind: 'understood', plain: { sure: true }, reading: 0 });
    expect(made.play).toHaveBeenCalledOnce();
    expect(made.requests.requestText.value).toBe('');
  });

  it('does not come before a recorded answer', async () => {
    const made = ready({ votes: () => null });
    made.core.plain = readPlainly(['right'], true);
    await made.requests.sendRequest();
    expect(made.moved()).toEqual(['left']);
    expect(made.requests.request.value).toMatchObject({ plain: null });
  });

  it('that is not sure waits for one of its readings, which brings its own hints', async () => {
    const made = ready(keyless);
    made.core.plain = readPlainly(['left', 'right'], false);
    const [, second] = made.core.plain.plain.readings;
    if (second) Object.assign(second.edit, { hints: { left: 'keep_fixed' } });
    await made.requests.sendRequest();
    expect(made.moved()).toEqual([]);
    made.requests.chooseReading(1);
    expect(made.requests.request.value).toMatchObject({ edit: { hints: { left: 'keep_fixed' } } });
    await made.requests.applyRequest();
    expect(made.moved()).toEqual(['right']);
  });

  it('that is not understood says why, and what else can be done', async () => {
    const { requests, moved } = ready(keyless);
    await requests.sendRequest();
    expect(moved()).toEqual([]);
    expect(requests.request.value).toMatchObject({ kind: 'failed', isSetting: true });
    expect((requests.request.value as { text: string }).text).toMatch(/it is not clear; “nicer” is not understood\./);
    expect(requests.requestText.value).toBe('lift it');
  });

  it('with a key costs nothing when it is sure', async () => {
    const questionOf = vi.fn(noRecording);
    const made = ready({ questionOf });
    made.core.plain = readPlainly(['right'], true);
    expect(await made.requests.estimateRequest()).toBe(null);
    await made.requests.sendRequest();
    expect(made.moved()).toEqual(['right']);
    expect(questionOf).not.toHaveBeenCalled();
  });

  it('with a key is asked of the language model when it is not sure', async () => {
    const made = ready();
    made.core.plain = readPlainly(['right', 'left'], false);
    await made.requests.sendRequest();
    expect(made.moved()).toEqual(['left']);
    expect(made.requests.request.value).toMatchObject({ plain: null });
  });

  it('can be asked of a language model instead, in the same layer', async () => {
    const made = ready();
    made.core.plain = readPlainly(['right'], true);
    await made.requests.sendRequest();
    const state = made.requests.request.value;
    if (state.kind === 'understood') await made.requests.askAgain(state);
    expect(made.moved()).toEqual(['left']);
    expect(made.requests.request.value).toMatchObject({ plain: null });
    made.session.undo();
    expect(made.moved()).toEqual([]);
  });

  it('puts the slider where it says, until the edit is corrected', async () => {
    const target = { part: 'left', what: 'distance', by: 0.1, x: 0.2 } as const;
    const made = ready(keyless);
    made.core.plain = readPlainly(['left'], true, target);
    await made.requests.sendRequest();
    expect(made.aim).toHaveBeenCalledExactlyOnceWith(made.session.document.value.layers[0]?.key, target);
    expect(made.play).not.toHaveBeenCalled();
    made.requests.correctEdit(edit('right'));
    await settled(made);
    expect(made.moved()).toEqual(['right']);
    expect(made.aim).toHaveBeenCalledOnce();
    expect(made.play).toHaveBeenCalledOnce();
  });
});

describe('a correction', () => {
  it('makes the layer anew in its step; later steps and undo stay', async () => {
    const made = ready();
    const { session, core, requests, moved } = made;
    await requests.sendRequest();
    const key = session.document.value.layers[0]?.key;
    session.addProgram(moving('left'), 'by hand');
    requests.correctEdit(edit('right'));
    expect(moved()).toEqual(['left', 'left']); // what was there stays until the other is found
    await settled(made);
    expect(core.asked).toEqual(['left', 'right']);
    expect(moved()).toEqual(['right', 'left']);
    expect(session.document.value.layers[0]?.key).toBe(key);
    session.undo();
    expect(moved()).toEqual(['right']);
    session.undo();
    expect(moved()).toEqual([]);
    expect(session.undoLabel.value).toBe(null);
  });

  it('that the core refuses leaves the layer as it was', async () => {
    const made = ready();
    const { session, core, requests, moved } = made;
    await requests.sendRequest();
    core.answer = () => Promise.reject(new Error('it is round'));
    requests.correctEdit(edit('right'));
    await settled(made);
    expect(moved()).toEqual(['left']);
    expect(session.notice.value?.text).toBe('It is round.');
    expect(session.undoLabel.value).toBe('lift it');
  });

  it('in the middle of another goes on from it', async () => {
    const made = ready();
    const { session, core, requests, moved } = made;
    await requests.sendRequest();
    requests.correctEdit(edit('right'));
    requests.correctEdit({ hints: { left: 'keep_fixed' } });
    await settled(made);
    expect(core.asked).toEqual(['left', 'right', 'right']);
    expect(moved()).toEqual(['right']);
    session.undo();
    expect(moved()).toEqual([]);
  });

  it('of a request whose layer was undone waits until it is applied, and is a new step then', async () => {
    const made = ready();
    const { session, core, requests, moved } = made;
    await requests.sendRequest();
    session.undo();
    requests.correctEdit(edit('right'));
    await settled(made);
    expect(core.asked).toEqual(['left']);
    await requests.applyRequest();
    expect(moved()).toEqual(['right']);
  });

  it('by asking again takes the place of what came before', async () => {
    const { core, requests, moved, session } = ready();
    await requests.sendRequest();
    core.inference = understood('right');
    const before = requests.request.value;
    if (before.kind !== 'understood') throw new Error(before.kind);
    await requests.askAgain(before);
    expect(moved()).toEqual(['right']);
    session.undo();
    expect(moved()).toEqual([]);
  });
});

describe('an estimate', () => {
  it('is there where calls are paid for', async () => {
    expect(await ready().requests.estimateRequest()).toMatchObject({ calls: 3 });
    expect(await ready({ votes: () => null }).requests.estimateRequest()).toBe(null);
  });
});
