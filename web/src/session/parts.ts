// The parts: which one is selected, which are lit, hidden or renamed.
import { type Signal, signal } from '@preact/signals';
import { cutBytes } from '../program/cut';
import { limits } from '../program/schema';
import type { LocalTriple } from '../program/types';
import { type Document, nameOf, wholePart } from './document';
import type { History } from './history';

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
  readonly selection: Signal<Selection | null>;
  readonly hovered: Signal<string | null>;
  /** What lights up while the pointer or the focus is on a line that is about it. */
  readonly pointedAt: Signal<PointedAt | null>;
  select(part: string | null, feature?: LocalTriple): void;
  setHidden(ids: readonly string[], hidden: boolean): void;
  showAll(): void;
  /** An empty name is the file's own. */
  renamePart(id: string, name: string): void;
}

export function createParts(history: History<Document>): Parts {
  const document = history.present;
  const selection = signal<Selection | null>(null);
  const change = (label: string, next: Partial<Document>) => history.push(label, { ...document.peek(), ...next });
  return {
    selection,
    hovered: signal(null),
    pointedAt: signal(null),
    select(part, feature = wholePart) {
      selection.value = part === null ? null : { part, feature };
    },
    setHidden(ids, hidden) {
      const next = new Set(document.peek().hidden);
      for (const id of ids)
        if (hidden) next.add(id);
        else next.delete(id);
      change(hidden ? 'hide' : 'show', { hidden: next });
    },
    showAll() {
      if (document.peek().hidden.size > 0) change('show all', { hidden: new Set() });
    },
    renamePart(id, typed) {
      const name = cutBytes(typed, limits.nameLength); // a longer one could be saved, but not opened again
      if (nameOf(document.peek(), id) === name) return;
      const names = new Map(document.peek().names);
      if (name === '') names.delete(id);
      else names.set(id, name);
      change('rename part', { names });
    },
  };
}
