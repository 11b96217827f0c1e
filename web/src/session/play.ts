// Playing a slider: once when a layer is new, so that its effect is seen before it is read, or on and on when asked.
import { signal } from '@preact/signals';
import { document, settle, slide, sliderValue } from './session';

/** Key of the layer that is being played, or null. */
export const playing = signal<number | null>(null);

const period = 1600; // milliseconds there and back
const oncePeriod = 1200;
let frame = 0;

export const prefersReducedMotion = (): boolean => matchMedia('(prefers-reduced-motion: reduce)').matches;

function parameterOf(key: number) {
  return document.peek().layers.find((entry) => entry.key === key)?.layer.parameter;
}

/** From 0 to the maximum (or the minimum, where that is farther) and back to the present value. */
export function playOnce(key: number): void {
  const parameter = parameterOf(key);
  const entry = document.peek().layers.find((other) => other.key === key);
  if (parameter === undefined || entry === undefined || prefersReducedMotion()) return;
  const end = Math.abs(parameter.min) > parameter.max ? parameter.min : parameter.max;
  const start = sliderValue(entry);
  const valueAt = (t: number) => (t >= 1 ? null : start + ((end - start) * (1 - Math.cos(2 * Math.PI * t))) / 2);
  run(key, (milliseconds) => valueAt(milliseconds / oncePeriod), start);
}

/** Over the whole range until it is stopped; then the slider is back where it was. */
export function playOn(key: number): void {
  const parameter = parameterOf(key);
  const entry = document.peek().layers.find((other) => other.key === key);
  if (parameter === undefined || entry === undefined) return;
  const { min, max } = parameter;
  const start = sliderValue(entry);
  // Begins where the slider is: phase of the cosine at which the value is `start`.
  const phase = Math.acos(Math.min(1, Math.max(-1, 1 - (2 * (start - min)) / (max - min || 1))));
  run(
    key,
    (milliseconds) => min + ((max - min) * (1 - Math.cos(phase + (Math.PI * milliseconds) / period))) / 2,
    start,
  );
}

let back: number | null = null;

export function stop(): void {
  const key = playing.peek();
  cancelAnimationFrame(frame);
  playing.value = null;
  if (key !== null && back !== null) slide(key, back);
  back = null;
}

/** A hand on the slider takes over where it is. */
export function interrupt(): void {
  cancelAnimationFrame(frame);
  const key = playing.peek();
  playing.value = null;
  back = null;
  if (key !== null) settle(key);
}

function run(key: number, valueAt: (milliseconds: number) => number | null, rest: number): void {
  stop();
  playing.value = key;
  back = rest;
  const begin = performance.now();
  const next = (now: number) => {
    const value = parameterOf(key) === undefined ? null : valueAt(now - begin);
    if (value === null) return stop();
    slide(key, value);
    frame = requestAnimationFrame(next);
  };
  frame = requestAnimationFrame(next);
}
