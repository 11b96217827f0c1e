// Opening: a model by any route, and saved work on one. The work at hand stays until the new one is ready.
import { signal } from '@preact/signals';
import { type LoadedModel, loadModel, type ModelFiles } from '../scene/load';
import type { Saved } from '../share/saved';
import { decompressed } from './decompress';
import {
  type Document,
  emptyDocument,
  type Labels,
  type LayerEntry,
  type ModelSource,
  noLabels,
  type OpenModel,
} from './document';
import { type FileSet, modelOf, readUrl } from './files';
import { galleryUrl } from './gallery';
import type { ModelCore } from './model_core';
import { carryOver } from './relabel';
import { document, misfit, newEntry, replaceDocument, run, say } from './session';

/** Meshes that have been read for a model that is about to be shown; the stage takes them. */
const prepared = new WeakMap<ModelFiles, LoadedModel>();

/** The meshes of a model, read again when the stage has had them before. The caller disposes of them. */
export async function takeLoaded(files: ModelFiles): Promise<LoadedModel> {
  const ready = prepared.get(files);
  prepared.delete(files);
  return ready ?? (await loadModel(files));
}

/** Work that waits for its model to be supplied: what a link names by file name and hash only. */
export const awaited = signal<Saved | null>(null);

/** Camera of the work that was opened last, for the stage to take over. */
export const openedView = signal<Saved['view'] | null>(null);

async function abstract(
  core: ModelCore,
  get: (signal: AbortSignal) => Promise<ModelFiles>,
  source: ModelSource,
  labels: Labels,
): Promise<OpenModel | null> {
  return run('Reading the model', async (options) => {
    const files = await decompressed(await get(options.signal), options);
    const shape = await core.open(files, options, labels);
    prepared.set(files, await loadModel(files));
    options.signal.throwIfAborted();
    return { files, source, shape, labels };
  });
}

function show(model: OpenModel, saved: Saved | null): boolean {
  const next = saved === null ? { ...emptyDocument, model } : documentOf(model, saved);
  openedView.value = saved?.view ?? null;
  replaceDocument(next, `open ${model.shape.name}`);
  const remarks = remarksOn(model);
  if (remarks !== '') say(remarks);
  return true;
}

/** What a person has to know of a model that was opened, in sentences. */
function remarksOn({ files, shape }: OpenModel): string {
  const remarks: string[] = [];
  if (files.decompressed) {
    const { compression, lost } = files.decompressed;
    remarks.push(`The file came compressed with ${compression}; what you export will not be.`);
    if (lost.length > 0) remarks.push(`It loses ${lost.slice(0, 3).join(', ')}.`);
  }
  const left = shape.warnings.map(({ place, text }) => `${place}: ${text}`).slice(0, 3);
  if (left.length > 0) remarks.push(`Left out: ${left.join('; ')}`);
  return remarks.join(' ');
}

/** Saved work on its model. Layers that do not fit it are kept, and shown as such. */
function documentOf(model: OpenModel, saved: Saved): Document {
  const off = new Set(saved.off);
  const layers: LayerEntry[] = saved.program.layers.map((layer, i) =>
    newEntry(layer, layer.parameter.value, !off.has(i)),
  );
  const known = new Set(model.shape.parts.map(({ id }) => id));
  return {
    model,
    layers,
    hidden: new Set(saved.hidden.filter((id) => known.has(id))),
    names: new Map(saved.names.filter(([id]) => known.has(id))),
  };
}

async function openFrom(
  core: ModelCore,
  get: (signal: AbortSignal) => Promise<ModelFiles>,
  source: ModelSource,
  saved: Saved | null,
): Promise<boolean> {
  const model = await abstract(core, get, source, saved?.labels === undefined ? noLabels : new Map(saved.labels));
  if (model === null) return false;
  if (saved !== null && saved.model.sha256 !== model.shape.sha256) {
    say(`${model.shape.name} is not the file that this work was made on (${saved.model.name}).`, 'error');
    return false;
  }
  return show(model, saved);
}

/** Files of a drop or a picker. When work waits for its model, this is taken for it. */
export async function openFiles(core: ModelCore, files: FileSet): Promise<boolean> {
  const saved = awaited.peek();
  const done = await openFrom(core, () => modelOf(files), { kind: 'file' }, saved);
  if (done) awaited.value = null;
  return done;
}

export function openGallery(core: ModelCore, id: string, saved: Saved | null = null): Promise<boolean> {
  return openFrom(
    core,
    async (signal) => modelOf(await readUrl(galleryUrl(id), signal)),
    { kind: 'gallery', id },
    saved,
  );
}

export function openUrl(core: ModelCore, url: string, saved: Saved | null = null): Promise<boolean> {
  return openFrom(core, async (signal) => modelOf(await readUrl(url, signal)), { kind: 'url', url }, saved);
}

/** Files that the browser kept. */
export function reopen(core: ModelCore, files: ModelFiles, source: ModelSource, saved: Saved): Promise<boolean> {
  return openFrom(core, async () => files, source, saved);
}

/** Gives a part another label (null: the file's own): the shape is abstracted anew, and the work carried over to it. */
export async function relabel(core: ModelCore, keys: readonly string[], label: string | null): Promise<boolean> {
  const { model } = document.peek();
  if (model === null) return false;
  const labels = new Map(model.labels);
  for (const key of keys)
    if (label === null) labels.delete(key);
    else labels.set(key, label);
  const shape = await run('Looking at the parts again', (options) => core.open(model.files, options, labels));
  if (shape === null || document.peek().model !== model) return false;
  const next = carryOver(document.peek(), { ...model, shape, labels });
  replaceDocument(next, 'change label');
  const lost = next.layers.filter(({ layer }) => misfit(shape, layer) !== null);
  if (lost.length > 0) {
    const them =
      lost.length === 1
        ? 'One edit no longer fits the parts and rests'
        : `${lost.length} edits no longer fit the parts and rest`;
    say(`${them}. Undo takes the label back.`);
  }
  return true;
}

/** Saved work from a link or a file: opens its model, or asks for it. */
export async function openSaved(core: ModelCore, saved: Saved): Promise<boolean> {
  const { gallery, url, sha256 } = saved.model;
  const { model } = document.peek();
  if (model?.shape.sha256 === sha256 && saved.labels === undefined && model.labels.size === 0)
    return show(model, saved);
  if (model?.shape.sha256 === sha256) return reopen(core, model.files, model.source, saved);
  if (gallery !== undefined) return openGallery(core, gallery, saved);
  if (url !== undefined) return openUrl(core, url, saved);
  awaited.value = saved;
  return false;
}
