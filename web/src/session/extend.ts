// A slider that goes on beyond its end, where what was typed lies there and everything still holds.
import { t } from '../texts/texts';
import { emptyProgram, type LayerEntry } from './document';
import { titleOf } from './layers';
import type { Measure } from './measure';
import type { ModelCore } from './model_core';
import { readLayer, solveLayer } from './reading';
import { change, document, run, setValue } from './session';

/** Parameters are looked at up to here: farthest_range of core/propagate/clean.h. */
const farthest = 16;
const growth = 1.15;

/**
 * The slider value nearest to the range at which a measure reads `wanted`, beyond an end, or the farthest that is looked at
 * where it only comes nearer; null where it does not.
 */
export function solveBeyond(entry: LayerEntry, measure: Measure, wanted: number): number | null {
  const { min, max } = entry.layer.parameter;
  const read = (x: number) => readLayer(entry, measure, [x])[0] ?? Number.NaN;
  const found: number[] = [];
  for (const [end, sign] of [
    [max, 1],
    [min, -1],
  ] as const) {
    let [low, off] = [end, read(end) - wanted];
    for (let step = 0.02; Math.abs(low) < farthest && Number.isFinite(off); step *= growth) {
      const high = low + sign * step;
      const next = read(high) - wanted;
      if (off * next <= 0) {
        found.push(bisected(read, wanted, low, high));
        break;
      }
      if (Math.abs(next) > Math.abs(off)) break; // the other way
      [low, off] = [high, next];
      if (Math.abs(low) >= farthest) found.push(sign * farthest);
    }
  }
  return found.sort((a, b) => Math.abs(a) - Math.abs(b))[0] ?? null;
}

function bisected(read: (x: number) => number, wanted: number, low: number, high: number): number {
  const rising = read(high) > read(low);
  for (let i = 0; i < 40; i++) {
    const middle = (low + high) / 2;
    if (read(middle) < wanted === rising) low = middle;
    else high = middle;
  }
  return high;
}

/**
 * Stretches a slider's range so that the measure reads `wanted`, as far as nothing comes apart, and puts it there, as one
 * step. False when nothing lies beyond.
 */
export async function extendTo(core: ModelCore, entry: LayerEntry, measure: Measure, wanted: number): Promise<boolean> {
  const { model } = document.peek();
  const to = solveBeyond(entry, measure, wanted);
  if (model === null || to === null) return false;
  const program = { ...emptyProgram(model.shape), layers: [entry.layer] };
  const extended = await run(t`Seeing how far it goes`, () => core.extend(model, program, 0, to));
  const layer = extended?.layers[0];
  const now = document.peek().layers.find(({ key }) => key === entry.key);
  if (layer === undefined || now?.layer !== entry.layer) return false;
  const { min, max } = layer.parameter;
  const value = Math.min(max, Math.max(min, to));
  change(t`slide “${titleOf(entry.layer)}”`, (before) => ({
    ...before,
    layers: before.layers.map((other) => (other.key === entry.key ? { ...other, layer, value } : other)),
  }));
  return true;
}

/** Of a length or angle, against what was asked for: what nobody sees. */
const close = 1e-4;

/**
 * Puts a slider where its measure reads `wanted`, or as near as it gets; beyond its end where that holds. Whether it reads
 * that now.
 */
export async function putAt(core: ModelCore, entry: LayerEntry, measure: Measure, wanted: number): Promise<boolean> {
  const reads = (x: number) => {
    const now = document.peek().layers.find(({ key }) => key === entry.key) ?? entry;
    const [read = Number.NaN] = readLayer(now, measure, [x]);
    return Math.abs(read - wanted) <= close * Math.max(1e-2, Math.abs(wanted));
  };
  const found = solveLayer(entry, measure, wanted);
  const { min, max } = entry.layer.parameter;
  const isEnd = found <= min || found >= max;
  if (isEnd && !reads(found) && (await extendTo(core, entry, measure, wanted))) {
    const { value = 0 } = document.peek().layers.find(({ key }) => key === entry.key) ?? {};
    return reads(value);
  }
  setValue(entry.key, found);
  return !isEnd || reads(found);
}
