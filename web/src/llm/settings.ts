// Whom to ask and how: everything that the settings dialog holds but the key. Kept in the browser; the key is not here.

import { computed, effect, signal } from '@preact/signals';
import * as v from 'valibot';
import { t } from '../texts/texts';
import type { Target, Tokens } from './adapter';
import { AskError } from './ask_error';
import { defaultModel } from './default_models';
import { keyFor } from './keys';
import { isAllowed, isLocal, providerOf, titleOfProvider } from './providers';

/** The recorded answers that come with the page, which need no key. */
export const recorded = 'recorded';
export const maxVotes = 9;
/**
 * Answers to each question where no number was chosen: as many as were measured to help (tests/eval/README.md). Of requests
 * one reads as many rightly as three; kinds of a thing are found by counting.
 */
export const measuredVotes = { request: 1, names: 3, kinds: 5 } as const;
export type Asked = keyof typeof measuredVotes;

const price = v.fallback(v.nullable(v.pipe(v.number(), v.minValue(0))), null);
const settingsSchema = v.object({
  /** A provider's id, or `recorded`. */
  provider: v.fallback(
    v.pipe(
      v.string(),
      v.check((id) => id === recorded || providerOf(id) !== undefined),
    ),
    recorded,
  ),
  /** Of each provider that was ever chosen. */
  choices: v.fallback(
    v.record(
      v.string(),
      v.object({
        base: v.fallback(v.string(), ''),
        model: v.fallback(v.string(), ''),
        /** In any currency, for a million tokens; null: not known. */
        inputPrice: price,
        outputPrice: price,
      }),
    ),
    {},
  ),
  /** Answers to each question; null: see votesFor(). */
  votes: v.fallback(v.nullable(v.pipe(v.number(), v.integer(), v.minValue(1), v.maxValue(maxVotes))), null),
});
export type Settings = v.InferOutput<typeof settingsSchema>;
export type Choice = Settings['choices'][string];

const storageKey = 'parsel-model';

function stored(): Settings {
  try {
    return v.parse(settingsSchema, JSON.parse(localStorage.getItem(storageKey) ?? '{}'));
  } catch {
    return v.parse(settingsSchema, {});
  }
}

export const settings = signal<Settings>(stored());
effect(() => {
  try {
    localStorage.setItem(storageKey, JSON.stringify(settings.value));
  } catch {
    // it lasts as long as the page, then
  }
});

export const isDemo = computed(() => settings.value.provider === recorded);

/** What was entered for a provider; the model is empty when none was named. */
export function enteredOf(provider: string): Choice {
  const base = providerOf(provider)?.base ?? '';
  return settings.value.choices[provider] ?? { base, model: '', inputPrice: null, outputPrice: null };
}

/** The same with the default model where none was named. */
export function choiceOf(provider: string): Choice {
  const entered = enteredOf(provider);
  return { ...entered, model: entered.model.trim() || defaultModel(provider) };
}

/** How often a question is asked: as often as was chosen; else a model on the present machine, which is slow, once. */
export function votesFor(asked: Asked): number {
  const { votes, provider } = settings.peek();
  return votes ?? (isLocal(choiceOf(provider).base) ? 1 : measuredVotes[asked]);
}

export function choose(provider: string, change: Partial<Choice>): void {
  const { choices } = settings.peek();
  settings.value = {
    ...settings.peek(),
    provider,
    choices: { ...choices, [provider]: { ...enteredOf(provider), ...change } },
  };
}

/** Whom the present settings ask. @throws AskError that says what is missing */
export function currentTarget(): Target {
  const provider = providerOf(settings.peek().provider);
  if (provider === undefined)
    throw new AskError('settings', '', t`No provider is chosen`, t`Choose one in the settings`);
  const { base, model } = choiceOf(provider.id);
  if (!isAllowed(base))
    throw new AskError(
      'settings',
      base || t`The base URL`,
      t`is not an address that this page may talk to`,
      t`Only the listed providers and http://localhost are open to it: choose one of them in the settings`,
    );
  const { key } = keyFor(base);
  if (key === '' && provider.keysAt !== null)
    throw new AskError(
      'no_key',
      titleOfProvider(provider),
      t`wants a key`,
      t`Enter one in the settings, or switch to the recorded answers there`,
    );
  return { provider, base: base.replace(/\/+$/, ''), model, key };
}

/** What tokens cost at the prices of the settings; null when a price is not known. */
export function costOf({ input, output }: Tokens, provider = settings.value.provider): number | null {
  const { inputPrice, outputPrice } = choiceOf(provider);
  if (inputPrice === null || outputPrice === null) return null;
  return (input * inputPrice + output * outputPrice) / 1e6;
}
