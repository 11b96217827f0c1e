// Opening: a model by any route, and saved work on one. The work at hand stays until the new one is ready.

import { computed, signal } from '@preact/signals';
import { type LoadedModel, loadModel, type ModelFiles } from '../scene/load';
import { withExtras } from '../share/extras';
import { lostWords, type Saved, type Work } from '../share/saved';
import { plural, t } from '../texts/texts';
import { carved, carvedAs } from './carve';
import { converted } from './convert';
import { firstCuts, isCut } from './cuts';
import { decompressed } from './decompress';
import {
  type Document,
  emptyDocument,
  isAsFound,
  type Labels,
  type LayerEntry,
  type ModelSource,
  noCorrections,
  noLabels,
  type OpenModel,
  withCorrections,
} from './document';
import { misfit } from './evaluation';
import { familyOf, withProgramRead } from './family';
import type { FamilySource } from './family_found';
import { withFamily } from './family_state';
import { addressOf, type FileSet, type FoundFiles, modelOf, readUrl } from './files';
import { galleryUrl, programUrls } from './gallery';
import type { ModelCore } from './model_core';
import { takeSliders } from './one_file';
import { carryOver } from './relabel';
import { document, newEntry, replaceDocument, run, say } from './session';
import { splitAs } from './split_files';

/** Meshes that have been read for a model that is about to be shown; the stage takes them. */
const prepared = new WeakMap<ModelFiles, LoadedModel>();

/** Reads the meshes of a model that is about to be shown. */
export async function prepare(files: ModelFiles): Promise<void> {
  prepared.set(files, await loadModel(files));
}

/** The meshes of a model, read again when the stage has had them before. The caller disposes of them. */
export async function takeLoaded(files: ModelFiles): Promise<LoadedModel> {
  const ready = prepared.get(files);
  prepared.delete(files);
  return ready ?? (await loadModel(files));
}

/** Work that waits for its model: for its file, or for leave to fetch it from the address that it names. */
export const awaited = signal<Work | null>(null);

/** Where the work that waits would fetch its model from, in full; null when it names no address. */
export const awaitedAddress = computed(() => {
  const url = awaited.value?.saved.model.url;
  return url === undefined ? null : addressOf(url);
});

/** Address of a model that a link names, which waits for leave to be fetched. */
export const offered = signal<string | null>(null);

/** Camera of the work that was opened last, for the stage to take over. */
export const openedView = signal<Saved['view'] | null>(null);

/** A model that was read, and the work to show on it. */
interface Opened {
  readonly model: OpenModel;
  readonly work: Work | null;
  /** Of a CAD program. */
  readonly family: FamilySource | null;
  /** A sentence on sliders in the file that are left out, or on cuts that are not drawn. */
  readonly refused: string | null;
}

/** Reads and abstracts a model. Sliders in its file are taken for the work on it where no other is given. */
async function abstract(
  core: ModelCore,
  get: (signal: AbortSignal) => Promise<FoundFiles>,
  source: ModelSource,
  given: Work | null,
): Promise<Opened | null> {
  return run(t`Reading the model`, async (options) => {
    const picked = await withProgramRead(core, await get(options.signal), options);
    const taken = takeSliders(await converted(picked, options));
    const found = given === null ? taken.found : null;
    const whole = await splitAs(given?.saved.split, await decompressed(taken.files, options), core, options);
    const files = await carvedAs(given?.saved.carved, whole, carved, options);
    const said = given ?? found?.work ?? null;
    let [labels, corrections] = [labelsOf(said), said?.saved.corrections ?? noCorrections];
    let shape = await core.open(files, options, labels, corrections);
    const misfits = found?.misfit(shape) ?? null;
    if (misfits !== null && !isAsFound({ labels, corrections })) {
      [labels, corrections] = [noLabels, noCorrections];
      shape = await core.open(files, options);
    }
    const family = await familyOf(core, { files, shape }, given?.saved.family, options);
    await prepare(files);
    options.signal.throwIfAborted();
    const model = withCorrections({ files, source, shape, labels }, corrections);
    if (isCut(files)) options.onProgress({ step: t`cutting parts`, done: 0, total: 1 });
    const uncut = await firstCuts(model, options.signal);
    if (given !== null) return { model, work: given, family, refused: uncut };
    const own = misfits === null ? (found?.work ?? null) : null;
    return { model, work: own, family, refused: misfits ?? taken.refused ?? uncut };
  });
}

const labelsOf = (work: Work | null): Labels =>
  work?.saved.labels === undefined ? noLabels : new Map(work.saved.labels);

function show(model: OpenModel, work: Work | null, family: FamilySource | null): boolean {
  const bare = work === null ? { ...emptyDocument, model } : documentOf(model, work.saved);
  const next = withFamily(bare, family, work?.saved.family, newEntry);
  openedView.value = work?.saved.view ?? null;
  offered.value = null;
  replaceDocument(next, t`open ${model.shape.name}`);
  const remarks = [remarksOn(model), work === null ? '' : lostWords(work)].filter(Boolean).join(' ');
  if (remarks !== '') say(remarks);
  return true;
}

/** What a person has to know of a model that was opened, in sentences. */
function remarksOn({ files, shape }: OpenModel): string {
  const remarks: string[] = [];
  if (files.converted) {
    const { format } = files.converted;
    const again = ['OBJ', 'STL'].includes(format);
    remarks.push(
      again
        ? t`The file was made a GLB; it can be exported as one, or as ${format} again.`
        : t`The file was made a GLB; what you export will be one, no ${format}.`,
    );
    remarks.push(...files.converted.remarks);
  }
  remarks.push(...(files.cad?.remarks ?? []));
  if (files.decompressed) {
    const { compression, lost } = files.decompressed;
    remarks.push(t`The file came compressed with ${compression}; what you export will not be.`);
    if (lost.length > 0) remarks.push(t`It loses ${lost.slice(0, 3).join(', ')}.`);
  }
  // Of the whole, nothing was left out; that it is one part, the offer to split it says.
  const isOfWhole = ({ place }: { readonly place: string }) => place === 'file';
  for (const { text } of shape.warnings.filter(isOfWhole)) {
    if (!/^the model is one part/.test(text)) remarks.push(`${text.charAt(0).toUpperCase()}${text.slice(1)}.`);
  }
  const others = shape.warnings.filter((warning) => !isOfWhole(warning));
  const left = others.map(({ place, text }) => `${place}: ${text}`).slice(0, 3);
  if (left.length > 0) remarks.push(t`Left out: ${left.join('; ')}`);
  return remarks.join(' ');
}

/** Saved work on its model. Layers that do not fit it are kept, and shown as such. */
function documentOf(model: OpenModel, saved: Saved): Document {
  const off = new Set(saved.off);
  const layers: LayerEntry[] = saved.program.layers.map((layer, i) =>
    newEntry(layer, layer.parameter.value, !off.has(i)),
  );
  const known = new Set(model.shape.parts.map(({ id }) => id));
  const document: Document = {
    model,
    layers,
    hidden: new Set(saved.hidden.filter((id) => known.has(id))),
    names: new Map(saved.names.filter(([id]) => known.has(id))),
  };
  return withExtras(document, saved);
}

async function openFrom(
  core: ModelCore,
  get: (signal: AbortSignal) => Promise<FoundFiles>,
  source: ModelSource,
  work: Work | null,
): Promise<boolean> {
  const opened = await abstract(core, get, source, work);
  if (opened === null) return false;
  const { model, family, refused } = opened;
  if (work !== null && work.saved.model.sha256 !== model.shape.sha256) {
    say(t`${model.shape.name} is not the file that this work was made on (${work.saved.model.name}).`, 'error');
    return false;
  }
  show(model, opened.work, family);
  if (refused !== null) say(refused, 'error');
  return true;
}

/** Files of a drop or a picker. When work waits for its model, this is taken for it. */
export async function openFiles(core: ModelCore, files: FileSet): Promise<boolean> {
  const done = await openFrom(core, () => modelOf(files), { kind: 'file' }, awaited.peek());
  if (done) awaited.value = null;
  return done;
}

export function openGallery(core: ModelCore, id: string, work: Work | null = null): Promise<boolean> {
  const get = async (signal: AbortSignal) => {
    const urls = programUrls(id) ?? [galleryUrl(id)];
    const read = await Promise.all(urls.map((url) => readUrl(url, signal)));
    return modelOf(new Map(read.flatMap((files) => [...files])));
  };
  return openFrom(core, get, { kind: 'gallery', id }, work);
}

/** Sends a GET to the address: only where a person has typed it or has said so. */
export function openUrl(core: ModelCore, url: string, work: Work | null = null): Promise<boolean> {
  return openFrom(core, async (signal) => modelOf(await readUrl(url, signal)), { kind: 'url', url }, work);
}

/**
 * Opens the model that a link to the page names (`?model=`): at once where it lies beside the page or below it, as whoever
 * put the page there has put it; else it is offered, for the same reason as in openSaved().
 */
export async function openNamed(core: ModelCore, address: string): Promise<void> {
  const full = addressOf(address);
  const folder = new URL('.', location.href);
  const isOurs = full === null || (full.startsWith(folder.href) && new URL(full).search === '');
  if (isOurs) await openUrl(core, address);
  else offered.value = full;
}

/** Fetches the model that is offered. */
export async function fetchOffered(core: ModelCore): Promise<void> {
  const url = offered.peek();
  if (url !== null) await openUrl(core, url);
}

/** Fetches the model of the work that waits. */
export async function fetchAwaited(core: ModelCore): Promise<void> {
  const work = awaited.peek();
  const url = awaitedAddress.peek();
  if (work === null || url === null) return;
  if (await openUrl(core, url, work)) awaited.value = null;
}

/** Files that the browser kept. */
export function reopen(core: ModelCore, files: ModelFiles, source: ModelSource, work: Work): Promise<boolean> {
  return openFrom(core, async () => files, source, work);
}

/** Gives a part another label (null: the file's own): the shape is abstracted anew, and the work carried over to it. */
export const relabel = (core: ModelCore, keys: readonly string[], label: string | null): Promise<boolean> =>
  relabelAll(core, new Map(keys.map((key) => [key, label])), t`change label`);

/** The same for many parts in one step, by partKey(). */
export async function relabelAll(
  core: ModelCore,
  given: ReadonlyMap<string, string | null>,
  step: string,
): Promise<boolean> {
  const { model } = document.peek();
  if (model === null) return false;
  const labels = new Map(model.labels);
  for (const [key, label] of given)
    if (label === null) labels.delete(key);
    else labels.set(key, label);
  const shape = await run(t`Looking at the parts again`, (options) =>
    core.open(model.files, options, labels, model.corrections),
  );
  if (shape === null || document.peek().model !== model) return false;
  const next = carryOver(document.peek(), { ...model, shape, labels });
  replaceDocument(next, step);
  const lost = next.layers.filter(({ layer }) => misfit(shape, layer) !== null);
  if (lost.length > 0) {
    const them = plural(
      lost.length,
      'One edit no longer fits the parts and rests.',
      '{n} edits no longer fit the parts and rest.',
    );
    say(`${them} ${plural(given.size, 'Undo takes the label back.', 'Undo takes the labels back.')}`);
  }
  return true;
}

/**
 * Saved work from a link or a file: opens its model, or asks for it. An address that it names is not fetched: it would be
 * a stranger's request, with this machine's own services within reach.
 * @param files what was opened together with it: its model
 */
export async function openSaved(core: ModelCore, work: Work, files: FileSet | null = null): Promise<boolean> {
  const { saved } = work;
  const { gallery, sha256 } = saved.model;
  if (files !== null) return openFrom(core, () => modelOf(files), { kind: 'file' }, work);
  const { model } = document.peek();
  const isFound = saved.labels === undefined && saved.corrections === undefined;
  const isAsItWas = isFound && model !== null && isAsFound(model) && model.files.cad === undefined;
  if (model?.shape.sha256 === sha256 && isAsItWas) return show(model, work, null);
  if (model?.shape.sha256 === sha256) return reopen(core, model.files, model.source, work);
  if (gallery !== undefined) return openGallery(core, gallery, work);
  awaited.value = work;
  return false;
}
