// The parts: which are selected, lit, hidden or renamed.

import { batch, computed, type ReadonlySignal, type Signal, signal } from '@preact/signals';
import { cutBytes } from '../program/cut';
import { limits } from '../program/schema';
import type { LocalTriple } from '../program/types';
import { t } from '../texts/texts';
import { type Document, nameOf, wholePart } from './document';
import type { History } from './history';
import { realParts } from './several';

export interface Selection {
  readonly part: string;
  readonly feature: LocalTriple;
}

/** Parts, relations, and faces of parts. */
export interface PointedAt {
  readonly parts: readonly string[];
  readonly relations: readonly string[];
  readonly faces?: readonly Selection[];
}

export interface Parts {
  /** The part that was selected first, with its feature. */
  readonly selection: Signal<Selection | null>;
  /** Ids of all parts that are selected, that one first. */
  readonly selected: ReadonlySignal<readonly string[]>;
  readonly hovered: Signal<string | null>;
  /** What lights up while the pointer or the focus is on a line that is about it. */
  readonly pointedAt: Signal<PointedAt | null>;
  /** Selects one part alone, or none. */
  select(part: string | null, feature?: LocalTriple): void;
  /** Selects some parts. */
  selectAll(ids: readonly string[]): void;
  /** Selects a part together with those that are, or no longer. */
  selectAlso(part: string): void;
  setHidden(ids: readonly string[], hidden: boolean): void;
  showAll(): void;
  /** Hides everything but some parts; where nothing else is shown, shows all again. */
  isolate(ids: readonly string[]): void;
  /** An empty name is the file's own. */
  renamePart(id: string, name: string): void;
}

export function createParts(history: History<Document>): Parts {
  const document = history.present;
  const selection = signal<Selection | null>(null);
  const further = signal<readonly string[]>([]);
  const selected = computed(() => (selection.value === null ? [] : [selection.value.part, ...further.value]));
  const change = (label: string, next: Partial<Document>) => history.push(label, { ...document.peek(), ...next });
  const choose = ([first, ...rest]: readonly string[]) =>
    batch(() => {
      further.value = rest;
      if (first === undefined) selection.value = null;
      else if (first !== selection.peek()?.part) selection.value = { part: first, feature: wholePart };
    });
  return {
    selection,
    selected,
    hovered: signal(null),
    pointedAt: signal(null),
    select(part, feature = wholePart) {
      batch(() => {
        further.value = [];
        selection.value = part === null ? null : { part, feature };
      });
    },
    selectAll: choose,
    selectAlso(part) {
      const now = selected.peek();
      choose(now.includes(part) ? now.filter((id) => id !== part) : [...now, part]);
    },
    setHidden(ids, hidden) {
      const next = new Set(document.peek().hidden);
      for (const id of ids)
        if (hidden) next.add(id);
        else next.delete(id);
      change(hidden ? t`hide@step` : t`show@step`, { hidden: next });
    },
    showAll() {
      if (document.peek().hidden.size > 0) change(t`show all`, { hidden: new Set() });
    },
    isolate(ids) {
      const { model, hidden } = document.peek();
      if (model === null) return;
      const kept = new Set(realParts(model.shape, ids));
      const others = model.shape.parts.filter(({ id, virtual }) => !virtual && !kept.has(id)).map(({ id }) => id);
      const isAlone = others.every((id) => hidden.has(id)) && [...kept].every((id) => !hidden.has(id));
      if (isAlone) change(t`show all`, { hidden: new Set() });
      else change(t`show these only`, { hidden: new Set(others) });
    },
    renamePart(id, typed) {
      const name = cutBytes(typed, limits.nameLength); // a longer one could be saved, but not opened again
      if (nameOf(document.peek(), id) === name) return;
      const names = new Map(document.peek().names);
      if (name === '') names.delete(id);
      else names.set(id, name);
      change(t`rename part`, { names });
    },
  };
}
