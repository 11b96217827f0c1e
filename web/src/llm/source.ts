// Where replies come from: a provider, with every reply kept, or the recordings that come with the page.

import type { Prompt } from '../worker/protocol';
import type { Call, Reply, Target } from './adapter';
import { AskError } from './ask_error';
import type { ReplyCache } from './cache';
import { complete, type SendOptions } from './http';
import type { Recordings } from './recordings';

export interface SourcedReply extends Reply {
  /** Whether it was there already, and cost nothing now. */
  readonly kept: boolean;
}

export interface Source {
  /** How often a prompt is asked. */
  votes(prompt: Prompt): number;
  /** @param vote from 0. @throws AskError; or the signal's reason */
  reply(prompt: Prompt, vote: number, schema: object | null, signal: AbortSignal): Promise<SourcedReply>;
  /** A reply that nobody can read: it is asked anew the next time. */
  discard(prompt: Prompt, vote: number): Promise<void>;
}

export interface LiveOptions extends Omit<SendOptions, 'signal'> {
  readonly votes: number;
  readonly cache: ReplyCache;
  /** Asks again what has been answered before. */
  readonly afresh?: boolean;
}

export function liveSource(target: Target, { votes, cache, afresh = false, ...options }: LiveOptions): Source {
  const keyOf = ({ hash }: Prompt, vote: number) => [target.base, target.model, hash, vote].join(' ');
  return {
    votes: () => votes,
    async reply(prompt, vote, schema, signal) {
      const key = keyOf(prompt, vote);
      const kept = afresh ? undefined : await cache.get(key);
      signal.throwIfAborted();
      if (kept !== undefined) return { ...kept, kept: true };
      const call: Call = { prompt: prompt.text, schema };
      const reply = await complete(target, call, { ...options, signal });
      await cache.set(key, reply);
      return { ...reply, kept: false };
    },
    discard: (prompt, vote) => cache.delete(keyOf(prompt, vote)),
  };
}

export function recordedSource({ replies }: Recordings): Source {
  const of = ({ hash }: Prompt) => (Object.hasOwn(replies, hash) ? (replies[hash] ?? []) : []);
  return {
    votes: (prompt) => Math.max(1, of(prompt).length),
    async reply(prompt, vote) {
      const text = of(prompt)[vote];
      if (text === undefined)
        throw new AskError(
          'no_recording',
          '',
          'There is no recorded answer to this request',
          'Choose one of the recorded requests, or enter a key in the settings to ask anything',
        );
      return { text, tokens: null, kept: true };
    },
    discard: async () => {},
  };
}
