// Asking a language model for requests: the prompt of a task that proposes, with a picture of the model where the model that
// is asked can see, and its replies. What each proposal means is read like any request.

import { AskError } from '../llm/ask_error';
import { type Answer, type AskOptions, ask } from '../llm/session';
import type { Source } from '../llm/source';
import { t } from '../texts/texts';
import type { Inference, Prompt } from '../worker/protocol';
import type { EditInput, OpenModel } from './document';
import type { ModelCore } from './model_core';

/** Tasks that propose, as prompts/ names them; a request where they are about one. */
export type About =
  | { readonly task: 'procedural_requests' }
  | { readonly task: 'request_variations'; readonly request: string };

/** A picture of the model with numbers on its parts, as the base64 of a PNG; null where there is nothing to draw with. */
export type PaintNumbered = (numbered: readonly string[]) => string | null;

/** Whom to ask. */
export interface Asker {
  /** Reads requests. */
  readonly reader: Source;
  /**
   * Answers the prompt of a task that proposes. Null: it has no answer, or whoever is asked cannot see.
   * @param picture what goes along; null for a prompt that speaks of none
   */
  proposer(prompt: Prompt, picture: (() => string | null) | null): Source | null;
  /** Whoever was asked refused a prompt with a picture. */
  isBlind(): void;
}

export type Proposed = NonNullable<Inference['proposals']> & Spent;

/** What asking took, as far as the provider counts it. */
export interface Spent {
  readonly calls: number;
  readonly tokens: { readonly input: number; readonly output: number };
}

export const nothingSpent: Spent = { calls: 0, tokens: { input: 0, output: 0 } };
export const plus = (a: Spent, b: Spent): Spent => ({
  calls: a.calls + b.calls,
  tokens: { input: a.tokens.input + b.tokens.input, output: a.tokens.output + b.tokens.output },
});

/** A task that is asked on its own, and the request that it is about, if any. */
export interface Alone {
  readonly task: string;
  readonly request: string;
}

/**
 * What comes of a task that is asked on its own: with a picture where whoever is asked can see one, else without.
 * @param meaning what is wanted of the answer; it throws when that is not in it
 * @throws AskError when nobody can be asked, or what `meaning` throws; or the signal's reason
 */
export async function askAlone<T>(
  core: ModelCore,
  model: OpenModel,
  { task, request }: Alone,
  asker: Pick<Asker, 'proposer' | 'isBlind'>,
  paint: PaintNumbered,
  options: AskOptions,
  meaning: (answer: Answer) => T,
): Promise<T> {
  const once = async (picture: boolean): Promise<T | null> => {
    const asked = { task, request, mentioned: [], count: 0, picture };
    const { prompt, words, schema, numbered } = await core.proposalPrompt(model, asked);
    const source = asker.proposer(prompt, picture ? () => paint(numbered) : null);
    if (source === null) return null;
    const answer = await ask(
      { prompts: [prompt], tasks: { [prompt.task]: { words, schema } } },
      source,
      (replies) => core.readReplies(model, request, replies),
      options,
    );
    return meaning(answer);
  };
  let seen: T | null = null;
  try {
    seen = await once(true);
  } catch (error) {
    if (!(error instanceof AskError && error.kind === 'request')) throw error;
    asker.isBlind();
  }
  const found = seen ?? (await once(false));
  if (found === null) throw unusable(t`nobody can be asked`);
  return found;
}

/** @throws AskError when there is no reply that can be read; or the signal's reason */
export function propose(
  core: ModelCore,
  model: OpenModel,
  about: About,
  asker: Asker,
  paint: PaintNumbered,
  signal: AbortSignal,
): Promise<Proposed> {
  const alone = { task: about.task, request: about.task === 'request_variations' ? about.request : '' };
  return askAlone(core, model, alone, asker, paint, { signal, onProgress: () => {} }, (answer) => {
    const { inference, calls, tokens } = answer;
    const { requests = [], dropped = [] } = inference.proposals ?? {};
    if (requests.length > 0) return { requests, dropped, calls, tokens };
    throw whyUnread(answer) ?? unusable(dropped[0]?.reason);
  });
}

/** Why an answer holds nothing, where calls failed or replies were refused. */
export function whyUnread({ inference, failures }: Answer): AskError | undefined {
  const [refused] = inference.refused;
  return failures[0] ?? (refused && unusable(refused.error.cause));
}

export const unusable = (why = t`it proposes nothing`) =>
  new AskError('unreadable', '', t`The answer could not be used: ${why}`, t`Ask again, or ask another language model`);

/** What a proposed request means. Which symmetries may go is not asked: it would be many times as many questions. */
export async function readProposal(
  core: ModelCore,
  model: OpenModel,
  request: string,
  source: Source,
  signal: AbortSignal,
): Promise<{ readonly edit: EditInput | null; readonly why: string } & Spent> {
  const { prompts, tasks } = await core.prompts(model, request, []);
  const { inference, calls, tokens } = await ask(
    { prompts: prompts.filter(({ relation }) => relation === null), tasks },
    source,
    (replies) => core.readReplies(model, request, replies),
    { signal, onProgress: () => {} },
  );
  const edit = inference.edit === null ? null : { seed: [], disabled: [], hints: {}, ...inference.edit };
  const why = inference.seed.reason ?? inference.refused[0]?.error.cause ?? t`no answer could be read`;
  return { edit, why, calls, tokens };
}
