// The state of the page and everything that can be done to it, by concern. The interface reads signals and calls these
// functions; tests make sessions of their own.

import { batch, computed, type ReadonlySignal } from '@preact/signals';
import { t } from '../texts/texts';
import { type Document, type EditInput, emptyDocument, withRequest } from './document';
import { createEvaluation, type Evaluation } from './evaluation';
import { createFamily, type FamilyActions } from './family';
import { History, type Mark } from './history';
import { createLayers, type Layers, madeBy } from './layers';
import type { ModelCore, Propagation } from './model_core';
import { createParts, type Parts } from './parts';
import { createStack, type Stack } from './stack';
import { createTasks, type Tasks } from './tasks';

export interface Session extends Evaluation, Layers, Parts, Stack, Tasks {
  readonly family: FamilyActions;
  readonly document: ReadonlySignal<Document>;
  readonly undoLabel: ReadonlySignal<string | null>;
  readonly redoLabel: ReadonlySignal<string | null>;
  undo(): void;
  redo(): void;
  /** Of the step that made the present state. */
  mark(): Mark;
  /** Changes the document as one step of the history. */
  change(label: string, edit: (document: Document) => Document): void;
  /** Puts a document in place of the present one, as one step that undo takes back. */
  replaceDocument(next: Document, label: string): void;
  /**
   * Propagates a seed edit through the shape, behind the present layers or in place of the one named `replacing`; null, and
   * a sentence, when that fails or the model is another by then.
   */
  find(core: ModelCore, edit: EditInput, request: string, replacing?: number): Promise<Propagation | null>;
  /** The same, and adds the layer; answers its key, or null. */
  propagate(core: ModelCore, edit: EditInput, request: string): Promise<number | null>;
}

export function createSession(): Session {
  const history = new History<Document>(emptyDocument);
  const document = history.present;
  const tasks = createTasks();
  const evaluation = createEvaluation(document);
  const layers = createLayers(history, evaluation, tasks.say);
  const parts = createParts(history);
  const family = createFamily(history, evaluation, layers, tasks);

  const stack = createStack(history);
  const restack = (key: number) => void stack.restack(key);

  async function find(core: ModelCore, edit: EditInput, request: string, replacing?: number) {
    const { model } = document.peek();
    if (model === null) return null;
    stack.useCore(core);
    const found = await tasks.run(t`Working out how the other parts follow`, async (options) =>
      stack.onto(model, await core.propagate(model, edit, options), replacing),
    );
    if (found === null || document.peek().model !== model) return null;
    return { ...found, program: withRequest(found.program, request) };
  }

  return {
    ...tasks,
    ...evaluation,
    ...layers,
    ...parts,
    family,
    ...stack,
    amendLayer(mark, key, found, made) {
      const amended = layers.amendLayer(mark, key, found, made);
      if (amended) restack(key);
      return amended;
    },
    divideLayer(mark, key, found, made) {
      const divided = layers.divideLayer(mark, key, found, made);
      if (divided) restack(key);
      return divided;
    },
    rewriteLayer(key, layer) {
      layers.rewriteLayer(key, layer);
      restack(key);
    },
    setEnabled(key, enabled) {
      layers.setEnabled(key, enabled);
      if (enabled) restack(key);
    },
    moveLayer(key, by) {
      layers.moveLayer(key, by);
      const at = document.peek().layers.findIndex((entry) => entry.key === key);
      restack(document.peek().layers[Math.min(at, at - by)]?.key ?? key);
    },
    document,
    undoLabel: computed(() => history.undoLabel),
    redoLabel: computed(() => history.redoLabel),
    undo: () => history.undo(),
    redo: () => history.redo(),
    mark: () => history.mark,
    change: (label, edit) => history.push(label, edit(document.peek())),
    replaceDocument(next, label) {
      batch(() => {
        parts.selection.value = null;
        parts.pointedAt.value = null;
        tasks.notice.value = null;
        if (document.peek().model === null) history.reset(next);
        else history.push(label, next);
      });
    },
    find,
    async propagate(core, edit, request) {
      const found = await find(core, edit, request);
      if (found === null) return null;
      return layers.addProgram(found.program, request || t`edit`, madeBy(found))?.[0] ?? null;
    },
  };
}

/** The page's own. */
export const session = createSession();
export const {
  addProgram,
  change,
  compiled,
  document,
  draft,
  entriesOf,
  entryOf,
  exchangeLayer,
  family,
  hovered,
  isolate,
  keepDraft,
  moveLayer,
  newEntry,
  notice,
  onto,
  pointedAt,
  propagate,
  redo,
  redoLabel,
  removeLayer,
  renameLayer,
  renamePart,
  replaceDocument,
  restIsShown,
  rewriteLayer,
  run,
  say,
  select,
  selectAll,
  selectAlso,
  selected,
  selection,
  setEnabled,
  setHidden,
  setValue,
  setValues,
  settle,
  showAll,
  shownLayers,
  showRest,
  slide,
  sliderValue,
  step,
  stops,
  task,
  undo,
  undoLabel,
  useCore,
} = session;
