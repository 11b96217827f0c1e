// Proposals from the first question to layers of the work, without a page, a core or a language model.
import { signal } from '@preact/signals';
import { describe, expect, it, vi } from 'vitest';
import { AskError } from '../../web/src/llm/ask_error';
import type { Source } from '../../web/src/llm/source';
import type { Program } from '../../web/src/program/types';
import { emptyDocument } from '../../web/src/session/document';
import type { ModelCore } from '../../web/src/session/model_core';
import { createProposals, isClean } from '../../web/src/session/proposals';
import type { Asker } from '../../web/src/session/propose';
import { createSession } from '../../web/src/session/session';
import { edit, fakeCore, moving, openModel, understood } from './fake_core';

const source: Source = {
  votes: () => 1,
  kept: async () => undefined,
  reply: async () => ({ text: 'said', tokens: { input: 10, output: 1 } }),
  discard: async () => {},
};
const asker: Asker = { reader: source, proposer: () => source, isBlind: () => {} };

/** Requests are the names of the parts that they move. */
function ready(requests: readonly string[], change: Partial<Asker> = {}) {
  const session = createSession();
  session.replaceDocument({ ...emptyDocument, model: openModel('boxes') }, 'open boxes');
  const core = fakeCore();
  core.readReplies = async (_, request) =>
    request === ''
      ? {
          ...understood('left'),
          proposals: {
            requests: requests.map((text) => ({ request: text, changes: ['left'], keeps: [] })),
            dropped: [{ request: 'add wheels', reason: 'there is no part wheels' }],
          },
        }
      : { ...understood(request), edit: { format: 'parsel/edit', version: 1, ...edit(request) } };
  const proposals = createProposals({
    session,
    models: signal<ModelCore | null>(core),
    askerOf: async () => ({ ...asker, ...change }),
  });
  const start = () => proposals.start({ task: 'procedural_requests' }, () => 'a picture');
  const layers = () => session.document.value.layers.map(({ layer }) => layer.request);
  const kinds = () => proposals.open.value.map(({ state }) => state.kind);
  return { session, core, proposals, start, layers, kinds };
}

describe('proposals', () => {
  it('are each propagated, and all of them become layers in one step; undo brings the cards back', async () => {
    const { session, proposals, start, layers } = ready(['left', 'right']);
    await start();
    expect(proposals.open.value.map(({ request, state }) => [request, state.kind])).toEqual([
      ['left', 'found'],
      ['right', 'found'],
    ]);
    expect(proposals.asked.value).toMatchObject({
      isRunning: false,
      dropped: [{ request: 'add wheels' }],
      spent: { calls: 3, tokens: { input: 30, output: 3 } },
    });
    proposals.rename(proposals.open.value[0]?.key ?? 0, 'left up');
    proposals.move(proposals.open.value[0]?.key ?? 0, 1);
    proposals.keepAll();
    expect(layers()).toEqual(['right', 'left up']);
    expect(proposals.open.value).toEqual([]);
    expect(session.undoLabel.value).toBe('keep 2 suggested sliders');
    session.undo();
    expect(layers()).toEqual([]);
    expect(proposals.open.value.map(({ request }) => request)).toEqual(['right', 'left up']);
  });

  it('move the model before they are kept, and are kept where the slider stands', async () => {
    const { session, proposals, start } = ready(['left', 'right']);
    await start();
    const [left = 0, right = 0] = proposals.open.value.map(({ key }) => key);
    const height = () => {
      const now = session.compiled.value;
      return now.kind === 'ready' ? now.evaluator.corners[1] : Number.NaN;
    };
    const rest = height() ?? 0;
    proposals.preview(left, 0.1);
    proposals.preview(left, 0.2);
    expect(height()).toBeCloseTo(rest + 0.2);
    expect([proposals.standing(left), proposals.standing(right)]).toEqual([0.2, 0]);
    expect(session.document.value.layers).toEqual([]);
    proposals.preview(right, 0.1);
    expect(height()).toBeCloseTo(rest);
    proposals.preview(left, 0.3);
    proposals.keep(left);
    expect(session.document.value.layers.map(({ value }) => value)).toEqual([0.3]);
    expect(session.draft.value).toBe(null);
  });

  it('that are stopped stay as far as they are finished, and can be read later', async () => {
    const { core, proposals, start, kinds } = ready(['left', 'right']);
    core.answer = ({ seed }, signal) =>
      (seed[0] as { part: string }).part === 'left'
        ? Promise.resolve(moving('left'))
        : new Promise((_, reject) => signal.addEventListener('abort', () => reject(signal.reason)));
    const running = start();
    await vi.waitFor(() => expect(kinds()).toEqual(['found', 'reading']));
    proposals.stop();
    expect(kinds()).toEqual(['found', 'stopped']);
    await running;
    expect(kinds()).toEqual(['found', 'stopped']);
    core.answer = async () => moving('right');
    await proposals.readAgain(proposals.open.value[1]?.key ?? 0);
    expect(kinds()).toEqual(['found', 'found']);
  });

  it('say what is wrong with them, and keeping all leaves those out', async () => {
    const { core, proposals, start, layers } = ready(['left', 'left ', 'right', 'none']);
    const made: Program[] = [moving('left'), moving('left'), moving('right', 0)];
    core.readReplies = vi.fn(core.readReplies);
    core.answer = async () => made.shift() ?? Promise.reject(new Error('there is no way'));
    await start();
    expect(proposals.open.value.map(({ state }) => (state.kind === 'found' ? state.fault : state.kind))).toEqual([
      null,
      { kind: 'same', as: 'left' },
      { kind: 'still' },
      'refused',
    ]);
    expect(proposals.open.value.filter(isClean)).toHaveLength(1);
    proposals.keepAll();
    expect(layers()).toEqual(['left']);
  });

  it('name the relations that break', async () => {
    const { core, proposals, start } = ready(['left']);
    const relations = [{ id: 'a1', status: 'broken', worst: 1, proof: 'sampled' } as const];
    core.answer = async () => ({
      ...moving('left'),
      layers: moving('left').layers.map((layer) => ({ ...layer, relations })),
    });
    await start();
    expect(proposals.open.value[0]?.state).toMatchObject({
      fault: { kind: 'broken', relations: ['a1'] },
      looser: null,
    });
  });

  it('are composed onto each other and onto the edits that are there when they are kept', async () => {
    const { session, core, proposals, start, layers } = ready(['left', 'right']);
    session.addProgram(moving('left'), 'before');
    const firsts: number[] = [];
    core.compose = async (_, program, first) => {
      firsts.push(first);
      const statements = (layer: (typeof program.layers)[number]) =>
        layer.statements.map((one) => ({ ...one, amount: `2*${layer.parameter.name}` }) as typeof one);
      return { ...program, layers: program.layers.map((layer) => ({ ...layer, statements: statements(layer) })) };
    };
    await start();
    proposals.keepAll();
    const amounts = () =>
      session.document.value.layers.map(({ layer }) => {
        const [first] = layer.statements;
        return first && 'amount' in first ? first.amount : undefined;
      });
    await vi.waitFor(() =>
      expect(
        amounts()
          .slice(1)
          .every((amount) => amount?.startsWith('2*')),
      ).toBe(true),
    );
    expect(firsts).toEqual([1]);
    session.undo();
    expect(layers()).toEqual(['']);
  });

  it('offer to let parts follow that were to stay, where nothing breaks then', async () => {
    const { core, proposals, start } = ready(['left']);
    const read = core.readReplies;
    core.readReplies = async (...asked) => {
      const inference = await read(...asked);
      return {
        ...inference,
        edit: inference.edit && { ...inference.edit, hints: { right: 'keep_fixed', left: 'scale' } },
      };
    };
    const relations = [{ id: 'a1', status: 'broken', worst: 1, proof: 'sampled' } as const];
    const whole = moving('left');
    core.answer = async ({ hints }) =>
      'right' in hints ? { ...whole, layers: whole.layers.map((layer) => ({ ...layer, relations })) } : moving('right');
    await start();
    expect(proposals.open.value.filter(isClean)).toEqual([]);
    proposals.loosen(proposals.open.value[0]?.key ?? 0);
    expect(proposals.open.value.filter(isClean)).toHaveLength(1);
    expect(proposals.open.value[0]?.state).toMatchObject({ found: { program: moving('right') } });
  });

  it('are asked without a picture of a model that refuses one', async () => {
    const refusing: Source = {
      ...source,
      reply: () => Promise.reject(new AskError('request', 'host', 'takes no pictures', 'Send none')),
    };
    const isBlind = vi.fn();
    const proposer = vi.fn((_: unknown, picture: (() => string | null) | null) => (picture ? refusing : source));
    const { kinds, start } = ready(['left'], { proposer, isBlind });
    await start();
    expect(kinds()).toEqual(['found']);
    expect(isBlind).toHaveBeenCalledOnce();
  });

  it('say why there are none, and leave the work alone', async () => {
    const { proposals, start, layers } = ready([]);
    await start();
    expect(proposals.asked.value?.failure?.text).toMatch(/could not be used: there is no part wheels/);
    expect(layers()).toEqual([]);
  });

  it('are gone while another model is open', async () => {
    const { session, proposals, start } = ready(['left']);
    await start();
    proposals.preview(proposals.open.value[0]?.key ?? 0, 0.2);
    session.replaceDocument({ ...emptyDocument, model: openModel('others') }, 'open others');
    expect(proposals.asked.value).toBe(null);
    expect(session.compiled.value.kind).toBe('ready');
    session.undo();
    expect(proposals.open.value).toHaveLength(1);
  });
});

describe('sliders together', () => {
  it('are put in one step, each within its range', () => {
    const { session } = ready([]);
    const [left = 0] = session.addProgram(moving('left'), 'one') ?? [];
    const [right = 0] = session.addProgram(moving('right'), 'two') ?? [];
    session.setValues(
      new Map([
        [left, 0.2],
        [right, 7],
      ]),
      'surprise me',
    );
    expect(session.document.value.layers.map(({ value }) => value)).toEqual([0.2, 0.35]);
    session.undo();
    expect(session.document.value.layers.map(({ value }) => value)).toEqual([0, 0]);
  });
});

describe('another reading', () => {
  it('takes the place of a layer in a step of its own, and keeps the slider where it is', () => {
    const { session } = ready([]);
    const [key = 0] = session.addProgram(moving('left'), 'move') ?? [];
    session.setValue(key, 0.2);
    expect(session.exchangeLayer(key, { program: moving('right') }, 'move right')).toBe(true);
    expect(session.document.value.layers).toMatchObject([{ key, value: 0.2, layer: { request: 'move right' } }]);
    session.undo();
    expect(session.document.value.layers).toMatchObject([{ key, value: 0.2, layer: { request: '' } }]);
  });
});
