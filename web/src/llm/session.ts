// A request is many prompts, each asked several times. Replies that were kept are counted first; then all calls go out at
// once, and a vote that the calls still under way cannot turn any more ends them. Of somebody who was never asked before, the
// first call goes alone, so that a wrong key or a server that is not there costs one. What prompts ask and what replies mean
// is the core's business: here is only the asking.

import type { Inference, MethodResult, Prompt, Replies, Task } from '../worker/protocol';
import type { Tokens } from './adapter';
import type { AskError } from './ask_error';
import { Calls } from './calls';
import type { Source } from './source';

export type PromptSet = MethodResult<'prompts'>;

export interface TaskProgress {
  readonly task: Task;
  /** What it asks about. */
  readonly words: string;
  /** Calls that have ended or are no longer needed. */
  readonly done: number;
  readonly of: number;
}

export interface AskOptions {
  readonly signal: AbortSignal;
  readonly onProgress: (tasks: readonly TaskProgress[]) => void;
}

export interface Answer {
  readonly inference: Inference;
  /** Of the calls that were made now, as far as the provider counts them. */
  readonly tokens: Tokens;
  /** Calls that were made now, and replies that were there already. */
  readonly calls: number;
  readonly kept: number;
  /** Why calls failed, one a call. */
  readonly failures: readonly AskError[];
}

interface Ballot {
  readonly prompt: Prompt;
  readonly of: number;
  /** By vote; undefined while it is missing. */
  readonly texts: (string | undefined)[];
  readonly controller: AbortController;
  pending: number;
}

const given = ({ texts }: Ballot): { vote: number; text: string }[] =>
  texts.flatMap((text, vote) => (text === undefined ? [] : [{ vote, text }]));

/**
 * Asks all prompts and reads the replies.
 * @param read the core's `read_replies`
 * @throws AskError when the seed edit got no reply at all or every call would fail alike; or the signal's reason
 */
export async function ask(
  { prompts, tasks: known }: PromptSet,
  source: Source,
  read: (replies: Replies[]) => Promise<Inference>,
  { signal, onProgress }: AskOptions,
): Promise<Answer> {
  const ballots = prompts.map((prompt): Ballot => {
    const of = source.votes(prompt);
    return { prompt, of, texts: new Array(of).fill(undefined), controller: new AbortController(), pending: of };
  });
  const all = new AbortController();
  const calls = new Calls(source);
  let kept = 0;

  const report = () => {
    const tasks = new Map<Task, { done: number; of: number }>();
    for (const { prompt, of, pending } of ballots) {
      const sum = tasks.get(prompt.task) ?? { done: 0, of: 0 };
      tasks.set(prompt.task, { done: sum.done + of - pending, of: sum.of + of });
    }
    onProgress([...tasks].map(([task, sum]) => ({ task, words: known[task]?.words ?? task, ...sum })));
  };
  const readAll = () =>
    read(ballots.map((ballot) => ({ ...asked(ballot.prompt), texts: given(ballot).map(({ text }) => text) })));

  let changes = 0;
  let isReading = false;
  /** Ends the votes that are decided. One reading at a time; what comes meanwhile makes one more. */
  const endDecided = async () => {
    changes++;
    if (isReading) return;
    isReading = true;
    try {
      for (let seen = 0; seen !== changes; ) {
        seen = changes;
        const pending = ballots.map((ballot) => ballot.pending);
        const inference = await readAll();
        for (const [i, ballot] of ballots.entries())
          if (isDecided(ballot.prompt, pending[i] ?? 0, inference)) ballot.controller.abort(decided);
      }
    } catch {
      // the last reading says what is wrong
    } finally {
      isReading = false;
    }
  };

  /** @param isFirst nobody has answered yet: what keeps the answer away would keep away all others */
  const one = async (ballot: Ballot, vote: number, isFirst = false) => {
    const { prompt, controller } = ballot;
    const own = AbortSignal.any([signal, all.signal, controller.signal]);
    try {
      const reply = await calls.reply(prompt, vote, known[prompt.task]?.schema ?? null, own);
      if (typeof reply === 'string') ballot.texts[vote] = reply;
      else if (reply?.isHopeless || (isFirst && reply?.isAnswer === false)) all.abort(reply);
    } finally {
      ballot.pending--;
      report();
      if (!all.signal.aborted && ballot.pending > 0) void endDecided();
    }
  };

  const votes = ballots.flatMap((ballot) => Array.from({ length: ballot.of }, (_, vote) => ({ ballot, vote })));
  await Promise.all(
    votes.map(async ({ ballot, vote }) => {
      const text = await source.kept(ballot.prompt, vote);
      if (text === undefined) return;
      ballot.texts[vote] = text;
      ballot.pending--;
      kept++;
    }),
  );
  report();
  if (kept > 0) await endDecided();
  const open = votes.filter(({ ballot, vote }) => ballot.texts[vote] === undefined);
  const first =
    source.isProven?.() === false ? open.find(({ ballot }) => !ballot.controller.signal.aborted) : undefined;
  if (first !== undefined) await one(first.ballot, first.vote, true);
  await Promise.all(open.map((next) => (next === first ? null : one(next.ballot, next.vote))));
  signal.throwIfAborted();
  if (all.signal.aborted) throw all.signal.reason;
  const seed = ballots.find(({ prompt }) => prompt.task === 'seed_edit');
  if (seed !== undefined && given(seed).length === 0 && calls.failures[0] !== undefined) throw calls.failures[0];

  const inference = await readAll();
  // What cannot be read is not worth keeping: asked again, the model may do better.
  for (const { task, relation, vote } of inference.refused) {
    const ballot = ballots.find(({ prompt }) => prompt.task === task && prompt.relation === relation);
    const refused = ballot && given(ballot)[vote];
    if (ballot && refused) await source.discard(ballot.prompt, refused.vote);
  }
  return { inference, tokens: calls.tokens, calls: calls.count, kept, failures: calls.failures };
}

const decided = new DOMException('The vote is decided.', 'AbortError');
const asked = ({ task, relation }: Prompt) => ({ task, relation });

/** Whether the calls under way cannot change the outcome. Hints are voted part by part: they always wait for all. */
function isDecided(prompt: Prompt, pending: number, { seed, relations }: Inference): boolean {
  const isMajority = (votes: number, of: number) => 2 * votes > of + pending;
  if (prompt.task === 'seed_edit') {
    const unclear = seed.of - seed.readings.reduce((sum, { votes }) => sum + votes, 0);
    return isMajority(Math.max(seed.readings[0]?.votes ?? 0, unclear), seed.of);
  }
  const relation = relations.find(({ relation: id }) => id === prompt.relation);
  return relation !== undefined && isMajority(relation.votes, relation.of);
}

export interface Estimate {
  readonly calls: number;
  /** About: four characters make a token in English prose. Replies come on top. */
  readonly inputTokens: number;
}

export function estimate(prompts: readonly Prompt[], votes: number): Estimate {
  const characters = prompts.reduce((sum, { text }) => sum + text.length, 0);
  return { calls: prompts.length * votes, inputTokens: Math.round((characters / 4) * votes) };
}
