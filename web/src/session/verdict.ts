// One verdict for all layers together, worked out by the core (core/prove/stack.h) whenever a slider has come to rest, and
// the stops of the sliders that come of it.
import { effect, type ReadonlySignal, type Signal, signal } from '@preact/signals';
import type { MethodResult } from '../worker/protocol';
import { type Document, programOf } from './document';
import { activeLayers, type Stop } from './evaluation';
import type { ModelCore } from './model_core';

export type Verdict = MethodResult<'judge'>;

/** Milliseconds without a change before the core is asked. */
const pause = 250;

interface Watched {
  readonly document: ReadonlySignal<Document>;
  /** Of the layers, by key; written here. */
  readonly stops: Signal<ReadonlyMap<number, Stop>>;
}

/**
 * Follows a document. The verdict is null while fewer than two layers are on, and until the core has answered for the
 * present layers; the stops stay until it has answered for new values.
 */
export function watchVerdict(
  { document, stops }: Watched,
  core: ReadonlySignal<ModelCore | null>,
): ReadonlySignal<Verdict | null> {
  const verdict = signal<Verdict | null>(null);
  let timer: ReturnType<typeof setTimeout> | undefined;
  let structure: readonly unknown[] = [];
  let judged: readonly unknown[] = [];
  effect(() => {
    const now = document.value;
    const asked = core.value;
    const active = activeLayers(now);
    const layers = [now.model, asked, ...active.map(({ layer }) => layer.statements)];
    const values = [...layers, ...active.map(({ value }) => value)];
    const same = (a: readonly unknown[], b: readonly unknown[]) =>
      a.length === b.length && a.every((item, i) => item === b[i]);
    if (!same(layers, structure)) {
      structure = layers;
      judged = [];
      verdict.value = null;
      if (stops.peek().size > 0) stops.value = new Map();
    }
    clearTimeout(timer);
    const { model } = now;
    if (asked === null || model === null || active.length < 2 || same(values, judged)) return;
    timer = setTimeout(async () => {
      const program = programOf(model.shape, active);
      const found = await asked.judge(model, program).catch(() => null);
      if (found === null || document.peek() !== now) return;
      judged = values;
      verdict.value = found;
      stops.value = new Map(active.flatMap(({ key }, i) => (found.stops[i] ? [[key, found.stops[i]] as const] : [])));
    }, pause);
  });
  return verdict;
}
