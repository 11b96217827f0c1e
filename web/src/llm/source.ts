// Where replies come from: a provider, with every reply kept, or the recordings that come with the page.

import { t } from '../texts/texts';
import type { Prompt } from '../worker/protocol';
import type { Call, Reply, Target } from './adapter';
import { AskError } from './ask_error';
import type { ReplyCache } from './cache';
import { complete, type SendOptions } from './http';
import type { Recordings } from './recordings';

export interface Source {
  /** Whether it has answered before. Of one that has not, the first call goes alone: see ask(). Left out: it costs nothing. */
  isProven?(): boolean;
  /** How often a prompt is asked. */
  votes(prompt: Prompt): number;
  /** The text of a reply that is there already and costs nothing. @param vote from 0 */
  kept(prompt: Prompt, vote: number): Promise<string | undefined>;
  /** Asks. @throws AskError; or the signal's reason */
  reply(prompt: Prompt, vote: number, schema: object | null, signal: AbortSignal): Promise<Reply>;
  /** A reply that nobody can read: it is asked anew the next time. */
  discard(prompt: Prompt, vote: number): Promise<void>;
}

export interface LiveOptions extends Omit<SendOptions, 'signal'> {
  readonly votes: number;
  readonly cache: ReplyCache;
  /** Asks again what has been answered before. */
  readonly afresh?: boolean;
  /** What goes along with every prompt: see Call. */
  readonly picture?: string;
}

/** Whom a call has reached since the page was opened: base, model and key together. */
const proven = new Set<string>();

export function liveSource(target: Target, { votes, cache, afresh = false, picture, ...options }: LiveOptions): Source {
  const keyOf = ({ hash }: Prompt, vote: number) => [target.base, target.model, hash, vote].join(' ');
  const whom = [target.base, target.model, target.key].join(' ');
  return {
    isProven: () => proven.has(whom),
    votes: () => votes,
    kept: async (prompt, vote) => (afresh ? undefined : (await cache.get(keyOf(prompt, vote)))?.text),
    async reply(prompt, vote, schema, signal) {
      const call: Call = { prompt: prompt.text, schema, ...(picture === undefined ? {} : { picture }) };
      const reply = await complete(target, call, { ...options, signal });
      proven.add(whom);
      await cache.set(keyOf(prompt, vote), reply);
      return reply;
    },
    discard: (prompt, vote) => cache.delete(keyOf(prompt, vote)),
  };
}

/** What is said of a prompt without a recording. */
const nothingRecorded = () => ({
  cause: t`There is no recorded answer to this request`,
  fix: t`Choose one of the recorded requests, or enter a key in the settings to ask anything`,
});

export function recordedSource({ replies }: Recordings, { cause, fix } = nothingRecorded()): Source {
  const of = ({ hash }: Prompt) => (Object.hasOwn(replies, hash) ? (replies[hash] ?? []) : []);
  return {
    votes: (prompt) => Math.max(1, of(prompt).length),
    kept: async (prompt, vote) => of(prompt)[vote],
    async reply() {
      throw new AskError('no_recording', '', cause, fix);
    },
    discard: async () => {},
  };
}
