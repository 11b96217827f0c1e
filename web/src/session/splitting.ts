// A model in one piece: its parts told apart on request, as a step that undo takes back.

import { batch, computed, signal } from '@preact/signals';
import type { ModelFiles, SplitBy } from '../scene/load';
import { m, t } from '../texts/texts';
import { emptyDocument, noLabels, type OpenModel } from './document';
import type { ModelCore } from './model_core';
import { prepare } from './open';
import { document, replaceDocument, run, say, undo, undoLabel } from './session';

/** Fewer parts, and little can follow an edit: splitting is offered. */
const fewParts = 3;
export const splitDefaults = { by: 'auto', fine: 0.5 } as const;

/** Models for which nothing came apart, or for which the offer was declined. */
const settled = signal<ReadonlySet<ModelFiles>>(new Set());

const partsOf = ({ shape }: OpenModel): number => shape.parts.filter(({ virtual }) => !virtual).length;

/** Whether to offer to split the model: it has few parts, and it was not tried. */
export const offersSplit = computed(() => {
  const { model } = document.value;
  return (
    model !== null && model.files.split === undefined && !settled.value.has(model.files) && partsOf(model) < fewParts
  );
});

/** How the present model was split, and into how many parts; null when it was not. */
export const splitNow = computed(() => {
  const { model } = document.value;
  if (model?.files.split === undefined) return null;
  return { ...model.files.split, parts: partsOf(model), isCarved: model.files.carved !== undefined };
});

export function declineSplit(): void {
  const files = document.peek().model?.files;
  if (files) settled.value = new Set([...settled.peek(), files]);
}

/** What each way to tell the parts of a file apart gives. */
export interface Ways {
  readonly of: ModelFiles;
  readonly fine: number;
  /** Those that tell something apart, each otherwise than the one before. */
  readonly found: readonly Way[];
}
export interface Way {
  readonly by: SplitBy;
  readonly parts: number;
  /** More than a model may have. */
  readonly isTooMany: boolean;
}

const looked = signal<Ways | null>(null);

/**
 * The ways that were found for the present model, whether it is split by now or not; null before anyone has asked, or when it is
 * split otherwise fine by now.
 */
export const waysNow = computed(() => {
  const files = document.value.model?.files;
  const ways = looked.value;
  if (ways === null || files === undefined || ways.of !== (files.split?.from ?? files)) return null;
  return files.split === undefined || files.split.fine === ways.fine ? ways : null;
});

/** Whether the model is split as a way says: by it, or, where the best was asked for, into as many parts. */
export function isSplitSo(now: { by: SplitBy; parts: number } | null, { by, parts }: Way): boolean {
  if (now === null || now.parts !== parts) return false;
  return now.by === by || (now.by === 'auto' && by !== 'materials'); // the best is never by material alone
}

/** Looks what each way to split the model would give, as fine as it is split now; a sentence where none gives anything. */
export async function findWays(core: ModelCore): Promise<void> {
  const { model } = document.peek();
  if (model === null) return;
  const of = model.files.split?.from ?? model.files;
  const fine = model.files.split?.fine ?? splitDefaults.fine;
  const answer = await run(t`Looking for ways to split it`, (options) => core.splitWays(of, fine, options));
  if (answer === null || document.peek().model !== model) return;
  const { before, ways } = answer;
  // Creases tell what hangs together apart further: where they find nothing more, it is the same.
  const hanging = ways.find(({ by }) => by === 'components')?.parts;
  const found = ways
    .filter(({ by, parts }) => parts !== before && !(by === 'regions' && parts === hanging))
    .map(({ by, parts, too_many }) => ({ by, parts, isTooMany: too_many }));
  looked.value = { of, fine, found };
  if (found.length > 0) return;
  settled.value = new Set([...settled.peek(), of]);
  say(t`There is nothing to tell apart in this model. Select a part to cut it by hand.`);
}

const stepLabel = m`split into parts`;

/**
 * Tells the parts of the model apart, or, when that was done already, does it anew in another way. One step: doing it
 * anew takes the place of the step before. Edits, labels and names of the model in one piece do not go along.
 */
export async function splitModel(core: ModelCore, by: SplitBy, fine: number): Promise<boolean> {
  const { model } = document.peek();
  if (model === null) return false;
  const from = model.files.split?.from ?? model.files;
  const made = await run(t`Looking for the parts`, async (options) => {
    const split = await core.split(from, { by, fine }, options);
    if (split.parts === split.before) return { split, shape: null };
    const shape = await core.open(split.files, options);
    await prepare(split.files);
    options.signal.throwIfAborted();
    return { split, shape };
  });
  if (made === null || document.peek().model !== model) return false;
  const { split, shape } = made;
  if (shape === null) {
    settled.value = new Set([...settled.peek(), from]);
    const remarks = split.remarks.slice(0, 3).join('; ');
    say(
      remarks === ''
        ? t`Nothing in this model comes apart this way. Select a part to cut it by hand.`
        : t`Nothing in this model comes apart this way: ${remarks}.`,
    );
    return false;
  }
  const next = { ...emptyDocument, model: { files: split.files, source: model.source, shape, labels: noLabels } };
  batch(() => {
    // A second try is no step of its own, as long as nothing was done since.
    if (model.files.split && undoLabel.peek() === t(stepLabel)) undo();
    replaceDocument(next, t(stepLabel));
  });
  if (split.remarks.length > 0) say(t`Split, but for this: ${split.remarks.slice(0, 3).join('; ')}.`);
  return true;
}
