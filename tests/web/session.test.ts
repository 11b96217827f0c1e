// A session without a page: layers, parts, tasks and the history that they share.
import { describe, expect, it } from 'vitest';
import { emptyDocument, noLabels } from '../../web/src/session/document';
import { activeLayers } from '../../web/src/session/evaluation';
import { createSession } from '../../web/src/session/session';
import { edit, fakeCore, moving, openModel } from './fake_core';

function opened() {
  const session = createSession();
  const model = openModel('boxes');
  session.replaceDocument({ ...emptyDocument, model }, 'open boxes');
  return { session, model };
}
const parts = (session: ReturnType<typeof createSession>) =>
  session.document.value.layers.flatMap(({ layer }) =>
    layer.statements.map((statement) => 'part' in statement && statement.part),
  );

describe('a session', () => {
  it('is one of its own', () => {
    const { session } = opened();
    session.addProgram(moving('left'), 'add');
    expect(createSession().document.value.layers).toEqual([]);
  });

  it('gives every layer a parameter of its own, and evaluates them together', () => {
    const { session } = opened();
    const [first] = session.addProgram(moving('left'), 'add') ?? [];
    const [second] = session.addProgram(moving('right'), 'add') ?? [];
    expect(session.document.value.layers.map(({ layer }) => layer.parameter.name)).toEqual(['x', 'x1']);
    session.slide(first as number, 0.2);
    session.slide(second as number, 9);
    const state = session.compiled.value;
    if (state.kind !== 'ready') throw new Error(state.kind);
    const heights = [1, 25].map((at) => state.evaluator.corners[at] ?? Number.NaN);
    expect(heights[0]).toBeCloseTo(-0.25 + 0.2);
    expect(heights[1]).toBeCloseTo(-0.25 + 0.35); // no farther than the slider goes
    expect(session.document.value.layers.map(({ value }) => value)).toEqual([0, 0]); // not settled yet
  });

  it('takes every drag of a slider as a step', () => {
    const { session } = opened();
    const [key = 0] = session.addProgram(moving('left'), 'add') ?? [];
    for (const value of [0.1, 0.2]) {
      session.slide(key, value);
      session.settle(key);
    }
    expect(session.undoLabel.value).toBe('slide “Edit”');
    session.undo();
    expect(session.document.value.layers[0]?.value).toBe(0.1);
  });

  it('takes a run of moves of one slider by key as one step', () => {
    const { session } = opened();
    const [key = 0] = session.addProgram(moving('left'), 'add') ?? [];
    for (const value of [0.1, 0.2, 0.3]) session.setValue(key, value, true);
    session.settle(key); // nothing has moved
    expect(session.document.value.layers[0]?.value).toBe(0.3);
    session.undo();
    expect(session.document.value.layers[0]?.value).toBe(0);
    expect(session.undoLabel.value).toBe('add');
  });

  it('refuses what does not fit, in a sentence', () => {
    const { session } = opened();
    expect(session.addProgram(moving('nobody'), 'add')).toBe(null);
    expect(session.notice.value).toMatchObject({
      kind: 'error',
      text: expect.stringMatching(/does not fit the model/),
    });
    expect(session.undoLabel.value).toBe(null);
  });

  it('hides, shows and renames parts, and takes it back', () => {
    const { session } = opened();
    session.setHidden(['left'], true);
    session.renamePart('right', 'lid');
    session.renamePart('right', 'lid'); // as it is
    session.undo();
    expect([...session.document.value.names]).toEqual([]);
    session.undo();
    expect([...session.document.value.hidden]).toEqual([]);
    session.showAll(); // nothing is hidden
    expect(session.undoLabel.value).toBe(null);
  });

  it('arranges layers, and skips those that are off', () => {
    const { session } = opened();
    const [first = 0] = session.addProgram(moving('left'), 'add') ?? [];
    const [second = 0] = session.addProgram(moving('right'), 'add') ?? [];
    session.moveLayer(second, -1);
    expect(parts(session)).toEqual(['right', 'left']);
    session.moveLayer(second, -1); // it is the first
    expect(parts(session)).toEqual(['right', 'left']);
    session.setEnabled(first, false);
    expect(activeLayers(session.document.value).map(({ key }) => key)).toEqual([second]);
    session.removeLayer(second);
    expect(session.compiled.value).toMatchObject({ kind: 'ready', keys: [] });
  });

  it('keeps a draft where its slider stands', () => {
    const { session } = opened();
    const [entry] = session.entriesOf({ program: moving('left') }) ?? [];
    session.draft.value = entry ?? null;
    session.slide(entry?.key ?? 0, 0.1);
    expect(session.document.value.layers).toEqual([]);
    expect(session.keepDraft()).toBe(entry?.key);
    expect(session.document.value.layers[0]?.value).toBe(0.1);
    expect(session.keepDraft()).toBe(null);
  });
});

describe('a layer that is found anew', () => {
  it('takes the place of the one before in the step that made it, with its slider where it was', () => {
    const { session } = opened();
    const [key = 0] = session.addProgram(moving('left'), 'add') ?? [];
    const mark = session.mark();
    session.setValue(key, 0.3);
    session.setHidden(['right'], true);
    expect(session.amendLayer(mark, key, { program: moving('right', 0.2) })).toBe(true);
    expect(parts(session)).toEqual(['right']);
    expect(session.document.value.layers[0]).toMatchObject({ key, value: 0.2 }); // as far as the new one goes
    expect([...session.document.value.hidden]).toEqual(['right']);
    session.undo();
    session.undo();
    expect(session.document.value.layers[0]).toMatchObject({ key, value: 0 });
    expect(parts(session)).toEqual(['right']);
    session.undo();
    expect(session.document.value.layers).toEqual([]);
  });

  it('leaves states of another abstraction of the model as they were', () => {
    const { session, model } = opened();
    const [key = 0] = session.addProgram(moving('left'), 'add') ?? [];
    const mark = session.mark();
    session.replaceDocument({ ...session.document.value, model: { ...model, labels: noLabels } }, 'change label');
    expect(session.amendLayer(mark, key, { program: moving('right') })).toBe(true);
    expect(parts(session)).toEqual(['right']);
    session.undo();
    expect(parts(session)).toEqual(['left']);
  });

  it('does nothing when it does not fit, or when the one before is gone', () => {
    const { session } = opened();
    const [key = 0] = session.addProgram(moving('left'), 'add') ?? [];
    const mark = session.mark();
    expect(session.amendLayer(mark, key, { program: moving('nobody') })).toBe(false);
    expect(session.notice.value?.kind).toBe('error');
    session.removeLayer(key);
    expect(session.amendLayer(mark, key, { program: moving('right') })).toBe(false);
    session.undo();
    expect(parts(session)).toEqual(['left']);
  });
});

describe('propagation', () => {
  it('adds what the core finds under the words of the request', async () => {
    const { session } = opened();
    const key = await session.propagate(fakeCore(), edit('left'), 'lift it');
    expect(session.document.value.layers).toMatchObject([{ key, layer: { request: 'lift it' } }]);
    expect(session.undoLabel.value).toBe('lift it');
    expect(session.task.value).toBe(null);
  });

  it('says what the core says when it refuses, and adds nothing', async () => {
    const { session } = opened();
    const core = fakeCore();
    core.answer = () => Promise.reject(new Error('left: it is round; edit another part'));
    expect(await session.propagate(core, edit('left'), '')).toBe(null);
    expect(session.notice.value?.text).toBe('Left: it is round; edit another part.');
    expect(session.undoLabel.value).toBe(null);
  });

  it('says nothing when it is cancelled, by hand or by the next', async () => {
    const { session } = opened();
    const core = fakeCore();
    core.answer = (_, signal) =>
      new Promise((_resolve, reject) => signal.addEventListener('abort', () => reject(signal.reason)));
    const hanging = session.propagate(core, edit('left'), '');
    session.task.value?.cancel();
    expect(await hanging).toBe(null);
    const replaced = session.propagate(core, edit('left'), '');
    core.answer = async () => moving('right');
    const next = session.propagate(core, edit('right'), '');
    expect(await replaced).toBe(null);
    expect(await next).not.toBe(null);
    expect(session.notice.value).toBe(null);
    expect(parts(session)).toEqual(['right']);
  });

  it('adds nothing to a model that was opened meanwhile', async () => {
    const { session } = opened();
    const core = fakeCore();
    let answer = () => {};
    core.answer = () => new Promise((resolve) => (answer = () => resolve(moving('left'))));
    const waiting = session.propagate(core, edit('left'), '');
    session.replaceDocument({ ...emptyDocument, model: openModel('another') }, 'open another');
    answer();
    expect(await waiting).toBe(null);
    expect(session.document.value.layers).toEqual([]);
  });
});
