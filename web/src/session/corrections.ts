// Joints and mirror images put right by hand, each as a step that undo takes back: the shape is abstracted anew, and the
// edits that were propagated are propagated once more, with what holds now.

import { isAttachment, isReflection, type Shape, type ShapePart, type ShapeRelation } from '../program/types';
import { m, plural, type Sentence, t } from '../texts/texts';
import {
  type Correction,
  type Corrections,
  type Document,
  type LayerEntry,
  noCorrections,
  partKey,
  withCorrections,
  withRequest,
} from './document';
import { misfit } from './evaluation';
import { editOf } from './layer_seed';
import type { ModelCore } from './model_core';
import { carryOver } from './relabel';
import { session } from './session';
import { realParts, standIns } from './several';
import type { RunOptions } from './tasks';

/** Two parts, either of which may stand for a row, and what they are to each other. */
export interface Pair {
  readonly ids: readonly [string, string];
  /** Of a real part of each, which a correction is about. */
  readonly keys: readonly [string, string];
  readonly joint: ShapeRelation | null;
  readonly mirror: ShapeRelation | null;
  /** What was said of the joint by hand. */
  readonly said: Correction['kind'] | null;
}

/** The two parts of a selection; null when it is not of two, or one is in the row that the other stands for. */
export function pairOf(shape: Shape, ids: readonly string[], corrections: Corrections = noCorrections): Pair | null {
  const [a, b, ...others] = standIns(shape, ids);
  if (a === undefined || b === undefined || others.length > 0) return null;
  const real = [realParts(shape, [a]), realParts(shape, [b])] as const;
  if (real[0].some((id) => real[1].includes(id))) return null;
  const between = (p: string, q: string) =>
    shape.relations.filter(({ parts }) => parts.length === 2 && parts.includes(p) && parts.includes(q));
  const relations = between(a, b);
  const keys = nearest(shape, real, relations.length > 0 ? between : null);
  if (keys === null) return null;
  const own = corrections.filter((correction) => sameParts(correction.parts, keys) && !isOfMirrors(correction));
  return {
    ids: [a, b],
    keys,
    joint: relations.find(isAttachment) ?? null,
    mirror: relations.find(isReflection) ?? null,
    said: own.at(-1)?.kind ?? null,
  };
}

const isOfMirrors = ({ kind }: Correction) => kind === 'mirrored' || kind === 'unmirrored';
const sameParts = ([a, b]: Correction['parts'], [c, d]: Correction['parts']) =>
  (a === c && b === d) || (a === d && b === c);

/** The two of a row or of two that a correction names: those that are related, if any are, and lie nearest. */
function nearest(
  shape: Shape,
  [first, second]: readonly [readonly string[], readonly string[]],
  between: ((p: string, q: string) => readonly ShapeRelation[]) | null,
): readonly [string, string] | null {
  const byId = new Map(shape.parts.map((part) => [part.id, part]));
  const parts = (ids: readonly string[]) => ids.flatMap((id) => byId.get(id) ?? []);
  let [found, least]: [readonly [string, string] | null, number] = [null, Number.POSITIVE_INFINITY];
  for (const p of parts(first))
    for (const q of parts(second)) {
      const off = distance(p, q) + (between !== null && between(p.id, q.id).length === 0 ? 100 : 0);
      if (off < least) [found, least] = [[partKey(p), partKey(q)], off];
    }
  return found;
}

function distance(p: ShapePart, q: ShapePart): number {
  const middle = ({ corners }: ShapePart, axis: number) =>
    corners.reduce((sum, corner) => sum + (corner[axis] ?? 0), 0) / 8;
  return Math.hypot(...[0, 1, 2].map((axis) => middle(p, axis) - middle(q, axis)));
}

/** The corrections with one more, which takes the place of what was said of the same. */
const withCorrection = (corrections: Corrections, made: Correction): Corrections => [
  ...corrections.filter((other) => !(sameParts(other.parts, made.parts) && isOfMirrors(other) === isOfMirrors(made))),
  made,
];

const steps: Readonly<Record<Correction['kind'], Sentence>> = {
  joined: m`add a joint`,
  loose: m`loosen a joint`,
  apart: m`remove a joint`,
  mirrored: m`add a mirror image`,
  unmirrored: m`remove a mirror image`,
};

/** Declares what two parts are to each other. False, and a sentence, when they cannot be that. */
export const correct = (core: ModelCore, made: Correction): Promise<boolean> =>
  reabstract(
    core,
    withCorrection(session.document.peek().model?.corrections ?? noCorrections, made),
    t(steps[made.kind]),
  );

/** Takes a correction back, or all of them. */
export const uncorrect = (core: ModelCore, gone: Correction | null): Promise<boolean> =>
  reabstract(
    core,
    gone === null
      ? noCorrections
      : (session.document.peek().model?.corrections ?? noCorrections).filter((other) => other !== gone),
    t`joints as they were found`,
  );

async function reabstract(core: ModelCore, corrections: Corrections, step: string): Promise<boolean> {
  const { document, run, say } = session;
  const before = document.peek();
  const { model } = before;
  if (model === null) return false;
  const known = new Set(warningsOf(model.shape));
  const made = await run(t`Looking at the parts again`, async (options) => {
    const shape = await core.open(model.files, options, model.labels, corrections);
    const refused = warningsOf(shape).find((warning) => !known.has(warning));
    if (refused !== undefined) return { refused };
    const carried = carryOver(before, withCorrections({ ...model, shape }, corrections));
    return propagatedAgain(core, carried, options);
  });
  if (made === null) return false;
  if ('refused' in made) {
    say(t`That cannot be. ${made.refused}.`, 'error');
    return false;
  }
  if (document.peek() !== before) {
    say(t`The work has changed meanwhile, so that nothing was done. Try again.`, 'error');
    return false;
  }
  session.replaceDocument(made.document, step);
  session.useCore(core);
  const [first] = made.document.layers;
  if (first !== undefined) void session.restack(first.key);
  const text = [changesWords(model.shape, made.document.model?.shape ?? model.shape), editsWords(made)];
  say(text.filter(Boolean).join(' '));
  return true;
}

const warningsOf = ({ warnings }: Shape): string[] => warnings.map(({ place, text }) => `${place}: ${text}`);

interface Again {
  readonly document: Document;
  /** Edits that were propagated once more, that could not be, and that nobody propagated. */
  readonly again: number;
  readonly failed: number;
  readonly left: number;
}

/** The edits that propagation had made, made by it once more; the others as they are. */
async function propagatedAgain(core: ModelCore, carried: Document, options: RunOptions): Promise<Again> {
  const { model, layers } = carried;
  let [again, failed, left] = [0, 0, 0];
  const made: LayerEntry[] = [];
  for (const [i, entry] of layers.entries()) {
    const isFound = entry.layer.statements.some(({ why }) => why?.kind === 'seed');
    if (model === null || !isFound) {
      left += 1;
      made.push(entry);
      continue;
    }
    options.onProgress({ step: t`working out the edits again`, done: i, total: layers.length });
    try {
      const found = await core.propagate(model, editOf(entry.layer), { signal: options.signal });
      made.push(inPlaceOf(entry, withRequest(found.program, entry.layer.request).layers, found.trace));
      again += 1;
    } catch (error) {
      options.signal.throwIfAborted();
      if (!(error instanceof Error)) throw error;
      failed += 1;
      made.push(entry);
    }
  }
  return { document: { ...carried, layers: made }, again, failed, left };
}

/** The layer under its old parameter, over no more than its old range. */
function inPlaceOf(entry: LayerEntry, [found]: readonly LayerEntry['layer'][], trace: LayerEntry['trace']): LayerEntry {
  const { name, min: low, max: high } = entry.layer.parameter;
  if (found === undefined) return entry;
  const own = found.parameter.name;
  const inOwn = (amount: string) => amount.replace(/[a-z][a-z0-9_]*/g, (word) => (word === own ? name : word));
  const min = Math.max(low, found.parameter.min);
  const max = Math.min(high, found.parameter.max);
  const { home: _home, trace: _trace, ...rest } = entry;
  return {
    ...rest,
    layer: {
      ...found,
      parameter: { ...found.parameter, name, min, max },
      statements: found.statements.map((statement) =>
        'amount' in statement ? { ...statement, amount: inOwn(statement.amount) } : statement,
      ),
    },
    value: Math.min(max, Math.max(min, entry.value)),
    ...(trace === undefined ? {} : { trace }),
  };
}

const joints = {
  gone: (n: number) => plural(n, '{n} joint removed', '{n} joints removed'),
  fresh: (n: number) => plural(n, '{n} joint added', '{n} joints added'),
  other: (n: number) => plural(n, '{n} joint changed', '{n} joints changed'),
};
const mirrors = {
  gone: (n: number) => plural(n, '{n} mirror image removed', '{n} mirror images removed'),
  fresh: (n: number) => plural(n, '{n} mirror image added', '{n} mirror images added'),
  other: (n: number) => plural(n, '{n} mirror image changed', '{n} mirror images changed'),
};

/** "4 joints removed, 2 mirror images added." What a correction did, its images among it. */
function changesWords(before: Shape, after: Shape): string {
  const of = (shape: Shape) => {
    const real = new Map(shape.parts.filter(({ virtual }) => !virtual).map((part) => [part.id, partKey(part)]));
    const kinds = new Map<string, string>();
    for (const relation of shape.relations) {
      const keys = relation.parts.map((id) => real.get(id));
      const what = isAttachment(relation) ? 'joint' : isReflection(relation) ? 'mirror image' : null;
      if (what !== null && !keys.includes(undefined)) kinds.set([what, ...keys.sort()].join(' '), relation.kind);
    }
    return kinds;
  };
  const [was, is] = [of(before), of(after)];
  const clauses = ['joint', 'mirror image'].flatMap((what) => {
    const words = what === 'joint' ? joints : mirrors;
    const gone = [...was.keys()].filter((key) => key.startsWith(what) && !is.has(key)).length;
    const fresh = [...is.keys()].filter((key) => key.startsWith(what) && !was.has(key)).length;
    const other = [...is].filter(([key, kind]) => key.startsWith(what) && was.has(key) && was.get(key) !== kind).length;
    return [
      ...(gone > 0 ? [words.gone(gone)] : []),
      ...(fresh > 0 ? [words.fresh(fresh)] : []),
      ...(other > 0 ? [words.other(other)] : []),
    ];
  });
  return clauses.length === 0 ? t`Nothing is held otherwise by it.` : `${clauses.join(', ')}.`;
}

function editsWords({ document, again, failed, left }: Again): string {
  const rests = document.layers.filter(({ layer }) => document.model && misfit(document.model.shape, layer)).length;
  return [
    ...(again > 0 ? [plural(again, '{n} edit worked out again.', '{n} edits worked out again.')] : []),
    ...(left > 0 ? [plural(left, '{n} edit written by hand as before.', '{n} edits written by hand as before.')] : []),
    ...(failed > 0
      ? [plural(failed, '{n} edit could not be worked out again.', '{n} edits could not be worked out again.')]
      : []),
    ...(rests > 0
      ? [
          plural(
            rests,
            '{n} edit no longer fits the parts and rests; undo brings it back.',
            '{n} edits no longer fit the parts and rest; undo brings them back.',
          ),
        ]
      : []),
  ].join(' ');
}
