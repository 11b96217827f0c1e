// What asking has cost since the page was opened, as the providers count it: by provider and model.
import { signal } from '@preact/signals';
import type { Target, Tokens } from './adapter';

export interface Spending extends Tokens {
  /** A provider's id. */
  readonly provider: string;
  readonly model: string;
  /** Answers that came, those that were cut off included. */
  readonly answers: number;
  /** Of them, those whose tokens the provider did not say. */
  readonly uncounted: number;
}

export const spent = signal<readonly Spending[]>([]);

/** @param tokens null when the provider does not say */
export function addSpending({ provider, model }: Pick<Target, 'provider' | 'model'>, tokens: Tokens | null): void {
  const all = spent.peek();
  const isThis = (one: Spending) => one.provider === provider.id && one.model === model;
  const before = all.find(isThis) ?? { provider: provider.id, model, answers: 0, uncounted: 0, input: 0, output: 0 };
  const after: Spending = {
    ...before,
    answers: before.answers + 1,
    uncounted: before.uncounted + (tokens === null ? 1 : 0),
    input: before.input + (tokens?.input ?? 0),
    output: before.output + (tokens?.output ?? 0),
  };
  spent.value = all.some(isThis) ? all.map((one) => (isThis(one) ? after : one)) : [...all, after];
}
