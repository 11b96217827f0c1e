// Kinds of a program's thing from the first question to variations of its family, with the core and without a language
// model.
import { signal } from '@preact/signals';
import { beforeAll, describe, expect, it, vi } from 'vitest';
import { AskError } from '../../web/src/llm/ask_error';
import type { Source } from '../../web/src/llm/source';
import { createKinds } from '../../web/src/session/kinds';
import type { ModelCore } from '../../web/src/session/model_core';
import { cadCore, openProgram } from './cad_fixture';
import { type LoadedModule, loadWithCad } from './module';

let module: LoadedModule;
let core: ModelCore;
beforeAll(async () => {
  module = await loadWithCad();
  core = cadCore(module);
});

const fenced = (block: unknown) => `So it is.\n\n\`\`\`json\n${JSON.stringify(block)}\n\`\`\`\n`;
const kindsReply = (...names: string[]) =>
  fenced({ kinds: names.map((name) => ({ name, absent: [], words: `a ${name}` })) });
/** A bottle of some height, all of it round and joined. */
const bottle = (height: number) => {
  const round = (from: number, to: number, width: number) => [
    [-width / 2, width / 2],
    [from, to],
    [-width / 2, width / 2],
  ];
  return fenced({
    parts: {
      body: round(0, height, 60),
      shoulder: [...round(height, height + 30, 60), 24],
      neck: round(height + 30, height + 50, 24),
      cap: 'absent',
    },
  });
};

type Answer = (prompt: string, vote: number, signal: AbortSignal) => Promise<string> | string;
const isKinds = (prompt: string) => prompt.includes('How many kinds to name');
/** The last one: there are examples before it. */
const kindOf = (prompt: string) => [...prompt.matchAll(/\nKind: "(.*)"\n/g)].at(-1)?.[1] ?? '';

async function ready(answer: Answer, votes = 3) {
  const opened = await openProgram(core, module, 'bottle');
  const discard = vi.fn(async () => {});
  const source: Source = {
    votes: () => votes,
    kept: async () => undefined,
    reply: async ({ text }, vote, _, aborted) => ({
      text: await answer(text, vote, aborted),
      tokens: { input: 100, output: 10 },
    }),
    discard,
  };
  const kinds = createKinds({
    session: opened.session,
    models: signal<ModelCore | null>(core),
    sourceOf: async () => source,
  });
  const cards = () => kinds.asked.value?.cards.map(({ name, state }) => [name, state.kind]) ?? [];
  const names = () => opened.family().found.family.variations.map(({ name }) => name);
  return { ...opened, kinds, cards, names, discard };
}

describe('kinds', () => {
  it('come in by votes, the first six with numbers and a picture, and are kept in one step', async () => {
    const many = ['flask', 'jar', 'vial', 'carafe', 'jug', 'phial', 'demijohn', 'canteen'];
    const { session, kinds, cards, names } = await ready((prompt, vote) =>
      isKinds(prompt) ? kindsReply(...many.slice(0, vote === 0 ? 8 : 7)) : bottle(100 + 10 * vote),
    );
    await kinds.start();
    expect(cards().map(([, state]) => state)).toEqual([...new Array(6).fill('drawn'), 'named', 'named']);
    const [first] = kinds.asked.value?.cards ?? [];
    expect(first).toMatchObject({ name: 'flask', votes: 3, words: 'a flask' });
    expect(first?.state).toMatchObject({ votes: 3, refused: 0, variation: { name: 'flask', absent: ['cap'] } });
    if (first?.state.kind !== 'drawn') throw new Error('not drawn');
    expect(first.state.agreed).toBe(first.state.constraints - 1); // the neck is no longer as high as the shoulder was
    expect(new TextDecoder().decode(first.state.picture.glb.slice(0, 4))).toBe('glTF');
    expect(kinds.asked.value?.spent).toEqual({ calls: 21, tokens: { input: 2100, output: 210 } });

    const before = names();
    await kinds.keep();
    expect(names()).toEqual([...before, ...many.slice(0, 6)]);
    expect(cards().map(([name]) => name)).toEqual(['demijohn', 'canteen']);
    expect(session.undoLabel.value).toBe('keep 6 kinds');
    session.undo();
    expect(names()).toEqual(before);
  });

  it('that are variations already take their place; the others are dropped or drawn one by one', async () => {
    const { kinds, cards, names, family } = await ready((prompt) =>
      isKinds(prompt) ? kindsReply('wine bottle', 'flask') : bottle(150),
    );
    const count = names().length;
    await kinds.start();
    await kinds.keep(['wine bottle']);
    expect(names()).toHaveLength(count);
    expect(family().found.family.variations.find(({ name }) => name === 'wine bottle')?.absent).toEqual(['cap']);
    kinds.drop('flask');
    expect(cards()).toEqual([]);
    await kinds.draw('ink bottle');
    expect(cards()).toEqual([['ink bottle', 'drawn']]);
  });

  it('whose numbers make no sense say so by the part, and can be tried again', async () => {
    let broken = true;
    const { kinds, cards, discard } = await ready((prompt) => {
      if (isKinds(prompt)) return kindsReply('flask', 'jar');
      return kindOf(prompt) === 'jar' && broken ? bottle(-5) : bottle(90);
    });
    await kinds.start();
    expect(cards()).toEqual([
      ['flask', 'drawn'],
      ['jar', 'refused'],
    ]);
    const refused = kinds.asked.value?.cards[1]?.state;
    expect(refused).toMatchObject({ text: expect.stringContaining('/parts/body') });
    broken = false;
    await kinds.draw('jar');
    expect(cards()[1]).toEqual(['jar', 'drawn']);
    expect(discard).not.toHaveBeenCalled();
  });

  it('count without the answers that cannot be read, which are asked anew the next time', async () => {
    const { kinds, discard } = await ready((prompt, vote) =>
      isKinds(prompt) ? kindsReply('flask') : vote === 1 ? 'I cannot say.' : bottle(90),
    );
    await kinds.start();
    expect(kinds.asked.value?.cards[0]?.state).toMatchObject({ kind: 'drawn', votes: 2, refused: 1 });
    expect(discard).toHaveBeenCalledExactlyOnceWith(expect.objectContaining({ task: 'variation' }), 1);
  });

  it('stop when asked to: what is there stays', async () => {
    const { kinds, cards } = await ready((prompt, _, aborted) => {
      if (isKinds(prompt)) return kindsReply('flask', 'jar');
      if (kindOf(prompt) === 'flask') return bottle(90);
      return new Promise((_, reject) => aborted.addEventListener('abort', () => reject(aborted.reason)));
    });
    const running = kinds.start();
    await vi.waitFor(() => expect(cards()[0]).toEqual(['flask', 'drawn']));
    expect(cards()[1]).toEqual(['jar', 'asking']);
    kinds.stop();
    await running;
    expect(cards()).toEqual([
      ['flask', 'drawn'],
      ['jar', 'stopped'],
    ]);
    expect(kinds.asked.value?.isRunning).toBe(false);
    kinds.close();
    expect(kinds.asked.value).toBeNull();
  });

  it('say why nobody can be asked, and whether the settings help', async () => {
    const noKey = new AskError('no_key', '', 'There is no key', 'Enter one');
    const { kinds, session } = await ready(() => {
      throw noKey;
    });
    await kinds.start();
    expect(kinds.asked.value?.failure).toMatchObject({ isSetting: true });
    expect(kinds.asked.value?.isRunning).toBe(false);
    session.replaceDocument({ ...session.document.value, model: null }, 'close');
    expect(kinds.asked.value).toBeNull();
  });
});
