// One prompt, asked several times: replies that were kept count first, then all others are asked for at once.
import type { Prompt } from '../worker/protocol';
import type { Tokens } from './adapter';
import { Calls } from './calls';
import type { Source } from './source';

export interface Votes {
  /** By vote, without those that failed. */
  readonly texts: readonly { readonly vote: number; readonly text: string }[];
  /** Calls that were made now, and their tokens as far as the provider counts them. */
  readonly calls: number;
  readonly tokens: Tokens;
}

/**
 * @param onVote told how many of the votes are there
 * @throws AskError when every call failed, or would fail alike; or the signal's reason
 */
export async function askVotes(
  prompt: Prompt,
  schema: object,
  source: Source,
  signal: AbortSignal,
  onVote: (done: number, of: number) => void,
): Promise<Votes> {
  const of = source.votes(prompt);
  const texts: { vote: number; text: string }[] = [];
  const calls = new Calls(source);
  const all = new AbortController();
  let done = 0;

  const kept = await Promise.all(Array.from({ length: of }, (_, vote) => source.kept(prompt, vote)));
  for (const [vote, text] of kept.entries()) if (text !== undefined) texts.push({ vote, text });
  done = texts.length;
  onVote(done, of);
  const one = async (vote: number) => {
    const own = AbortSignal.any([signal, all.signal]);
    try {
      const reply = await calls.reply(prompt, vote, schema, own);
      if (typeof reply === 'string') texts.push({ vote, text: reply });
      else if (reply?.isHopeless) all.abort(reply);
    } finally {
      onVote(++done, of);
    }
  };
  await Promise.all(kept.map((text, vote) => (text === undefined ? one(vote) : null)));
  signal.throwIfAborted();
  if (all.signal.aborted) throw all.signal.reason;
  if (texts.length === 0 && calls.failures[0] !== undefined) throw calls.failures[0];
  return { texts: texts.sort((a, b) => a.vote - b.vote), calls: calls.count, tokens: calls.tokens };
}
