// A length that is typed for the whole or for a part: the slider that changes it is put there, or made first.

import type { Axis, Shape, Statement } from '../program/types';
import { m, t } from '../texts/texts';
import type { Target } from '../worker/protocol';
import type { EditInput, LayerEntry } from './document';
import { activeLayers } from './evaluation';
import { putAt } from './extend';
import { seedsOf } from './layer_seed';
import { measureOf, sizeOf } from './measure';
import type { ModelCore } from './model_core';
import { compiled, document, propagate, say } from './session';
import { measureAimed } from './target';

const names = ['width', 'height', 'depth'] as const;
const titles = [m`Width`, m`Height`, m`Depth`] as const;
const titlesOf = [m`{0} width`, m`{0} height`, m`{0} depth`] as const;
const whichSets = [
  m`Which part sets the width? Select it and type its width, or say what to change.`,
  m`Which part sets the height? Select it and type its height, or say what to change.`,
  m`Which part sets the depth? Select it and type its depth, or say what to change.`,
] as const;
/** In requests, which are read in English. */
const adjectives = ['wide', 'high', 'deep'] as const;
/** Of a slider: what is asked for lies within, so that there is way to go beyond. */
const farEnd = 0.3;

/** A stretch of a part along the edge of its own that is most along an axis; what is higher stays on what it stands on. */
export function stretchOf(shape: Shape, part: string, axis: Axis, ratio: number): Statement | null {
  const axes = shape.parts.find(({ id }) => id === part)?.axes;
  if (axes === undefined) return null;
  const along = axes.map((own) => Math.abs(own[axis]));
  const own = along.indexOf(Math.max(...along)) as Axis;
  const factor = Math.max(1, Math.ceil(Math.abs(ratio - 1) / farEnd));
  const amount = `${ratio < 1 ? '-' : ''}${factor === 1 ? '' : `${factor}*`}x`;
  const end = axis === 1 ? ((axes[own][1] > 0 ? -1 : 1) as -1 | 1) : 0;
  const at = [0, 0, 0].map((_, i) => (i === own ? end : 0)) as unknown as readonly [0, 0, 0];
  return {
    op: 'scale_1d',
    part,
    feature: [0, 0, 0],
    origin: { part, at },
    direction: { part, axis: own },
    amount,
  };
}

/** What a statement acts on and how, without from where and how far. */
const acts = (seeds: readonly Statement[]): string =>
  JSON.stringify(
    seeds.map((seed) => {
      const fields: Readonly<Record<string, unknown>> = { ...seed };
      return ['op', 'part', 'relation', 'feature', 'direction', 'normal', 'axis'].map((name) => fields[name] ?? null);
    }),
  );

/** The slider that changes this length of a part, or that the edit would make: the last one that does. */
function fitting(shape: Shape, part: string | null, axis: Axis, edit: EditInput): LayerEntry | undefined {
  return activeLayers(document.peek()).findLast(({ layer }) => {
    const seeds = seedsOf(layer);
    if (part === null) return acts(seeds) === acts(edit.seed);
    const measure = measureOf(shape, seeds[0]);
    return measure?.part === part && measure.what === names[axis];
  });
}

/** What is asked for in words is read with the rules that tell which part sets the size of the whole. */
async function editFor(
  core: ModelCore,
  part: string | null,
  axis: Axis,
  metres: number,
  now: number,
): Promise<EditInput | null> {
  const { model } = document.peek();
  if (model === null) return null;
  if (part !== null) {
    const seed = stretchOf(model.shape, part, axis, metres / now);
    return seed && { seed: [seed], disabled: [], hints: {} };
  }
  const { plain } = await core.readPlainly(model, `make it ${metres.toFixed(4)} m ${adjectives[axis]}`, []);
  const [first] = plain.readings;
  if (!plain.sure || first === undefined) {
    say(t(whichSets[axis]));
    return null;
  }
  return { seed: [], disabled: [], hints: {}, ...first.edit };
}

/** Gives the whole (null) or a part this length along an axis, in metres, or as near as it gets, which is then said. */
export async function setLength(core: ModelCore, part: string | null, axis: Axis, metres: number): Promise<void> {
  const { model } = document.peek();
  const state = compiled.peek();
  if (model === null || state.kind !== 'ready') return;
  const index = part === null ? null : model.shape.parts.findIndex(({ id }) => id === part);
  const now = sizeOf(model.shape, state.evaluator, index)[axis];
  const target: Target = { part, what: names[axis], to: metres, x: 0 };
  const edit = await editFor(core, part, axis, metres, now);
  if (edit === null || document.peek().model !== model) return;
  const known = fitting(model.shape, part, axis, edit);
  const put = async (entry: LayerEntry | undefined) => {
    if (entry === undefined) return;
    const measure = measureAimed(model.shape, target, seedsOf(entry.layer)[0]);
    if (measure !== null && !(await putAt(core, entry, measure, metres)))
      say(t`The slider goes no further: beyond, a part would turn inside out or something come apart.`);
  };
  if (known !== undefined) return put(known);
  const name = model.shape.parts.find(({ id }) => id === part)?.name ?? part;
  const title = name === null ? t(titles[axis]) : t(titlesOf[axis], name);
  const key = await propagate(core, edit, title.charAt(0).toUpperCase() + title.slice(1));
  if (key === null) return;
  await put(document.peek().layers.find((entry) => entry.key === key));
}
