// The program of the layers that are on, compiled, and evaluated where the sliders stand.
import { computed, effect, type ReadonlySignal, type Signal, signal } from '@preact/signals';
import { checkProgram } from '../program/check';
import { compileProgram, type Evaluator } from '../program/compile';
import { errorMessage, type Layer, type Shape } from '../program/types';
import { type Document, emptyProgram, type LayerEntry, type OpenModel, programOf } from './document';

export type Compiled =
  | { readonly kind: 'none' }
  | { readonly kind: 'ready'; readonly evaluator: Evaluator; readonly keys: readonly number[] }
  | { readonly kind: 'refused'; readonly text: string };

export interface Evaluation {
  /** A layer that is shown but no part of the work yet: what a hand is pulling. */
  readonly draft: Signal<LayerEntry | null>;
  /** The program of the active layers. Compiled anew when the layers change, not when only their values do. */
  readonly compiled: ReadonlySignal<Compiled>;
  /** Counts evaluations: what shows the state reads this and then the evaluator. */
  readonly step: ReadonlySignal<number>;
  /** What the evaluator's parameters belong to, in their order: the active layers and the draft. */
  shownLayers(): readonly LayerEntry[];
  /** A layer of the work, or the draft. */
  entryOf(key: number): LayerEntry | undefined;
  /** Where a layer's slider stands, ahead of the document while it is dragged. */
  sliderValue(entry: LayerEntry): number;
  /** One step of a slider: evaluates closures, touches neither the document nor the core. */
  slide(key: number, value: number): void;
}

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

function compile(model: OpenModel | null, active: readonly LayerEntry[]): Compiled {
  if (model === null) return { kind: 'none' };
  const checked = checkProgram(programOf(model.shape, active), model.shape);
  if (!checked.ok) return { kind: 'refused', text: errorMessage(checked.error) };
  const evaluator = compileProgram(checked.value, model.shape);
  return { kind: 'ready', evaluator, keys: active.map(({ key }) => key) };
}

export function createEvaluation(document: ReadonlySignal<Document>): Evaluation {
  const draft = signal<LayerEntry | null>(null);
  const step = signal(0);
  const liveValues = new Map<number, number>();
  let values = new Float64Array(0);
  let lastStructure: readonly unknown[] = [];
  let lastCompiled: Compiled = { kind: 'none' };

  const shownLayers = () => {
    const { model } = document.value;
    const shown = draft.value;
    const fits = shown !== null && model !== null && misfit(model.shape, shown.layer) === null;
    return [...activeLayers(document.value), ...(fits ? [shown] : [])];
  };

  const compiled = computed<Compiled>(() => {
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

  return {
    draft,
    compiled,
    step,
    shownLayers,
    entryOf: (key) => [...document.peek().layers, draft.peek()].find((entry) => entry?.key === key) ?? undefined,
    sliderValue: (entry) => liveValues.get(entry.key) ?? entry.value,
    slide(key, value) {
      const now = compiled.peek();
      const at = now.kind === 'ready' ? now.keys.indexOf(key) : -1;
      if (now.kind !== 'ready' || at < 0) return;
      const { min, max } = now.evaluator.parameters[at] ?? { min: 0, max: 0 };
      values[at] = Math.min(max, Math.max(min, value));
      liveValues.set(key, values[at] as number);
      now.evaluator.evaluate(values);
      step.value = step.peek() + 1;
    },
  };
}
