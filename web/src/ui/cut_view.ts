// Cut parts on the stage: while sliders move, what was cut last follows its hexahedron, and it is cut anew as fast as that
// goes; at rest it is what the program makes.

import { effect, type ReadonlySignal, untracked } from '@preact/signals';
import type { Evaluator } from '../program/compile';
import type { Shape } from '../program/types';
import type { Actor, Stage } from '../scene/stage';
import { type Cutter, cutState, cutterOf, type PartCut } from '../session/cuts';
import { document, family as families, restIsShown, say, step } from '../session/session';
import { t } from '../texts/texts';

/** Answers how to end it. */
export function followCuts(
  on: Stage,
  {
    shown,
    actorOf,
    evaluatorOf,
  }: {
    shown: ReadonlySignal<Shape | null>;
    actorOf: () => Actor | null;
    evaluatorOf: () => Evaluator | null;
  },
): () => void {
  let drawnBy: Actor | null = null;
  const told = new WeakSet<Cutter>(); // once, not with every step of a slider
  const draw = (cuts: readonly PartCut[]) => {
    drawnBy = actorOf();
    for (const cut of cuts) drawnBy?.view.setSurface(cut.part, cut);
    on.invalidate();
  };
  return effect(() => {
    step.value;
    const { model } = document.value;
    if (model === null || shown.value !== model.shape) return;
    const cutter = cutterOf(model);
    if (cutter === null) return;
    cutter.onCuts = (cuts) => shown.peek() === model.shape && draw(cuts);
    cutter.onFailure = (reason) => {
      if (!told.has(cutter)) say(t`What is cut is not drawn as it is: ${reason}. Reload the page.`, 'error');
      told.add(cutter);
    };
    if (drawnBy !== actorOf() && cutter.latest !== null) draw(cutter.latest);
    const evaluator = untracked(evaluatorOf);
    if (evaluator === null) return;
    const { family } = document.peek();
    const setting = family === undefined || restIsShown.value ? null : untracked(() => families.settingNow(family));
    cutter.ask(evaluator.corners, cutState(document.peek(), setting));
  });
}
