// What the three protocols have in common: a call, its reply, and the two ways in which a reply is none.
import { t } from '../texts/texts';
import { AskError } from './ask_error';
import type { Provider } from './providers';

/** Tokens that a reply may have. Reasoning models think within it. */
export const outputBudget = 16384;

export interface Target {
  readonly provider: Provider;
  /** Like Provider.base, without a slash at the end. */
  readonly base: string;
  readonly model: string;
  /** Empty for servers that want none. */
  readonly key: string;
}

export interface Call {
  readonly prompt: string;
  /** JSON schema to hold the reply to, or null. */
  readonly schema: object | null;
  /** What goes along: a PNG in base64. */
  readonly picture?: string;
}

export interface Tokens {
  readonly input: number;
  readonly output: number;
}

export interface Reply {
  readonly text: string;
  /** As counted by the provider; null when it does not say. */
  readonly tokens: Tokens | null;
}

/** A protocol: how a call is put and how its answer is read. */
export interface Adapter {
  request(target: Target, call: Call): { url: string; headers: Record<string, string>; body: object };
  /** The text of the answer. @throws AskError when it is cut off, refused or of another form */
  read(json: unknown, host: string): string;
  /** As counted by the provider, of an answer that is cut off as well; null when it does not say. */
  tokens(json: unknown): Tokens | null;
  /** Where the provider lists its models. */
  models(target: Target): { url: string; headers: Record<string, string> };
}

export const unreadable = (host: string): AskError =>
  new AskError(
    'unreadable',
    host,
    t`answered in a form that this page cannot read`,
    t`Check that the base URL is that of the API, or try again`,
  );

export const cutOff = (host: string): AskError =>
  new AskError(
    'cut_off',
    host,
    t`cut the reply off before its end (${outputBudget} tokens were allowed)`,
    t`Try again, or choose a model that thinks less or has a longer context`,
  );
