// All calls of a request: votes, early stop, failures, cancel, the cache, keys, recordings. The core is a fake that counts
// replies as it would.
import { describe, expect, it, vi } from 'vitest';
import type { Reply, Target } from '../../web/src/llm/adapter';
import { AskError } from '../../web/src/llm/ask_error';
import type { ReplyCache } from '../../web/src/llm/cache';
import { defaultModel, lookedUp } from '../../web/src/llm/default_models';
import { isAllowed, providerOf, providers } from '../../web/src/llm/providers';
import { findRecorded } from '../../web/src/llm/recordings';
import { ask, estimate, type PromptSet, type TaskProgress } from '../../web/src/llm/session';
import { choiceOf, choose, settings } from '../../web/src/llm/settings';
import { liveSource, recordedSource, type Source } from '../../web/src/llm/source';
import type { Inference, Prompt, Replies } from '../../web/src/worker/protocol';

const prompt = (task: Prompt['task'], relation: string | null = null): Prompt => ({
  task,
  relation,
  text: `${task} ${relation}`,
  hash: `hash of ${task} ${relation}`,
  version: '1',
});
const set: PromptSet = {
  prompts: [prompt('seed_edit'), prompt('type_hints'), prompt('relation_validity_reflection', 'r1')],
  tasks: Object.fromEntries(
    ['seed_edit', 'type_hints', 'relation_validity_reflection'].map((name) => [
      name,
      { words: `${name}?`, schema: {} },
    ]),
  ),
};

/** Counts equal texts; `bad` cannot be read, `unclear` is no reading. */
async function read(replies: Replies[]): Promise<Inference> {
  const texts = (task: string) => replies.find((reply) => reply.task === task)?.texts ?? [];
  const seeds = texts('seed_edit').filter((text) => text !== 'bad');
  const readings = [...new Set(seeds.filter((text) => text !== 'unclear'))]
    .map((words) => ({ statements: [], words, votes: seeds.filter((text) => text === words).length }))
    .sort((a, b) => b.votes - a.votes);
  const keeps = texts('relation_validity_reflection');
  const kept = keeps.filter((text) => text === 'keep').length;
  const keep = 2 * kept > keeps.length;
  return {
    seed: { outcome: readings.length > 0 ? 'decided' : 'none', readings, of: seeds.length, reason: null },
    hints: [],
    relations: [{ relation: 'r1', keep, votes: keep ? kept : keeps.length - kept, of: keeps.length, words: '' }],
    refused: replies.flatMap(({ task, relation, texts: all }) =>
      all.flatMap((text, vote) =>
        text === 'bad'
          ? [{ task, relation, vote, error: { stage: 'infer', place: '', cause: 'no JSON', fix: '' } }]
          : [],
      ),
    ),
    edit: null,
  };
}

type Reaction = string | AskError | 'never';
/** @param react what each call does; undefined: says the task's name at once */
function fakeSource(votes: number, react: (task: string, vote: number) => Reaction | undefined) {
  const aborted: string[] = [];
  const discarded: string[] = [];
  const source: Source = {
    votes: () => votes,
    kept: async () => undefined,
    async reply({ task }, vote, _, signal) {
      const reaction = react(task, vote) ?? (task === 'relation_validity_reflection' ? 'keep' : task);
      if (reaction instanceof AskError) throw reaction;
      if (reaction === 'never') {
        await new Promise((_resolve, reject) =>
          signal.addEventListener('abort', () => {
            aborted.push(`${task} ${vote}`);
            reject(signal.reason);
          }),
        );
      }
      return { text: reaction, tokens: { input: 10, output: 1 } };
    },
    discard: async ({ task }, vote) => void discarded.push(`${task} ${vote}`),
  };
  return { source, aborted, discarded };
}

const run = (
  source: Source,
  options: { signal?: AbortSignal; onProgress?: (tasks: readonly TaskProgress[]) => void } = {},
) =>
  ask(set, source, read, {
    signal: options.signal ?? new AbortController().signal,
    onProgress: options.onProgress ?? (() => {}),
  });

const passing = new AskError('server', 'host', 'has a fault', 'Try again');
const wrongKey = new AskError('wrong_key', 'host', 'does not accept the key', 'Check it');

describe('asking', () => {
  it('collects five votes of every prompt and counts tokens', async () => {
    const answer = await run(fakeSource(5, () => undefined).source);
    expect(answer.inference.seed).toMatchObject({ of: 5, readings: [{ words: 'seed_edit', votes: 5 }] });
    expect(answer).toMatchObject({ calls: 15, kept: 0, tokens: { input: 150, output: 15 }, failures: [] });
  });

  it('tells how far each task is', async () => {
    const onProgress = vi.fn();
    await run(fakeSource(2, () => undefined).source, { onProgress });
    const all = (done: number) => set.prompts.map(({ task }) => ({ task, words: `${task}?`, done, of: 2 }));
    expect(onProgress.mock.calls[0]?.[0]).toEqual(all(0));
    expect(onProgress.mock.calls.at(-1)?.[0]).toEqual(all(2));
    expect(onProgress.mock.calls).toHaveLength(7);
  });

  it('ends the calls that cannot turn a vote, and no others', async () => {
    const { source, aborted } = fakeSource(5, (task, vote) =>
      vote > 2 && task !== 'type_hints' ? 'never' : undefined,
    );
    const answer = await run(source);
    expect(aborted.sort()).toEqual(
      ['relation_validity_reflection 3', 'relation_validity_reflection 4', 'seed_edit 3', 'seed_edit 4'].sort(),
    );
    expect(answer.inference.seed.readings[0]?.votes).toBe(3);
  });

  it('does not ask for votes that kept replies decide', async () => {
    const { source } = fakeSource(5, () => undefined);
    const reply = vi.spyOn(source, 'reply');
    source.kept = async ({ task }, vote) => (vote < 3 ? (task === 'seed_edit' ? 'wider' : 'keep') : undefined);
    const answer = await run(source);
    expect(answer).toMatchObject({ kept: 9, calls: 2 });
    expect(reply.mock.calls.map(([{ task }]) => task)).toEqual(['type_hints', 'type_hints']);
  });

  it('waits while a vote can still turn', async () => {
    const controller = new AbortController();
    const { source, aborted } = fakeSource(5, (task, vote) => {
      if (task !== 'seed_edit') return undefined;
      return vote === 4 ? 'never' : `reading ${vote % 2}`;
    });
    const running = run(source, { signal: controller.signal });
    await new Promise((resolve) => setTimeout(resolve, 30));
    expect(aborted).toEqual([]);
    controller.abort();
    await expect(running).rejects.toThrow('aborted');
  });

  it('does without the calls that failed, and says which did', async () => {
    const { source } = fakeSource(5, (task, vote) => (vote === 1 || task === 'type_hints' ? passing : undefined));
    const answer = await run(source);
    expect(answer.inference.seed.of).toBe(4);
    expect(answer.failures).toHaveLength(7);
  });

  it('fails when nothing is known of the seed edit', async () => {
    const { source } = fakeSource(5, (task) => (task === 'seed_edit' ? passing : undefined));
    await expect(run(source)).rejects.toBe(passing);
  });

  it('ends everything at a failure that all calls would meet', async () => {
    const { source, aborted } = fakeSource(3, (task, vote) =>
      task === 'type_hints' && vote === 0 ? wrongKey : 'never',
    );
    await expect(run(source)).rejects.toBe(wrongKey);
    expect(aborted).toHaveLength(8);
  });

  it('cancels every call', async () => {
    const controller = new AbortController();
    const { source, aborted } = fakeSource(9, () => 'never');
    const running = run(source, { signal: controller.signal });
    await new Promise((resolve) => setTimeout(resolve, 10));
    controller.abort();
    await expect(running).rejects.toThrow('aborted');
    expect(aborted).toHaveLength(27);
  });

  it('asks anew, the next time, for what could not be read', async () => {
    const { source, discarded } = fakeSource(3, (task, vote) =>
      task === 'seed_edit' && vote === 2 ? 'bad' : undefined,
    );
    await run(source);
    expect(discarded).toEqual(['seed_edit 2']);
  });

  describe('somebody who was never asked', () => {
    function unproven(react: (task: string, vote: number) => Reaction | undefined) {
      const fake = fakeSource(3, react);
      const reply = vi.spyOn(fake.source, 'reply');
      const known = { isProven: false };
      fake.source.isProven = () => known.isProven;
      return { ...fake, reply, known };
    }

    it('is asked one question, and all others once that is answered', async () => {
      const { source, reply } = unproven(() => undefined);
      const answer: ((reply: Reply) => void)[] = [];
      reply.mockReturnValueOnce(new Promise((resolve) => answer.push(resolve)));
      const running = run(source);
      await new Promise((resolve) => setTimeout(resolve, 30));
      expect(reply).toHaveBeenCalledTimes(1);
      answer[0]?.({ text: 'seed_edit', tokens: null });
      expect((await running).calls).toBe(9);
    });

    it.each([wrongKey, passing, new AskError('timeout', 'host', 'gave no answer', 'Try again')])(
      'costs one call when it fails: $kind',
      async (error) => {
        const { source, reply } = unproven(() => error);
        await expect(run(source)).rejects.toBe(error);
        expect(reply).toHaveBeenCalledTimes(1);
      },
    );

    it('is there when its first answer cannot be used', async () => {
      const cut = new AskError('cut_off', 'host', 'cut the reply off', 'Try again');
      const { source } = unproven((task, vote) => (task === 'seed_edit' && vote === 0 ? cut : undefined));
      const answer = await run(source);
      expect(answer).toMatchObject({ calls: 8, failures: [cut] });
    });

    it('is asked for everything at once when it has answered before', async () => {
      const { source, reply, known } = unproven(() => 'never');
      known.isProven = true;
      const controller = new AbortController();
      const running = run(source, { signal: controller.signal });
      await new Promise((resolve) => setTimeout(resolve, 10));
      expect(reply).toHaveBeenCalledTimes(9);
      controller.abort();
      await expect(running).rejects.toThrow('aborted');
    });

    it('answers first for what kept replies leave open', async () => {
      const { source, reply } = unproven(() => undefined);
      source.kept = async ({ task }) => (task === 'seed_edit' ? 'wider' : undefined);
      await run(source);
      expect(reply.mock.calls[0]?.[0].task).toBe('type_hints');
    });
  });

  it('estimates calls and tokens before', () => {
    const text = 'x'.repeat(4000);
    expect(estimate([{ ...prompt('seed_edit'), text }], 5)).toEqual({ calls: 5, inputTokens: 5000 });
  });
});

describe('replies that were paid for', () => {
  function memoryCache(): ReplyCache & { map: Map<string, Reply> } {
    const map = new Map<string, Reply>();
    return {
      map,
      get: async (key) => map.get(key),
      set: async (key, reply) => void map.set(key, reply),
      delete: async (key) => void map.delete(key),
    };
  }
  const provider = providerOf('openai');
  if (provider === undefined) throw new Error('no provider');
  const target: Target = { provider, base: provider.base, model: 'm', key: 'k' };
  const body = { choices: [{ finish_reason: 'stop', message: { content: 'wider' } }], usage: null };

  it('are not asked for again, but for other votes, models and hosts', async () => {
    const cache = memoryCache();
    const fetch = vi.fn(async () => Response.json(body));
    const signal = new AbortController().signal;
    const reply = async (change: Partial<Target>, vote: number, afresh = false) => {
      const source = liveSource({ ...target, ...change }, { votes: 5, cache, fetch, afresh });
      const kept = await source.kept(prompt('seed_edit'), vote);
      return kept ?? (await source.reply(prompt('seed_edit'), vote, null, signal)).text;
    };
    expect(await reply({}, 0)).toBe('wider');
    expect(await reply({}, 0)).toBe('wider');
    expect(fetch).toHaveBeenCalledTimes(1);
    await reply({}, 1);
    await reply({ model: 'other' }, 0);
    await reply({ base: 'http://localhost:1' }, 0);
    await reply({}, 0, true);
    expect(fetch).toHaveBeenCalledTimes(5);
    expect(JSON.stringify([...cache.map])).not.toContain('"k"');
  });

  it('prove whom they came from, by address, model and key', async () => {
    const fetch = vi.fn(async () => Response.json(body));
    const options = { votes: 1, cache: memoryCache(), fetch };
    const isProven = (change: Partial<Target> = {}) => liveSource({ ...target, ...change }, options).isProven?.();
    const own = { model: 'never asked before' };
    expect(isProven(own)).toBe(false);
    await liveSource({ ...target, ...own }, options).reply(prompt('seed_edit'), 0, null, new AbortController().signal);
    expect(isProven(own)).toBe(true);
    expect(isProven({ ...own, key: 'another' })).toBe(false);
    expect(isProven({ ...own, base: 'http://localhost:1' })).toBe(false);
  });

  it('are kept when another call of the request fails', async () => {
    const cache = memoryCache();
    let fails = true;
    const fetch = vi.fn(async (_: unknown, init?: RequestInit) =>
      fails && String(init?.body).includes('type_hints') ? new Response('{}', { status: 401 }) : Response.json(body),
    );
    const source = () => liveSource(target, { votes: 1, cache, fetch: fetch as typeof globalThis.fetch });
    // The refused call comes last.
    const ordered = { ...set, prompts: [set.prompts[0], set.prompts[2], set.prompts[1]] as Prompt[] };
    const options = { signal: new AbortController().signal, onProgress: () => {} };
    await expect(ask(ordered, source(), read, options)).rejects.toThrow('does not accept the key');
    const before = cache.map.size;
    fails = false;
    const answer = await ask(ordered, source(), read, options);
    expect(answer.kept).toBe(before);
    expect(answer.calls).toBe(3 - before);
  });
});

describe('recordings', () => {
  const recordings = {
    requests: [{ request: 'widen the chair', mentioned: ['seat'] }],
    replies: { [prompt('seed_edit').hash]: ['one', 'two'] },
    models: ['m'],
  };
  it('are found however the request ends', () => {
    expect(findRecorded(recordings, ' Widen  the chair. ', ['seat'])?.request).toBe('widen the chair');
    expect(findRecorded(recordings, 'widen the chair', [])).toBeUndefined();
    expect(findRecorded(null, 'widen the chair', [])).toBeUndefined();
  });
  it('give their votes, and say kindly that there are none', async () => {
    const source = recordedSource(recordings);
    const signal = new AbortController().signal;
    expect(source.votes(prompt('seed_edit'))).toBe(2);
    expect(await source.kept(prompt('seed_edit'), 1)).toBe('two');
    expect(await source.kept(prompt('type_hints'), 0)).toBeUndefined();
    await expect(source.reply(prompt('type_hints'), 0, null, signal)).rejects.toThrow(
      /no recorded answer.*enter a key/,
    );
  });
});

describe('default models', () => {
  it('are there for every provider, and for none besides', () => {
    for (const { id } of providers) expect(defaultModel(id), id).not.toBe('');
    expect(defaultModel('recorded')).toBe('');
    expect(Date.parse(lookedUp)).toBeLessThan(Date.now());
  });
  it('are asked until another is named, and follow the table as long as none is', () => {
    choose('openai', {});
    expect(choiceOf('openai').model).toBe(defaultModel('openai'));
    expect(settings.value.choices.openai?.model).toBe('');
    choose('openai', { model: 'my-own' });
    expect(choiceOf('openai').model).toBe('my-own');
    choose('openai', { model: ' ' });
    expect(choiceOf('openai').model).toBe(defaultModel('openai'));
  });
});

describe('addresses', () => {
  it('are those of the policy and nothing else', () => {
    for (const { base } of providers) expect(isAllowed(base), base).toBe(true);
    expect(isAllowed('http://127.0.0.1:8080/v1')).toBe(true);
    for (const address of [
      'https://evil.example/v1',
      'https://api.openai.com.evil.example/v1',
      'https://api.openai.com@evil.example/',
      'http://api.openai.com/v1',
      'https://localhost/v1',
      'http://localhost.evil.example/',
      'javascript:alert(1)',
      'v1',
      '',
    ])
      expect(isAllowed(address), address).toBe(false);
  });
});
