// The edits: adding, changing and arranging layers, each as one step of the history.

import { batch } from '@preact/signals';
import { checkProgram } from '../program/check';
import { atRest } from '../program/rest';
import { titleOf } from '../program/title';
import { errorMessage, type Layer, type Program } from '../program/types';
import { t } from '../texts/texts';
import { type Document, type LayerEntry, programOf, withFreshParameters, withRequest } from './document';
import { activeLayers, type Evaluation } from './evaluation';
import type { History, Mark } from './history';
import type { Propagation } from './model_core';
import type { Tasks } from './tasks';

export { titleOf } from '../program/title';

/** How layers came about. */
export type Made = Pick<LayerEntry, 'trace' | 'seen'>;

/** What propagation leaves with the layers that it found. */
export const madeBy = ({ trace }: Pick<Propagation, 'trace'>): Made => (trace === undefined ? {} : { trace });

export interface Layers {
  /** Keeps where a slider has been moved to, as one step of the history. */
  settle(key: number): void;
  /** @param inRun of the steps of a run, such as the arrow keys make, all but the first are none of their own */
  setValue(key: number, value: number, inRun?: boolean): void;
  /** Puts several sliders at once, by key, as one step of the history. */
  setValues(values: ReadonlyMap<number, number>, label: string): void;
  /** Makes the draft a layer of the work, where its slider stands; answers its key. One step of the history. */
  keepDraft(): number | null;
  newEntry(layer: Layer, value?: number, enabled?: boolean): LayerEntry;
  /** Layers of a program as they would stand behind the present ones; null, and a sentence, when they do not fit. */
  entriesOf(found: Propagation): readonly LayerEntry[] | null;
  /** Adds the layers of a program behind the present ones; answers their keys, or null when they do not fit. */
  addProgram(program: Program, label: string, made?: Made): readonly number[] | null;
  /**
   * Puts another layer in place of one, in the step that made it: later steps stay, and the slider stays where it is.
   * False when that step is undone, when the layer is gone, or when the other does not fit, which it says.
   * @param made how the other came about; left out: as the layer before, with what propagation left
   */
  amendLayer(mark: Mark, key: number, found: Propagation, made?: Made): boolean;
  /**
   * Puts several layers in place of one, in the step that made it; the first has its key, and its slider stays where it is,
   * those of the others at rest. False as amendLayer().
   */
  divideLayer(mark: Mark, key: number, found: readonly Propagation[], made: (one: Propagation) => Made): boolean;
  /**
   * Puts what was found in place of a layer, as a step; its slider stays where it is, if it goes so far. False when the layer
   * is gone or the other does not fit, which it says.
   */
  exchangeLayer(key: number, found: Propagation, request: string): boolean;
  /** Puts a layer that was edited as text in place of what it was. What propagation found out about it goes. */
  rewriteLayer(key: number, layer: Layer): void;
  removeLayer(key: number): void;
  setEnabled(key: number, enabled: boolean): void;
  renameLayer(key: number, request: string): void;
  /** @param by −1 up, 1 down */
  moveLayer(key: number, by: -1 | 1): void;
}

type Entries = readonly LayerEntry[];

const replace = (layers: Entries, key: number, change: Partial<LayerEntry>): Entries =>
  layers.map((entry) => (entry.key === key ? { ...entry, ...change } : entry));

const clamp = (value: number, { min, max }: Layer['parameter']) => Math.min(max, Math.max(min, value));

export function createLayers(
  history: History<Document>,
  { draft, sliderValue, slide }: Evaluation,
  say: Tasks['say'],
): Layers {
  const document = history.present;
  let nextKey = 1;

  function changeLayers(label: string, edit: (layers: Entries) => Entries, mergeKey?: string): void {
    const before = document.peek();
    history.push(label, { ...before, layers: edit(before.layers) }, mergeKey);
  }

  const newEntry = (layer: Layer, value = layer.parameter.value, enabled = true): LayerEntry => ({
    key: nextKey++,
    layer,
    enabled,
    value,
  });

  /** Whether layers go together on the present model; says so when they do not. */
  function goTogether(layers: Entries): boolean {
    const { model } = document.peek();
    if (model === null) return false;
    const checked = checkProgram(programOf(model.shape, layers), model.shape);
    if (!checked.ok) say(t`This program does not fit the model. ${errorMessage(checked.error)}`, 'error');
    return checked.ok;
  }

  /** Layers under parameter names that those of `others` do not have. */
  const named = (layers: readonly Layer[], others: Entries): Layer[] =>
    withFreshParameters(layers, new Set(others.map(({ layer }) => layer.parameter.name)));

  function entriesOf({ program, trace }: Propagation): Entries | null {
    const entries = named(program.layers, document.peek().layers).map((layer) => ({
      ...newEntry(layer),
      ...(trace === undefined ? {} : { trace }),
    }));
    return goTogether([...activeLayers(document.peek()), ...entries]) ? entries : null;
  }

  function addProgram(program: Program, label: string, made: Made = {}): readonly number[] | null {
    const entries = entriesOf({ program })?.map((entry) => ({ ...entry, ...made })) ?? null;
    if (entries === null) return null;
    changeLayers(label, (layers) => [...layers, ...entries]);
    return entries.map(({ key }) => key);
  }

  /** How what was found takes the place of a layer among others; null when it cannot, which it says. */
  function replacing(key: number, found: Propagation, made?: Made): ((entries: Entries) => Entries) | null {
    const { layers } = document.peek();
    const others = layers.filter((entry) => entry.key !== key);
    const [layer] = named(found.program.layers, others);
    if (layer === undefined || others.length === layers.length) return null;
    const amended = ({ value, enabled, group, seen }: LayerEntry): LayerEntry => ({
      key,
      layer,
      enabled,
      value: clamp(value, layer.parameter),
      ...(group === undefined ? {} : { group }),
      ...(made ?? { ...madeBy(found), ...(seen === undefined ? {} : { seen }) }),
    });
    const inPlace = (entries: Entries) => entries.map((entry) => (entry.key === key ? amended(entry) : entry));
    return goTogether(inPlace(activeLayers(document.peek()))) ? inPlace : null;
  }

  function amend(mark: Mark, inPlace: ((entries: Entries) => Entries) | null): boolean {
    if (inPlace === null) return false;
    const { model } = document.peek();
    // What was found holds for this model and its labels; states of before another was given keep what they had.
    return history.amend(mark, (state) =>
      state.model === model ? { ...state, layers: inPlace(state.layers) } : state,
    );
  }

  function divideLayer(mark: Mark, key: number, found: readonly Propagation[], made: (one: Propagation) => Made) {
    const [first, ...others] = found;
    const inPlace = first === undefined ? null : replacing(key, first, made(first));
    if (inPlace === null) return false;
    const added: LayerEntry[] = [];
    for (const one of others) {
      const present = [...inPlace(document.peek().layers), ...added];
      added.push(...named(one.program.layers, present).map((layer) => ({ ...newEntry(layer), ...made(one) })));
    }
    const divided = (entries: Entries) =>
      inPlace(entries).flatMap((entry) => (entry.key === key ? [entry, ...added] : [entry]));
    return goTogether(divided(activeLayers(document.peek()))) && amend(mark, divided);
  }

  function settle(key: number, inRun = false): void {
    const entry = document.peek().layers.find((other) => other.key === key);
    if (entry === undefined || sliderValue(entry) === entry.value) return;
    const value = sliderValue(entry);
    const label = t`slide “${titleOf(entry.layer)}”`;
    changeLayers(label, (layers) => replace(layers, key, { value }), inRun ? `value ${key}` : undefined);
  }

  return {
    settle: (key) => settle(key),
    setValue(key, value, inRun = false) {
      slide(key, value);
      settle(key, inRun);
    },
    setValues(values, label) {
      changeLayers(label, (layers) =>
        layers.map((entry) => {
          const value = values.get(entry.key);
          return value === undefined ? entry : { ...entry, value: clamp(value, entry.layer.parameter) };
        }),
      );
    },
    keepDraft() {
      const entry = draft.peek();
      if (entry === null) return null;
      const kept = { ...entry, value: sliderValue(entry) };
      batch(() => {
        draft.value = null;
        changeLayers(titleOf(entry.layer), (layers) => [...layers, kept]);
      });
      return kept.key;
    },
    newEntry,
    entriesOf,
    addProgram,
    amendLayer: (mark, key, found, made) => amend(mark, replacing(key, found, made)),
    divideLayer,
    exchangeLayer(key, found, request) {
      const inPlace = replacing(key, { ...found, program: withRequest(found.program, request) });
      if (inPlace !== null) changeLayers(t`read it as “${request}”`, inPlace);
      return inPlace !== null;
    },
    rewriteLayer(key, layer) {
      changeLayers(t`edit as text`, (layers) =>
        layers.map((entry) =>
          entry.key === key ? { key, layer, enabled: entry.enabled, value: layer.parameter.value } : entry,
        ),
      );
    },
    removeLayer(key) {
      changeLayers(t`remove edit`, (layers) => {
        const left = layers.filter((entry) => entry.key !== key);
        const known = new Set(left.map(({ layer }) => layer.parameter.name));
        return left.map((entry) => ({ ...entry, layer: atRest(entry.layer, known) }));
      });
    },
    setEnabled(key, enabled) {
      changeLayers(enabled ? t`switch edit on` : t`switch edit off`, (layers) => replace(layers, key, { enabled }));
    },
    renameLayer(key, request) {
      const entry = document.peek().layers.find((other) => other.key === key);
      if (entry === undefined || entry.layer.request === request) return;
      changeLayers(t`rename edit`, (layers) => replace(layers, key, { layer: { ...entry.layer, request } }));
    },
    moveLayer(key, by) {
      changeLayers(t`reorder edits`, (layers) => {
        const from = layers.findIndex((entry) => entry.key === key);
        const to = from + by;
        const moved = layers[from];
        if (moved === undefined || to < 0 || to >= layers.length) return layers;
        const others = layers.filter((entry) => entry.key !== key);
        return [...others.slice(0, to), moved, ...others.slice(to)];
      });
    },
  };
}
