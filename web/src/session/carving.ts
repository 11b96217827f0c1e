// Parts joined, split and cut by hand, and the whole stood up, each as a step that undo takes back. Names, labels and what is hidden go along; edits
// do not, since they are about parts that are others then.

import type { CarveStep, PartKey, Plane } from '../carve/steps';
import type { Shape, Vec3 } from '../program/types';
import { m, plural, t } from '../texts/texts';
import { type CarvedFiles, type Carver, carved } from './carve';
import { type Corrections, type Document, noCorrections, type OpenModel, partKey, withCorrections } from './document';
import type { ModelCore } from './model_core';
import { prepare } from './open';
import { document, replaceDocument, run, say, selectAll } from './session';
import { realParts } from './several';

/** Why nothing can be changed by hand now, in a sentence; null when it can. */
export function whyUncarvable({ model, layers }: Document): string | null {
  if (model === null) return t`Open a model first.`;
  if (layers.length > 0) return t`Take the edits back first: they belong to the parts as they are.`;
  if (model.files.cad !== undefined) return t`The parts of a CAD program are the program’s own: change them there.`;
  return null;
}

/** Keys of the real parts that some ids stand for. */
export function keysOf(shape: Shape, ids: readonly string[]): PartKey[] {
  const real = new Set(realParts(shape, ids));
  return shape.parts.filter(({ id }) => real.has(id)).map(partKey);
}

const doing = {
  join: m`Joining the parts`,
  divide: m`Splitting the part`,
  cut: m`Cutting the parts`,
  place: m`Standing the model up`,
} as const;
const done = { join: m`join parts`, divide: m`split part`, cut: m`cut parts`, place: m`how it stands` } as const;

/** Does a step as one of the history, and selects the new parts. False, and a sentence, when it cannot be done. */
export async function carveModel(core: ModelCore, step: CarveStep, carve: Carver = carved): Promise<boolean> {
  const before = document.peek();
  const { model } = before;
  const why = whyUncarvable(before);
  if (why !== null || model === null) {
    say(why ?? '', 'error');
    return false;
  }
  const made = await run(t(doing[step.kind]), async (options) => {
    const found = await carve(model.files, step, options);
    const labels = new Map([...model.labels].map(([key, label]) => [newKey(found, key), label]));
    const corrections = correctionsAfter(model, step, found);
    const shape = await core.open(found.files, options, labels, corrections);
    await prepare(found.files);
    options.signal.throwIfAborted();
    return { found, model: withCorrections({ ...model, files: found.files, shape, labels }, corrections) };
  });
  if (made === null || document.peek().model !== model) return false;
  const { found } = made;
  replaceDocument(onto(before, made.model, found), t(done[step.kind]));
  if (step.kind === 'place') return true;
  const isNew = new Set(found.made);
  selectAll(made.model.shape.parts.filter((part) => !part.virtual && isNew.has(partKey(part))).map(({ id }) => id));
  if (found.lost.length > 0) say(t`The file loses ${found.lost.slice(0, 3).join(', ')}, which is not known here.`);
  else if (found.open.length > 0) say(openWords(found.open));
  return true;
}

const openWords = (names: readonly string[]): string =>
  plural(
    names.length,
    'The cut through {0} stays open: only closed solids are closed again.',
    'The cuts through {n} parts stay open ({0}): only closed solids are closed again.',
    `${names.slice(0, 3).join(', ')}${names.length > 3 ? ', …' : ''}`,
  );

const newKey = ({ moved }: Pick<CarvedFiles, 'moved'>, key: PartKey): PartKey =>
  moved.find(([from]) => from === key)?.[1] ?? key; // parts of one node: few

/** Those between parts that the step leaves alone. */
function correctionsAfter(
  { corrections = noCorrections }: OpenModel,
  step: CarveStep,
  found: CarvedFiles,
): Corrections {
  const changed: readonly PartKey[] = step.kind === 'divide' ? [step.part] : step.kind === 'place' ? [] : step.parts;
  return corrections
    .filter(({ parts }) => !parts.some((key) => changed.includes(key)))
    .map(({ kind, parts: [a, b] }) => ({ kind, parts: [newKey(found, a), newKey(found, b)] }));
}

/** What was said of the parts that are still there. */
function onto(document: Document, model: OpenModel, found: CarvedFiles): Document {
  const keyOf = new Map(document.model?.shape.parts.map((part) => [part.id, partKey(part)]));
  const idOf = new Map(model.shape.parts.filter(({ virtual }) => !virtual).map((part) => [partKey(part), part.id]));
  const idNow = (id: string): string[] => {
    const key = keyOf.get(id);
    const now = key === undefined ? undefined : idOf.get(newKey(found, key));
    return now === undefined ? [] : [now];
  };
  return {
    ...document,
    model,
    hidden: new Set([...document.hidden].flatMap(idNow)),
    names: new Map([...document.names].flatMap(([id, name]) => idNow(id).map((now) => [now, name] as const))),
  };
}

/** A plane of the normalised frame in the file's own metres. @param normal of length 1 */
export function planeInFile({ frame }: Shape, normal: Vec3, offset: number): Plane {
  const axes = frame.axes ?? [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ];
  const own = [0, 1, 2].map((i) => axes.reduce((sum, axis, k) => sum + (normal[k] ?? 0) * (axis[i] ?? 0), 0));
  const [x = 0, y = 0, z = 0] = own;
  const distance = x * frame.centre[0] + y * frame.centre[1] + z * frame.centre[2] + frame.scale * offset;
  return [x, y, z, distance];
}
