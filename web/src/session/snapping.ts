// Lengths that are dragged stop at whole centimetres, or inches, while this is on. What is typed goes where it says.
import { signal } from '@preact/signals';
import type { LayerEntry, LengthUnit } from './document';
import { type Measure, measureOf } from './measure';
import { readLayer } from './reading';
import { document } from './session';

const key = 'parsel-snap';

const stored = (): boolean => {
  try {
    return localStorage.getItem(key) === 'on';
  } catch {
    return false;
  }
};
/** Kept in the browser: it is how a person works, not part of what they make. */
export const snapping = signal(stored());
export function snap(on: boolean): void {
  snapping.value = on;
  try {
    localStorage.setItem(key, on ? 'on' : 'off');
  } catch {
    // it lasts as long as the page, then
  }
}

/** In metres. */
export const snapStep = (unit: LengthUnit | undefined): number => (unit === 'in' ? 0.0254 : 0.01);

/** What a layer's slider changes, where that is a length. */
export function lengthOf({ layer }: LayerEntry): Measure | null {
  const shape = document.peek().model?.shape;
  if (shape === undefined) return null;
  const seed = layer.statements.find(({ why }) => why?.kind === 'seed') ?? layer.statements[0];
  const measure = measureOf(shape, seed);
  return measure === null || measure.what === 'angle' || measure.what === 'count' ? null : measure;
}

const rounds = 6;
/** As near as lengths have to come, in metres. */
const near = 1e-7;

/**
 * The value of a slider nearest to one at which its length is whole; the value itself while nothing snaps, or where the
 * length does not follow the slider.
 * @param by steps from there, for the keyboard: 1 is the next whole length, −1 the one before
 */
export function snapped(entry: LayerEntry, value: number, by = 0): number {
  const measure = snapping.peek() ? lengthOf(entry) : null;
  if (measure === null) return value;
  const { min, max } = entry.layer.parameter;
  const step = snapStep(document.peek().unit);
  const probe = (max - min) / 500;
  const aside = value + probe <= max ? probe : -probe;
  const [here = 0, there = 0] = readLayer(entry, measure, [value, value + aside]);
  const slope = (there - here) / aside;
  if (!Number.isFinite(slope) || Math.abs(slope) < 1e-9) return value;
  const rising = by * Math.sign(slope);
  const wanted =
    rising === 0
      ? Math.round(here / step) * step
      : rising > 0
        ? (Math.floor(here / step + 1e-4) + rising) * step
        : (Math.ceil(here / step - 1e-4) + rising) * step;
  // Newton's steps, with the slope anew by the last two places.
  let [x0, y0, x1] = [value, here, value + (wanted - here) / slope];
  for (let i = 0; i < rounds; i++) {
    if (x1 < min || x1 > max) return by === 0 ? value : Math.min(max, Math.max(min, x1));
    const [y1 = Number.NaN] = readLayer(entry, measure, [x1]);
    if (Math.abs(y1 - wanted) <= near) return x1;
    const next = x1 - ((y1 - wanted) * (x1 - x0)) / (y1 - y0);
    if (!Number.isFinite(next)) return value;
    [x0, y0, x1] = [x1, y1, next];
  }
  return value;
}
