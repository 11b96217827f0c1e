// The page's end of reading and writing other formats: a worker for one file, ended when it is done or cancelled.

import type { Converted } from '../formats/convert';
import type { Written, WrittenFormat } from '../formats/write';
import type { ModelFiles } from '../scene/load';
import { t } from '../texts/texts';
import type { ConvertRequest, WriteRequest } from '../worker/convert.worker';
import { askOnce } from '../worker/once';
import { FileError, type FoundFiles, fileLimits } from './files';
import type { RunOptions } from './tasks';

const newWorker = (name: string) =>
  new Worker(new URL('../worker/convert.worker.ts', import.meta.url), { type: 'module', name });

/**
 * The model as a GLB: itself when it is glTF. Rejects with a FileError when it cannot be read, with the signal's reason
 * when cancelled.
 */
export async function converted(files: FoundFiles, { signal, onProgress }: RunOptions): Promise<ModelFiles> {
  const { format } = files;
  if (format === undefined) return files; // the same object: that is what the core and the store know it by
  signal.throwIfAborted();
  onProgress({ step: t`reading ${format.kind.toUpperCase()}`, done: 0, total: 1 });
  const source = { path: format.path, main: files.main, external: files.external };
  const request: ConvertRequest = { source, format: format.kind, limit: fileLimits.bytes };
  const reply = await askOnce<Converted>(newWorker, request, {
    signal,
    unstarted: t`The reader did not start. Reload the page.`,
    ended: t`The browser ended the reader of ${format.kind.toUpperCase()}: it may want too much memory. Open a smaller model.`,
  });
  if ('error' in reply) throw new FileError(reply.error);
  const { glb, remarks } = reply;
  return {
    name: files.name,
    main: glb,
    external: new Map(),
    converted: { format: format.kind.toUpperCase(), remarks },
  };
}

/** A GLB as a file of another format. Rejects with a FileError that says what to do, with the signal's reason when cancelled. */
export async function writtenAs(
  to: WrittenFormat,
  glb: Uint8Array,
  name: string,
  { signal, onProgress }: RunOptions,
): Promise<Written> {
  const kind = to.toUpperCase();
  const request: WriteRequest = { glb, to, name, step: t`writing ${kind}` };
  const reply = await askOnce<Written>(newWorker, request, {
    signal,
    onProgress,
    unstarted: t`The writer did not start. Reload the page.`,
    ended: t`The browser ended the writer of ${kind}: it may want too much memory. Export a GLB instead.`,
  });
  if ('error' in reply) throw new FileError(reply.error);
  return reply;
}
