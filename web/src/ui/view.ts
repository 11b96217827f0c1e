// The one stage of the page, and what the interface shows on it.

import { effect, signal, untracked } from '@preact/signals';
import type { Evaluator } from '../program/compile';
import type { Shape } from '../program/types';
import { brightnessOf } from '../scene/brightness';
import type { LoadedModel, ModelFiles } from '../scene/load';
import type { Tint } from '../scene/model_view';
import { noTint } from '../scene/model_view';
import { type Actor, Stage } from '../scene/stage';
import { openedView, takeLoaded } from '../session/open';
import { prefersReducedMotion } from '../session/play';
import { pull } from '../session/pull';
import { compiled, document, hovered, pointedAt, say, selected, selection, step } from '../session/session';
import { realParts } from '../session/several';
import { t } from '../texts/texts';
import { followCuts } from './cut_view';
import { theme } from './theme';

export const stage = signal<Stage | null>(null);
/** Shape that stands on the stage. */
export const shown = signal<Shape | null>(null);
let shownFiles: ModelFiles | null = null;
/** How far the parts are drawn apart, 0 … 1. */
export const apart = signal(0);

/** All the way apart, or back together, in a moment. */
export function toggleApart(): void {
  const from = apart.peek();
  const to = from > 0 ? 0 : 1;
  if (document.peek().model === null) return;
  cancelAnimationFrame(apartFrame);
  if (prefersReducedMotion()) {
    apart.value = to;
    stage.peek()?.fit(null);
    return;
  }
  const begin = performance.now();
  const next = (now: number) => {
    const t = Math.min(1, (now - begin) / 350);
    apart.value = from + (to - from) * (1 - (1 - t) ** 3);
    if (t < 1) apartFrame = requestAnimationFrame(next);
    else stage.peek()?.fit(null);
  };
  apartFrame = requestAnimationFrame(next);
}
let apartFrame = 0;
/** Whether clicks add to the selection. */
export const several = signal(false);
/** Of the model that is shown, 0 black … 1 white. */
export const brightness = signal(0.5);
export const showColours = signal(false);
let actor: Actor | null = null;

export function currentEvaluator(): Evaluator | null {
  const now = compiled.peek();
  return now.kind === 'ready' ? now.evaluator : null;
}

/** Starts the stage on a canvas; answers how to end it. */
export function mountStage(canvas: HTMLCanvasElement): () => void {
  const created = new Stage(canvas, prefersReducedMotion());
  created.onContext = (lost) =>
    lost ? say(t`The graphics card was reset. The picture will be back in a moment; your work is kept.`) : say('');
  stage.value = created;
  const stops = [
    effect(() => created.setTheme(theme.value)),
    effect(() => void showModel(created)),
    effect(() => {
      step.value;
      const shape = shown.value;
      // While another model is being loaded, the one that is shown stays as it was drawn last.
      const isCurrent = untracked(() => document.value.model?.shape) === shape;
      const evaluator = isCurrent ? untracked(currentEvaluator) : null;
      const isPulled = pull.value !== null;
      if (evaluator === null) return;
      created.update(evaluator);
      // A hand that pulls must not have the view move below it; once it lets go, it may.
      if (!isPulled && shownFiles !== null) created.keepInView();
    }),
    effect(() => {
      const { hidden, model } = document.value;
      if (shown.value !== (model?.shape ?? null)) return;
      for (const [i, { id }] of (model?.shape.parts ?? []).entries()) actor?.view.setHidden(i, hidden.has(id));
      created.invalidate();
    }),
    followCuts(created, { shown, actorOf: () => actor, evaluatorOf: currentEvaluator }),
    effect(() => created.setApart(apart.value)),
    effect(() => light(created)),
  ];
  return () => {
    for (const stop of stops) stop();
    created.dispose();
    stage.value = null;
    actor = null;
    shown.value = shownFiles = null;
  };
}

async function showModel(on: Stage): Promise<void> {
  const { model } = document.value;
  if (model === null || model.shape === untracked(() => shown.value)) return;
  let loaded: LoadedModel;
  try {
    loaded = await takeLoaded(model.files);
  } catch (error) {
    return say(t`The model cannot be drawn: ${error instanceof Error ? error.message : String(error)}.`, 'error');
  }
  if (document.peek().model !== model || stage.peek() !== on) return loaded.dispose();
  brightness.value = brightnessOf(loaded);
  actor = on.show(loaded, model.shape);
  const isAnother = shownFiles !== model.files;
  shownFiles = model.files;
  if (isAnother) apart.value = 0;
  shown.value = model.shape;
  const evaluator = currentEvaluator();
  if (evaluator === null) return;
  on.update(evaluator);
  const view = openedView.peek();
  openedView.value = null;
  if (isAnother) on.fit(null, false);
  if (view) on.rig.pose = view;
}

/** Brings the selected part, or everything, into view. */
export function focusView(): void {
  const part = selection.peek()?.part;
  const index = document.peek().model?.shape.parts.findIndex(({ id }) => id === part) ?? -1;
  stage.peek()?.fit(index < 0 ? null : index);
}

/** Tints and overlays: the selected part lit and the rest a little dimmed, hovered and pointed-at parts lit. */
function light(on: Stage): void {
  const { model } = document.value;
  if (model === null || shown.value !== model.shape || actor === null) return;
  const { accentRgb, groundRgb } = theme.value;
  const tint = (rgb: readonly [number, number, number], strength: number): Tint => [...rgb, strength];
  const lit = tint(accentRgb, 0.34);
  const soft = tint(accentRgb, 0.16);
  const dimmed = tint(groundRgb, 0.45);

  const chosen = new Set(realParts(model.shape, selected.value));
  const over = expand(hovered.value);
  const pointed = new Set((pointedAt.value?.parts ?? []).flatMap((id) => [...expand(id)]));
  const colours = showColours.value;
  for (const [i, { id }] of model.shape.parts.entries()) {
    const own = colours ? tint(partColour(i), 0.75) : noTint;
    const focus = pointed.size > 0 ? pointed : chosen;
    const isLit = focus.has(id);
    actor.view.setTint(i, isLit ? lit : over.has(id) ? soft : focus.size > 0 && !colours ? dimmed : own);
  }
  const relations = (pointedAt.value?.relations ?? []).map((id) =>
    model.shape.relations.findIndex((relation) => relation.id === id),
  );
  const indexOf = (wanted: string | undefined) => model.shape.parts.findIndex(({ id }) => id === wanted);
  const part = indexOf(selection.value?.part);
  const faces = (pointedAt.value?.faces ?? []).map((face) => ({ ...face, part: indexOf(face.part) }));
  if (on.corners.length > 0) {
    actor.overlays.show({ part, feature: selection.value?.feature ?? [0, 0, 0], relations, faces }, on.corners);
  }
  on.invalidate();
}

/** A virtual part lights its instances. */
function expand(id: string | null): ReadonlySet<string> {
  if (id === null) return new Set();
  const part = document.peek().model?.shape.parts.find((other) => other.id === id);
  return new Set([id, ...(part?.members ?? [])]);
}

/** Hues a golden angle apart, so that neighbours in the list differ. */
function partColour(i: number): [number, number, number] {
  const hue = (i * 0.381966) % 1;
  return [0, 1 / 3, 2 / 3].map((shift) => 0.5 + 0.33 * Math.cos(2 * Math.PI * (hue + shift))) as [
    number,
    number,
    number,
  ];
}
