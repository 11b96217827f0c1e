// Why a language model gave no answer: what happened, on whose side, and what to do about it.

import { shortened } from '../program/cut';
import { t } from '../texts/texts';
import type { CoreErrorValue } from '../worker/protocol';

export type AskFailure =
  | 'settings' // no provider, no model, an address that the page may not reach
  | 'no_key'
  | 'wrong_key'
  | 'no_credit'
  | 'forbidden'
  | 'model_unknown'
  | 'request' // the provider refuses the request itself
  | 'rate'
  | 'server'
  | 'timeout'
  | 'blocked' // the browser hides why: CORS, or nobody answers
  | 'offline'
  | 'cut_off'
  | 'unreadable' // the reply is not what the protocol says
  | 'no_recording';

/** Failures that every other call of the request would meet as well. */
const hopeless: readonly AskFailure[] = [
  'settings',
  'no_key',
  'wrong_key',
  'no_credit',
  'forbidden',
  'model_unknown',
  'request',
  'blocked',
  'offline',
  'no_recording',
];

/** Failures that the settings can cure. */
const ofSettings: readonly AskFailure[] = [
  'settings',
  'no_key',
  'wrong_key',
  'no_credit',
  'model_unknown',
  'blocked',
  'no_recording',
];

export class AskError extends Error {
  readonly value: CoreErrorValue;
  constructor(
    readonly kind: AskFailure,
    /** Host, or what else did it. */
    place: string,
    cause: string,
    fix: string,
    /** Milliseconds after which the provider wants to be asked again; null when it does not say. */
    readonly retryAfter: number | null = null,
  ) {
    super(`${place ? `${place} ` : ''}${cause}. ${fix}.`);
    this.name = 'AskError';
    this.value = { stage: 'llm', place, cause, fix };
  }
  get isHopeless(): boolean {
    return hopeless.includes(this.kind);
  }
  get isSetting(): boolean {
    return ofSettings.includes(this.kind);
  }
  /** Somebody answered, but not with what can be used. */
  get isAnswer(): boolean {
    return this.kind === 'cut_off' || this.kind === 'unreadable';
  }
}

const maxQuoted = 200;

/** What a provider says of itself, cut to length and free of control characters. */
export function quoted(text: string): string {
  // biome-ignore lint/suspicious/noControlCharactersInRegex: they are what is taken out
  const plain = text.replace(/[\u0000-\u001f\u007f-\u009f\u202a-\u202e\u2066-\u2069]+/g, ' ').trim();
  return plain === '' ? '' : ` (“${shortened(plain, maxQuoted)}”)`;
}

/** @param said what the body of the refusal says, with its codes */
export function refusal(status: number, said: string, host: string, retryAfter: number | null): AskError {
  const words = quoted(said);
  const error = (kind: AskFailure, cause: string, fix: string) =>
    new AskError(kind, host, `${cause}${words}`, fix, retryAfter);
  const isModel =
    /model/i.test(said) && /not.?found|not.?exist|does not exist|unknown|invalid model|not a valid/i.test(said);
  if (
    status === 402 ||
    /insufficient.?(quota|balance|credit)|credit balance|exceeded your current quota.*billing/i.test(said)
  )
    return error(
      'no_credit',
      t`says that the account has no credit left`,
      t`Top it up there, or choose another provider`,
    );
  if (status === 401 || /api.?key.?(not valid|invalid)|invalid.?api.?key/i.test(said))
    return error(
      'wrong_key',
      t`does not accept the key`,
      t`Check the key in the settings: whole, of this provider, not revoked`,
    );
  if (status === 403)
    return error(
      'forbidden',
      t`refuses this page or this key`,
      t`A server on your machine has to allow this page (Ollama: OLLAMA_ORIGINS); elsewhere the key lacks the right to this model`,
    );
  if (status === 404 || (status === 400 && isModel))
    return error(
      'model_unknown',
      t`does not know this model or this address`,
      t`Check the model’s name and the base URL in the settings`,
    );
  if (status === 429)
    return error(
      'rate',
      t`takes no more requests for the moment`,
      t`Wait a minute, lower the number of votes, or raise the limit there`,
    );
  if (status === 408 || status >= 500)
    return error(
      'server',
      t`has a fault of its own (${status})`,
      t`Try again in a while; answers that came are kept and not paid twice`,
    );
  return error(
    'request',
    t`refuses the request (${status})`,
    t`Choose another model: this one may lack the context or an option that the page asks for`,
  );
}
