// The page's end of uniting parts for printers: a worker for one question, ended when it is answered or cancelled.

import type { Shape } from '../program/types';
import type { CadSource, ModelFiles } from '../scene/load';
import type { CadProgram } from '../solid/cad';
import type { State } from '../solid/cut';
import type { Solid } from '../solid/types';
import type { United } from '../solid/unite';
import { t } from '../texts/texts';
import { askOnce } from '../worker/once';
import type { CadFile, Cut, PrintFormat, SolidRequest, Written } from '../worker/solid.worker';
import type { CadPicture } from './cad_pictures';
import { cutState, isCut } from './cuts';
import type { Document } from './document';
import { type Setting, shapeIds } from './family_state';
import { FileError } from './files';
import type { RunOptions } from './tasks';

const create = (name: string) =>
  new Worker(new URL('../worker/solid.worker.ts', import.meta.url), { type: 'module', name });

async function ask<Reply extends object>(request: SolidRequest, options: RunOptions): Promise<Reply> {
  const reply = await askOnce<Reply>(create, request, {
    ...options,
    unstarted: t`What unites the parts did not start. Reload the page, with a network the first time.`,
    ended: t`The browser ended what unites the parts: they may have too many triangles. Export fewer of them.`,
  });
  if ('error' in reply) throw new FileError(t`The parts could not be united: ${reply.error}`);
  return reply as Reply;
}

/**
 * The solid of everything in an exported file of a model.
 * @param shape of the model, which names its parts
 * @param leaveOut whether parts that bound no solid are left out; else nothing is made of the others either
 */
export function unitedParts(glb: Uint8Array, shape: Shape, leaveOut: boolean, options: RunOptions): Promise<United> {
  const names = new Map(shape.parts.map(({ node, primitive, name }) => [`${node}/${primitive}`, name]));
  return ask({ kind: 'unite', glb, names, leaveOut }, options);
}

/** An exported file of a document's CAD program, with its parts cut; as it is where nothing is to be cut. */
export async function cutExport(
  glb: Uint8Array,
  document: Document,
  setting: Setting | null,
  options: RunOptions,
): Promise<Uint8Array> {
  const { model } = document;
  const cad = model?.files.cad;
  if (model === null || cad === undefined || !isCut(model.files)) return glb;
  const byId = new Map(model.shape.parts.map(({ id, node }) => [id, node]));
  const nodes = new Map([...shapeIds(cad, model.shape)].map(([id, own]) => [id, byId.get(own) ?? -1]));
  const [bytes] = await cutFiles(cad, [{ glb, nodes, state: cutState(document, setting) }], options);
  return bytes ?? glb;
}

async function cutFiles(cad: CadSource, files: readonly CadFile[], options: RunOptions): Promise<Cut['files']> {
  return (await ask<Cut>({ kind: 'cut', program: cad.program as CadProgram, files }, options)).files;
}

/** Models of a program with their parts cut; as they are where nothing is to be cut. */
export async function cutPictures(
  files: ModelFiles,
  pictures: readonly CadPicture[],
  options: RunOptions,
): Promise<readonly Uint8Array[]> {
  const { cad } = files;
  if (cad === undefined || !isCut(files)) return pictures.map(({ glb }) => glb);
  const nodesOf = ({ absent }: State) => {
    const there = cad.parts.filter(({ id, role }) => role === 'add' && !absent.has(id));
    return new Map(there.map(({ id }, node) => [id, node]));
  };
  const whole = pictures.map(({ glb, state }) => ({ glb, nodes: nodesOf(state), state }));
  return cutFiles(cad, whole, options);
}

/** A solid as a file. @param scale of the millimetres */
export async function writtenSolid(
  solid: Solid,
  { format, scale, name }: { format: PrintFormat; scale: number; name: string },
  options: RunOptions,
): Promise<Uint8Array<ArrayBuffer>> {
  return (await ask<Written>({ kind: 'write', solid, format, scale, name }, options)).bytes;
}
