// What buttons, keys and drops have in common: opening files, exporting, sharing.

import { type ReadonlySignal, signal } from '@preact/signals';
import { writtenAs } from '../session/convert';
import { models } from '../session/core';
import { isCut } from '../session/cuts';
import { programOf } from '../session/document';
import { editedName, plainName } from '../session/download_names';
import { activeLayers } from '../session/evaluation';
import { absentParts } from '../session/family_state';
import { type FileSet, hasModel, sessionOf, unpacked } from '../session/files';
import type { Filling } from '../session/fill';
import { gapSentences, withoutLeft } from '../session/gaps';
import type { Exported, ExportOptions } from '../session/model_core';
import { oneFile, slidersOfWork } from '../session/one_file';
import { openFiles, openSaved } from '../session/open';
import { asItsFile } from '../session/placing';
import { document, family as families, run, say, selected } from '../session/session';
import type { RunOptions } from '../session/tasks';
import { fragmentOf } from '../share/link';
import { readSavedText, save } from '../share/saved';
import { m, t } from '../texts/texts';
import { stage } from './view';

export type DialogName = 'explore' | 'readings' | 'open' | 'share' | 'help' | 'text' | 'model' | 'print';
export const dialog = signal<DialogName | null>(null);
/** Key of the layer that the text dialog is about; null for text from elsewhere. */
const textKey = signal<number | null>(null);
export const textOf: ReadonlySignal<number | null> = textKey;

export function showText(key: number | null): void {
  textKey.value = key;
  dialog.value = 'text';
}

/** Opens what was dropped or picked: a model, or saved work. */
export async function openAny(reading: Promise<FileSet>): Promise<boolean> {
  const core = models.peek();
  if (core === null) {
    say(t`The core is still starting. Try again in a moment.`, 'error');
    return false;
  }
  const files = await run(t`Reading the files`, async () => unpacked(await reading));
  if (files === null || files.size === 0) return false;
  const session = sessionOf(files);
  if (session === null) return openFiles(core, files);
  const read = readSavedText(session);
  if (!read.ok) {
    say(read.text, 'error');
    return false;
  }
  return openSaved(core, read, hasModel(files) ? files : null);
}

export function download(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  const link = Object.assign(globalThis.document.createElement('a'), { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

export const modelName = () => document.peek().model?.shape.name ?? '';
const fileName = (suffix: string) => `${plainName(modelName())}${suffix}`;

const jsonBlob = (value: unknown) => new Blob([JSON.stringify(value, null, 1)], { type: 'application/json' });

export function saveSession(): void {
  download(fileName('.parsel.json'), jsonBlob(save(document.peek(), stage.peek()?.rig.pose)));
}

export function exportProgram(): void {
  const { model } = document.peek();
  if (model) download(fileName('.program.json'), jsonBlob(programOf(model.shape, activeLayers(document.peek()))));
}

/** What the page would be handed on with: the model, its sliders, and how it is seen. */
export async function exportOneFile(): Promise<void> {
  const core = models.peek();
  if (core === null || document.peek().model === null) return;
  const glb = await run(t`Writing the file`, () => oneFile(core, document.peek(), stage.peek()?.rig.pose));
  if (glb === null) return;
  download(`${editedName(modelName(), 'sliders')}.glb`, new Blob([glb as BlobPart], { type: 'model/gltf-binary' }));
  const { model } = document.peek();
  if (model !== null && isCut(model.files)) say(t(uncut));
}

/** The sliders alone, for a page that has the model. */
export async function exportSliders(): Promise<void> {
  const sliders = await run(t`Writing the file`, async () => slidersOfWork(document.peek(), stage.peek()?.rig.pose));
  if (sliders !== null) download(fileName('.sliders.json'), jsonBlob(sliders));
}

export async function exportScreenshot(): Promise<void> {
  const picture = await stage.peek()?.screenshot();
  if (picture) download(fileName('.png'), picture);
}

export type ExportKind = 'all' | 'selected' | 'animated';

/** The file of the model as it is edited and cut, or of some of its parts; null without a model. */
export async function editedFile(kind: ExportKind, repair: boolean, options: RunOptions): Promise<Exported | null> {
  const core = models.peek();
  const { model } = document.peek();
  if (core === null || model === null) return null;
  const program = programOf(model.shape, activeLayers(document.peek()));
  const absent = absentParts(document.peek());
  const present = model.shape.parts.flatMap(({ id, virtual }) => (virtual || absent.has(id) ? [] : [id]));
  const how: ExportOptions = {
    ...(absent.size > 0 ? { only: present } : {}),
    ...(kind === 'animated' ? { animate: program.layers.at(-1)?.parameter.name ?? '' } : {}),
    ...(kind === 'selected' ? { only: [...selected.peek()] } : {}),
    repair,
  };
  const exported = await core.apply(model, program, how);
  options.signal.throwIfAborted();
  if (kind === 'animated') {
    const { warnings } = exported;
    return { ...exported, warnings: isCut(model.files) ? [...warnings, t(uncut)] : warnings };
  }
  if (!isCut(model.files)) return exported;
  const { family } = document.peek();
  const setting = family === undefined ? null : families.settingNow(family);
  const { cutExport } = await import('../session/solid');
  return { ...exported, glb: await cutExport(exported.glb, document.peek(), setting, options) };
}

const uncut = m`What is cut changes with the slider: in this file its parts are whole.`;

interface ExportChoice {
  /** Turned and sized as it is shown; else as its file was. */
  readonly asItStands?: boolean;
  /** Whether gaps are closed, which is then said; those that parts cannot be made longer for are filled, if asked for. */
  readonly repair?: boolean | 'fill';
  /** Of which format the file is; else GLB. */
  readonly as?: 'obj' | 'stl';
}

export async function exportModel(
  kind: ExportKind,
  { asItStands = false, repair = false, as }: ExportChoice = {},
): Promise<void> {
  const { model, unit } = document.peek();
  const name = `${editedName(modelName())}${{ all: '', selected: '.part', animated: '.animated' }[kind]}`;
  const exported = await run(t`Writing the file`, async (options) => {
    const made = await editedFile(kind, repair !== false, options);
    if (made === null || model === null) return null;
    const filling = repair === 'fill' ? await filledFile(made.glb, options) : { glb: made.glb, said: '' };
    const glb = asItStands ? filling.glb : await asItsFile(model.files, filling.glb, options);
    const other = as === undefined ? null : await writtenAs(as, glb, name, options);
    return { ...made, said: filling.said, file: other ?? { extension: 'glb', bytes: glb, remarks: [] } };
  });
  if (exported === null || model === null) return;
  const { file } = exported;
  const type = file.extension === 'glb' ? 'model/gltf-binary' : '';
  download(`${name}.${file.extension}`, new Blob([file.bytes as BlobPart], { type }));
  const filled = exported.said;
  // Where surfaces were looked at themselves, what boxes say is not the last word.
  const closed = gapSentences(filled === '' ? exported : withoutLeft(exported), model.shape, unit);
  const said = [closed, filled, ...exported.warnings.slice(0, 3), ...file.remarks].filter(Boolean);
  if (said.length > 0) say(said.join(' '));
}

/** An edited file with the gaps filled that are left in it. */
async function filledFile(glb: Uint8Array, options: RunOptions): Promise<Filling> {
  const core = models.peek();
  const { model, unit } = document.peek();
  if (core === null || model === null) return { glb, said: '' };
  const rest = await core.apply(model, programOf(model.shape, []), {});
  options.signal.throwIfAborted();
  const { filledGaps } = await import('../session/fill'); // few want it: not among what is fetched first
  return filledGaps(rest.glb, glb, model.shape, programOf(model.shape, activeLayers(document.peek())), unit, options);
}

/** The address of this page with the work in its fragment. */
export async function shareLink(embed: boolean): Promise<string> {
  const url = new URL(location.href);
  url.search = embed ? '?embed' : '';
  url.hash = await fragmentOf(save(document.peek(), stage.peek()?.rig.pose));
  return url.href;
}
