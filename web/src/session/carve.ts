// The page's end of changing by hand what is one part: a worker for one step, ended when it is done or cancelled.

import type { Carved, CarveStep } from '../carve/steps';
import type { ModelFiles } from '../scene/load';
import { t } from '../texts/texts';
import type { CarveRequest } from '../worker/carve.worker';
import { askOnce } from '../worker/once';
import { FileError } from './files';
import type { RunOptions } from './tasks';

export interface CarvedFiles extends Pick<Carved, 'lost' | 'moved' | 'made' | 'open'> {
  readonly files: ModelFiles;
}

const create = (name: string) =>
  new Worker(new URL('../worker/carve.worker.ts', import.meta.url), { type: 'module', name });

/** Does a step. */
export type Carver = (files: ModelFiles, step: CarveStep, options: RunOptions) => Promise<CarvedFiles>;

/** The files after a step, which they remember. Rejects with a FileError when it cannot be done, with the signal's reason. */
export const carved: Carver = async (files, step, { signal, onProgress }) => {
  signal.throwIfAborted();
  onProgress({ step: t`changing the parts`, done: 0, total: 1 });
  const request: CarveRequest = { files: { main: files.main, external: files.external }, step };
  const reply = await askOnce<Carved>(create, request, {
    signal,
    unstarted: t`The worker did not start. Reload the page.`,
    ended: t`The browser ended what changes the parts: it may want too much memory. Choose smaller parts.`,
  });
  if ('error' in reply) throw new FileError(reply.error);
  const { glb, ...rest } = reply;
  return { files: withStep(files, glb, step), ...rest };
};

/** Files of what came of a step. */
export function withStep(files: ModelFiles, main: Uint8Array, step: CarveStep): ModelFiles {
  const { carved: before, ...others } = files;
  return {
    ...others,
    main,
    external: new Map(),
    carved: { from: before?.from ?? files, steps: [...(before?.steps ?? []), step] },
  };
}

/** The files as saved work had them: with its steps done, unless they are already. */
export async function carvedAs(
  steps: readonly CarveStep[] | undefined,
  files: ModelFiles,
  carve: Carver,
  options: RunOptions,
): Promise<ModelFiles> {
  if (steps === undefined || files.carved !== undefined) return files;
  let made = files;
  for (const step of steps) made = (await carve(made, step, options)).files;
  return made;
}
