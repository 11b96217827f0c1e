// Which cards and groups of cards are folded to one line. Lasts as long as the page.
import { type ReadonlySignal, signal } from '@preact/signals';

const cards = signal<ReadonlySet<number>>(new Set());
const groups = signal<ReadonlySet<string>>(new Set());

/** Keys of the layers whose cards are folded. */
export const folded: ReadonlySignal<ReadonlySet<number>> = cards;
/** Names of the groups that are. */
export const foldedGroups: ReadonlySignal<ReadonlySet<string>> = groups;

const toggled = <T>(set: ReadonlySet<T>, item: T): ReadonlySet<T> => {
  const next = new Set(set);
  if (!next.delete(item)) next.add(item);
  return next;
};

export const toggleFold = (key: number): void => {
  cards.value = toggled(cards.peek(), key);
};
export const toggleGroup = (name: string): void => {
  groups.value = toggled(groups.peek(), name);
};
/** These are folded, and no others. */
export const foldAll = (keys: readonly number[]): void => {
  cards.value = new Set(keys);
};
