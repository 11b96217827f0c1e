// The state of the page and everything that can be done to it. The interface reads signals and calls these functions.
import { batch, computed, effect, type ReadonlySignal, signal } from '@preact/signals';
import { checkProgram } from '../program/check';
import { compileProgram, type Evaluator } from '../program/compile';
import { cutBytes } from '../program/cut';
import { limits } from '../program/schema';
import { errorMessage, type Layer, type LocalTriple, type Program, type Shape } from '../program/types';
import {
  type Document,
  type EditInput,
  emptyDocument,
  emptyProgram,
  type LayerEntry,
  nameOf,
  type OpenModel,
  programOf,
  wholePart,
  withFreshParameters,
  withRequest,
} from './document';
import { FileError } from './files';
import { History } from './history';
import type { ModelCore, Propagation } from './model_core';
import type { Trace } from './trace';

const history = new History<Document>(emptyDocument);
export const document: ReadonlySignal<Document> = history.present;
export const undoLabel = computed(() => history.undoLabel);
export const redoLabel = computed(() => history.redoLabel);

export interface Selection {
  readonly part: string;
  readonly feature: LocalTriple;
}
export const selection = signal<Selection | null>(null);
export const hovered = signal<string | null>(null);
/** Parts and relations to light up while the pointer or the focus is on a statement or a relation. */
export const pointedAt = signal<{ parts: readonly string[]; relations: readonly string[] } | null>(null);

/** A sentence that stays until the next thing is done. */
export interface Notice {
  readonly kind: 'info' | 'error';
  readonly text: string;
}
export const notice = signal<Notice | null>(null);
export function say(text: string, kind: Notice['kind'] = 'info'): void {
  notice.value = { kind, text };
}

/** What the core is doing, with a way to stop it. */
export interface Task {
  readonly text: string;
  readonly cancel: () => void;
}
export const task = signal<Task | null>(null);

// ------------------------------------------------------------------------------------------------ program and values

export type Compiled =
  | { readonly kind: 'none' }
  | { readonly kind: 'ready'; readonly evaluator: Evaluator; readonly keys: readonly number[] }
  | { readonly kind: 'refused'; readonly text: string };

let lastStructure: readonly unknown[] = [];
let lastCompiled: Compiled = { kind: 'none' };

const fits = new WeakMap<Layer, { readonly shape: Shape; readonly text: string | null }>();

/** Why a layer does not fit a shape, in a sentence; null when it does. */
export function misfit(shape: Shape, layer: Layer): string | null {
  const known = fits.get(layer);
  if (known?.shape === shape) return known.text;
  const checked = checkProgram({ ...emptyProgram(shape), layers: [layer] }, shape);
  const text = checked.ok ? null : errorMessage(checked.error);
  fits.set(layer, { shape, text });
  return text;
}

/** The layers that are on and fit the shape: what the model shows and what is exported. */
export function activeLayers({ model, layers }: Document): readonly LayerEntry[] {
  return model === null ? [] : layers.filter(({ enabled, layer }) => enabled && misfit(model.shape, layer) === null);
}

/** A layer that is shown but no part of the work yet: what a hand is pulling. */
export const draft = signal<LayerEntry | null>(null);

/** What the evaluator's parameters belong to, in their order: the active layers and the draft. */
export function shownLayers(): readonly LayerEntry[] {
  return [...activeLayers(document.value), ...(draft.value === null ? [] : [draft.value])];
}

/** The program of the active layers. Compiled anew when the layers change, not when only their values do. */
export const compiled = computed<Compiled>(() => {
  const { model } = document.value;
  const active = shownLayers();
  const structure = [model?.shape, ...active.flatMap(({ key, layer }) => [key, layer.parameter, layer.statements])];
  if (structure.length === lastStructure.length && structure.every((item, i) => item === lastStructure[i])) {
    return lastCompiled;
  }
  lastStructure = structure;
  lastCompiled = compile(model, active);
  return lastCompiled;
});

function compile(model: OpenModel | null, active: readonly LayerEntry[]): Compiled {
  if (model === null) return { kind: 'none' };
  const checked = checkProgram(programOf(model.shape, active), model.shape);
  if (!checked.ok) return { kind: 'refused', text: errorMessage(checked.error) };
  const evaluator = compileProgram(checked.value, model.shape);
  return { kind: 'ready', evaluator, keys: active.map(({ key }) => key) };
}

let values = new Float64Array(0);
/** Counts evaluations: what shows the state reads this and then the evaluator. */
export const step = signal(0);
/** Live value of a layer's slider, ahead of the document while it is dragged. */
const liveValues = new Map<number, number>();

export function sliderValue(entry: LayerEntry): number {
  return liveValues.get(entry.key) ?? entry.value;
}

/** A layer of the work, or the draft. */
export const entryOf = (key: number): LayerEntry | undefined =>
  [...document.peek().layers, draft.peek()].find((entry) => entry?.key === key) ?? undefined;

effect(() => {
  const layers = [...document.value.layers, ...(draft.value === null ? [] : [draft.value])];
  const now = compiled.value;
  liveValues.clear();
  if (now.kind === 'ready') {
    values = Float64Array.from(now.keys, (key) => layers.find((entry) => entry.key === key)?.value ?? 0);
    now.evaluator.evaluate(values);
  }
  step.value = step.peek() + 1;
});

/** One step of a slider: evaluates closures, touches neither the document nor the core. */
export function slide(key: number, value: number): void {
  const now = compiled.peek();
  const at = now.kind === 'ready' ? now.keys.indexOf(key) : -1;
  if (now.kind !== 'ready' || at < 0) return;
  const { min, max } = now.evaluator.parameters[at] ?? { min: 0, max: 0 };
  values[at] = Math.min(max, Math.max(min, value));
  liveValues.set(key, values[at] as number);
  now.evaluator.evaluate(values);
  step.value = step.peek() + 1;
}

/** Keeps where a slider has been moved to, as one step of the history. */
export function settle(key: number): void {
  const entry = document.peek().layers.find((other) => other.key === key);
  const value = liveValues.get(key);
  if (entry === undefined || value === undefined || value === entry.value) return;
  changeLayers(`“${titleOf(entry.layer)}”`, (layers) => replace(layers, key, { value }), `value ${key}`);
}

/** Makes the draft a layer of the work, where its slider stands; answers its key. One step of the history. */
export function keepDraft(): number | null {
  const entry = draft.peek();
  if (entry === null) return null;
  const kept = { ...entry, value: sliderValue(entry) };
  batch(() => {
    draft.value = null;
    changeLayers(titleOf(entry.layer), (layers) => [...layers, kept]);
  });
  return kept.key;
}

export function setValue(key: number, value: number): void {
  slide(key, value);
  settle(key);
}

// ------------------------------------------------------------------------------------------------------------ layers

/** With a capital, however it was typed. */
export function titleOf({ request }: Layer): string {
  return request === '' ? 'Edit' : request.charAt(0).toUpperCase() + request.slice(1);
}

const replace = (layers: readonly LayerEntry[], key: number, change: Partial<LayerEntry>) =>
  layers.map((entry) => (entry.key === key ? { ...entry, ...change } : entry));

function change(label: string, next: Partial<Document>, mergeKey?: string): void {
  history.push(label, { ...document.peek(), ...next }, mergeKey);
}

function changeLayers(
  label: string,
  edit: (layers: readonly LayerEntry[]) => readonly LayerEntry[],
  mergeKey?: string,
): void {
  change(label, { layers: edit(document.peek().layers) }, mergeKey);
}

let nextKey = 1;
export const newEntry = (layer: Layer, value = layer.parameter.value, enabled = true): LayerEntry => ({
  key: nextKey++,
  layer,
  enabled,
  value,
});

/** Layers of a program as they would stand behind the present ones; null, and a sentence, when they do not fit. */
export function entriesOf({ program, trace }: Propagation): readonly LayerEntry[] | null {
  const { model, layers } = document.peek();
  if (model === null) return null;
  const taken = new Set(layers.map(({ layer }) => layer.parameter.name));
  const entries = withFreshParameters(program.layers, taken).map((layer) => ({
    ...newEntry(layer),
    ...(trace === undefined ? {} : { trace }),
  }));
  const all = [...activeLayers(document.peek()), ...entries];
  const checked = checkProgram(programOf(model.shape, all), model.shape);
  if (checked.ok) return entries;
  say(`This program does not fit the model. ${errorMessage(checked.error)}`, 'error');
  return null;
}

/** Adds the layers of a program behind the present ones; answers their keys, or null when they do not fit. */
export function addProgram(program: Program, label: string, trace?: Trace): readonly number[] | null {
  const entries = entriesOf({ program, ...(trace === undefined ? {} : { trace }) });
  if (entries === null) return null;
  changeLayers(label, (layers) => [...layers, ...entries]);
  return entries.map(({ key }) => key);
}

/** Puts a layer that was edited as text in place of what it was. What propagation found out about it goes. */
export function rewriteLayer(key: number, layer: Layer): void {
  changeLayers('edit as text', (layers) =>
    layers.map((entry) =>
      entry.key === key ? { key, layer, enabled: entry.enabled, value: layer.parameter.value } : entry,
    ),
  );
}

export function removeLayer(key: number): void {
  changeLayers('remove edit', (layers) => layers.filter((entry) => entry.key !== key));
}
export function setEnabled(key: number, enabled: boolean): void {
  changeLayers(enabled ? 'switch edit on' : 'switch edit off', (layers) => replace(layers, key, { enabled }));
}
export function renameLayer(key: number, request: string): void {
  const entry = document.peek().layers.find((other) => other.key === key);
  if (entry === undefined || entry.layer.request === request) return;
  changeLayers('rename edit', (layers) => replace(layers, key, { layer: { ...entry.layer, request } }));
}
/** @param by −1 up, 1 down */
export function moveLayer(key: number, by: -1 | 1): void {
  changeLayers('reorder edits', (layers) => {
    const from = layers.findIndex((entry) => entry.key === key);
    const to = from + by;
    const moved = layers[from];
    if (moved === undefined || to < 0 || to >= layers.length) return layers;
    const others = layers.filter((entry) => entry.key !== key);
    return [...others.slice(0, to), moved, ...others.slice(to)];
  });
}

// ------------------------------------------------------------------------------------------------------------- parts

export function setHidden(ids: readonly string[], hidden: boolean): void {
  const next = new Set(document.peek().hidden);
  for (const id of ids)
    if (hidden) next.add(id);
    else next.delete(id);
  change(hidden ? 'hide' : 'show', { hidden: next });
}
export function showAll(): void {
  if (document.peek().hidden.size > 0) change('show all', { hidden: new Set() });
}
export function renamePart(id: string, typed: string): void {
  const name = cutBytes(typed, limits.nameLength); // a longer one could be saved, but not opened again
  if (nameOf(document.peek(), id) === name) return;
  const names = new Map(document.peek().names);
  if (name === '') names.delete(id);
  else names.set(id, name);
  change('rename part', { names });
}
export function select(part: string | null, feature: LocalTriple = wholePart): void {
  selection.value = part === null ? null : { part, feature };
}

// ------------------------------------------------------------------------------------------------ history and models

export const undo = (): void => history.undo();
export const redo = (): void => history.redo();

/** Puts a document in place of the present one, as one step that undo takes back. */
export function replaceDocument(next: Document, label: string): void {
  batch(() => {
    selection.value = null;
    pointedAt.value = null;
    notice.value = null;
    if (document.peek().model === null) history.reset(next);
    else history.push(label, next);
  });
}

/** Runs something that takes time, with progress and cancel; says what went wrong. Null when it did. */
export async function run<T>(
  text: string,
  work: (options: {
    signal: AbortSignal;
    onProgress: (progress: { step: string; done: number; total: number }) => void;
  }) => Promise<T>,
): Promise<T | null> {
  task.peek()?.cancel();
  const controller = new AbortController();
  const own: Task = { text, cancel: () => controller.abort() };
  task.value = own;
  notice.value = null;
  const finish = () => {
    if (task.peek()?.cancel === own.cancel) task.value = null;
  };
  try {
    return await work({
      signal: controller.signal,
      onProgress({ step: name, done, total }) {
        if (task.peek()?.cancel !== own.cancel) return;
        task.value = { ...own, text: total > 1 ? `${text} · ${name}, ${done} of ${total}` : `${text} · ${name}` };
      },
    });
  } catch (error) {
    if (!controller.signal.aborted) say(sentence(error), 'error');
    return null;
  } finally {
    finish();
  }
}

/** An error as a whole sentence for people. */
export function sentence(error: unknown): string {
  const text = error instanceof Error ? error.message : String(error);
  if (error instanceof FileError) return text;
  const whole = text || 'something went wrong';
  const capital = whole.charAt(0).toUpperCase() + whole.slice(1);
  return /[.!?]$/.test(capital) ? capital : `${capital}.`;
}

/** Propagates a seed edit through the shape and adds the layer; answers its key, or null. */
export async function propagate(core: ModelCore, edit: EditInput, request: string): Promise<number | null> {
  const { model } = document.peek();
  if (model === null) return null;
  const found = await run('Working out how the other parts follow', (options) => core.propagate(model, edit, options));
  if (found === null || document.peek().model !== model) return null;
  return addProgram(withRequest(found.program, request), request || 'edit', found.trace)?.[0] ?? null;
}
