// Names for the parts of a model that has none: a language model is told sizes, places and relations, its answers are
// counted, and what comes of them is a list to correct. Accepting it labels all parts anew, in one step.

import { computed, type ReadonlySignal, signal } from '@preact/signals';
import { t } from '../texts/texts';
import type { Inference } from '../worker/protocol';
import { type OpenModel, partKey } from './document';
import type { ModelCore } from './model_core';
import { type Asker, askAlone, nothingSpent, type PaintNumbered, type Spent, unusable, whyUnread } from './propose';
import type { Session } from './session';
import { type Failed, failureOf } from './tasks';

export type Front = NonNullable<Inference['names']>['front'];

export interface NameRow {
  /** Id of the part, or of the virtual part whose instances it stands for. */
  readonly part: string;
  /** As corrected; empty: it keeps the label that it has. */
  readonly label: string;
  /** Answers that say so; null for what was typed. */
  readonly votes: number | null;
}

export interface Naming {
  readonly model: OpenModel;
  readonly progress: { readonly done: number; readonly of: number } | null;
  /** What the thing is, and which of its sides is the front; empty before they are known. */
  readonly category: string;
  readonly front: Front;
  /** Answers that were counted. */
  readonly of: number;
  readonly rows: readonly NameRow[];
  readonly failure: Failed | null;
  readonly spent: Spent;
  readonly stop: () => void;
}

export interface NamingParts {
  readonly session: Session;
  readonly models: ReadonlySignal<ModelCore | null>;
  /** Whom to ask. @throws AskError that says why nobody can be asked */
  askerOf(model: OpenModel): Promise<Pick<Asker, 'proposer' | 'isBlind'>>;
  /** Labels parts by key, in one step. */
  relabel(core: ModelCore, labels: ReadonlyMap<string, string>, step: string): Promise<boolean>;
}

export interface NamingActions {
  /** Null before anything was asked, and while another model is open. */
  readonly naming: ReadonlySignal<Naming | null>;
  start(paint: PaintNumbered): Promise<void>;
  close(): void;
  rename(part: string, label: string): void;
  /** Labels the parts as the list says. */
  accept(): Promise<boolean>;
}

export function createNaming({ session, models, askerOf, relabel }: NamingParts): NamingActions {
  const { document } = session;
  const state = signal<Naming | null>(null);
  const naming = computed(() => (state.value?.model === document.value.model ? state.value : null));

  const change = (stop: () => void, next: Partial<Naming>) => {
    const now = state.peek();
    if (now?.stop === stop) state.value = { ...now, ...next };
  };

  async function start(paint: PaintNumbered): Promise<void> {
    const core = models.peek();
    const { model } = document.peek();
    if (core === null || model === null) return;
    state.peek()?.stop();
    const controller = new AbortController();
    const stop = () => controller.abort();
    const { signal: aborted } = controller;
    state.value = {
      model,
      progress: { done: 0, of: 1 },
      category: '',
      front: '',
      of: 0,
      rows: [],
      failure: null,
      spent: nothingSpent,
      stop,
    };
    try {
      const options = {
        signal: aborted,
        onProgress: ([task]: readonly { readonly done: number; readonly of: number }[]) => {
          if (task !== undefined && !aborted.aborted) change(stop, { progress: { done: task.done, of: task.of } });
        },
      };
      const alone = { task: 'part_names', request: '' };
      const { names, calls, tokens } = await askAlone(
        core,
        model,
        alone,
        await askerOf(model),
        paint,
        options,
        (answer) => {
          const { names } = answer.inference;
          if (names === undefined || names.of === 0) throw whyUnread(answer) ?? unusable(t`it names nothing`);
          return { names, calls: answer.calls, tokens: answer.tokens };
        },
      );
      aborted.throwIfAborted();
      const { category, front, of, parts } = names;
      change(stop, { category, front, of, rows: parts, progress: null, spent: { calls, tokens } });
    } catch (error) {
      if (aborted.aborted) return;
      change(stop, { failure: failureOf(error), progress: null });
    }
  }

  function close(): void {
    state.peek()?.stop();
    state.value = null;
  }

  return {
    naming,
    start,
    close,
    rename(part, label) {
      const now = state.peek();
      if (now === null) return;
      state.value = { ...now, rows: now.rows.map((row) => (row.part === part ? { ...row, label, votes: null } : row)) };
    },
    async accept() {
      const core = models.peek();
      const now = naming.peek();
      if (core === null || now === null) return false;
      const labels = labelsOf(now);
      if (labels.size === 0) return false;
      const done = await relabel(core, labels, t`name the parts`);
      if (done) close();
      return done;
    },
  };
}

/** Labels by key of the part: a group's is that of all its instances. */
function labelsOf({ model, rows }: Naming): ReadonlyMap<string, string> {
  const byId = new Map(model.shape.parts.map((part) => [part.id, part]));
  const labels = new Map<string, string>();
  for (const { part: id, label } of rows) {
    const part = byId.get(id);
    if (part === undefined || label.trim() === '') continue;
    const real = part.virtual ? part.members.flatMap((member) => byId.get(member) ?? []) : [part];
    for (const one of real) labels.set(partKey(one), label.trim());
  }
  return labels;
}
