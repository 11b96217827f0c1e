// What the page offers without a key has its answers: every prompt of a recorded request, as the core renders it today, has
// a recording that the core can read, and no recording belongs to a prompt of yesterday.
import { beforeAll, describe, expect, it } from 'vitest';
import type { Inference, Prompt, Replies } from '../../web/src/worker/protocol';
import {
  compare,
  type Recording,
  type RenderedRequest,
  readRecordings,
  readRequests,
  renderAll,
  renderRequests,
} from '../../web/tools/prompts.mjs';
import { readReplies, variantPrompts, variants } from '../eval/variants.mjs';
import { type Caller, callerOf, loadWithCad } from './module';

let core: Caller;
beforeAll(async () => {
  core = callerOf(await loadWithCad());
});

describe('the recorded requests', () => {
  it('are whole and of today', () => {
    const recordings = readRecordings();
    const { missing, stale } = compare(renderAll(core, recordings), recordings);
    expect(
      missing.map(({ model, request, prompt }) => `${model}: ${request}: ${prompt.task} ${prompt.relation}`),
    ).toEqual([]);
    expect(stale).toEqual([]);
  });

  it('are each understood, or said to be unclear', () => {
    const recordings = readRecordings();
    const { offered } = compare(renderRequests(core, readRequests()), recordings);
    for (const { model, request, mentioned, prompts } of offered) {
      // Opens the model again.
      renderRequests(core, [{ model, request, mentioned: mentioned ?? [] }]);
      const replies: Replies[] = prompts.map(({ task, relation, hash }) => ({
        task,
        relation,
        texts: (recordings.get(hash)?.replies ?? []).map(({ text }) => text),
      }));
      const inference = core('read_replies', { request, replies }).result as Inference;
      if (inference.seed.outcome === 'unclear') {
        expect(inference.seed.reason, `${model}: ${request}`).toMatch(/\w/);
        continue;
      }
      expect(inference.seed.outcome, `${model}: ${request}`).toBe('decided');
      expect(() => core('propagate', { edit: inference.edit }), `${model}: ${request}`).not.toThrow();
    }
  });
});

describe.each(variants)('the variant %s that is measured', (variant) => {
  it('has a reply to each of its prompts, and none to a prompt of yesterday', () => {
    const prompts = renderRequests(core, readRequests()).flatMap((rendered) =>
      variantPrompts(variant, rendered.prompts),
    );
    const { replies } = readReplies(variant);
    expect(new Set(Object.keys(replies))).toEqual(new Set(prompts.map(({ hash }) => hash)));
  });

  it('says the same as the page, but for what it leaves out', () => {
    const [rendered] = renderRequests(core, readRequests());
    for (const prompt of variantPrompts(variant, rendered?.prompts ?? [])) {
      expect(prompt.text).toContain('"widen the chair"');
      expect(prompt.text).toContain('leg_front_left');
      expect(prompt.text.includes('# Worked examples')).toBe(!['no_examples', 'naive'].includes(variant));
      expect(/think first/i.test(prompt.text)).toBe(!['no_thinking', 'naive'].includes(variant));
    }
  });
});

describe('the comparison', () => {
  const prompt = (hash: string): Prompt => ({ task: 'seed_edit', relation: null, text: hash, hash, version: '1' });
  const request = (name: string, hashes: string[]): RenderedRequest => ({
    model: 'chair',
    request: name,
    prompts: hashes.map(prompt),
    tasks: {},
  });
  const recording = (hash: string, votes = 1): [string, Recording] => [
    hash,
    {
      hash,
      task: 'seed_edit',
      model: 'm',
      date: '',
      replies: Array.from({ length: votes }, (_, vote) => ({ vote, text: '' })),
    },
  ];

  it('tells what is offered, open, missing and stale', () => {
    const rendered = [request('whole', ['a', 'b']), request('half', ['c', 'd']), request('none', ['e'])];
    const found = compare(
      rendered,
      new Map([recording('a'), recording('b'), recording('c'), recording('d', 0), recording('x')]),
    );
    expect(found.offered.map((entry) => entry.request)).toEqual(['whole']);
    expect(found.open.map((entry) => entry.request)).toEqual(['none']);
    expect(found.missing.map((entry) => entry.prompt.hash)).toEqual(['d']);
    expect(found.stale).toEqual(['x']);
  });
});
