// One file for model and sliders: the work put into the model's GLB, and found there when it is opened again.

import { checkProgram } from '../program/check';
import { embedSliders, slidersIn, withoutSliders } from '../program/embedded';
import { layersOn, misfitOf, type Sliders, slidersOf } from '../program/sliders';
import { errorMessage, type Shape } from '../program/types';
import type { CameraPose } from '../scene/camera';
import type { ModelFiles } from '../scene/load';
import { readSaved, save, type Work } from '../share/saved';
import { t } from '../texts/texts';
import { type Document, emptyProgram } from './document';
import { misfit } from './evaluation';
import { FileError } from './files';
import type { ModelCore } from './model_core';

/** The work as `parsel/sliders`. Layers that do not fit the shape go along switched off. Throws a FileError. */
export function slidersOfWork(document: Document, view?: CameraPose): Sliders {
  const { program, off, hidden, names, labels, corrections, view: pose, unit, presets, groups } = save(document, view);
  const shape = document.model?.shape as Shape; // save() has thrown where there is none
  const resting = program.layers.flatMap((layer, i) => (off.includes(i) || misfit(shape, layer) !== null ? [i] : []));
  const session = Object.fromEntries(
    Object.entries({ names, labels, corrections, view: pose, unit, presets, groups }).filter(
      ([, value]) => value !== undefined,
    ),
  );
  const sliders = slidersOf(program, shape, { off: resting, hidden, session });
  const together = checkProgram({ ...program, layers: layersOn(sliders) }, shape);
  if (together.ok) return sliders;
  throw new FileError(t`The edits do not go together. ${errorMessage(together.error)}`);
}

/** The model at rest with the work in it. A model of several files becomes one, by the core. Rejects with a FileError. */
export async function oneFile(core: ModelCore, document: Document, view?: CameraPose): Promise<Uint8Array> {
  const sliders = slidersOfWork(document, view);
  const { model } = document;
  if (model === null) throw new FileError(t`There is no model to put sliders into.`);
  const { files, shape } = model;
  const isGlb = files.external.size === 0 && new TextDecoder().decode(files.main.subarray(0, 4)) === 'glTF';
  const glb = isGlb ? files.main : (await core.apply(model, emptyProgram(shape), {})).glb;
  const written = embedSliders(glb, sliders);
  if (written.ok) return written.value;
  throw new FileError(t`The sliders cannot be put into this file. ${errorMessage(written.error)}`);
}

/** Sliders that were found in a file. */
export interface Found {
  /** The work that they are, to be opened on the model. */
  readonly work: Work;
  /** Why they are not those of a shape, in a sentence; null when they are. */
  misfit(shape: Shape): string | null;
}

/** A model without the sliders in it; these; and a sentence on why they were refused. */
export interface Taken {
  readonly files: ModelFiles;
  readonly found: Found | null;
  readonly refused: string | null;
}

const leftOut = (reason: string) => t`The sliders in this file are left out. ${reason}`;

/** Takes the sliders out of a file, so that the model is the one that they were put into, to the byte. */
export function takeSliders(files: ModelFiles): Taken {
  const none: Taken = { files, found: null, refused: null };
  const bare = withoutSliders(files.main);
  if (!bare.ok || bare.value === files.main) return none; // no GLB, or nothing in it
  const own = { ...files, main: bare.value };
  const read = slidersIn(files.main);
  if (!read.ok) return { files: own, found: null, refused: leftOut(errorMessage(read.error)) };
  if (read.value === null) return none;
  const { sliders } = read.value;
  const { name, sha256 } = sliders.shape;
  const work = readSaved({
    names: [],
    ...sliders.session,
    format: 'parsel/session',
    version: 1,
    model: { name, sha256: sha256.padEnd(64, '0') },
    program: sliders.program,
    off: sliders.off,
    hidden: sliders.hidden,
  });
  if (!work.ok) return { files: own, found: null, refused: leftOut(work.text) };
  const misfitWith = (shape: Shape) => {
    const fault = misfitOf(sliders.shape, shape);
    return fault && leftOut(errorMessage(fault));
  };
  return { files: own, found: { work, misfit: misfitWith }, refused: null };
}
