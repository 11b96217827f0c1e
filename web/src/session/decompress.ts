// The page's end of decompression: a worker for one file, ended when it is done or cancelled.

import type { ModelFiles } from '../scene/load';
import { t } from '../texts/texts';
import type { Decompressed } from '../worker/decompress';
import { askOnce } from '../worker/once';
import type { Progress } from '../worker/protocol';
import { FileError, fileLimits, gltfJson } from './files';

/** What a file is compressed with, by the names that people know. */
const compressions: ReadonlyMap<unknown, string> = new Map([
  ['KHR_draco_mesh_compression', 'Draco'],
  ['EXT_meshopt_compression', 'Meshopt'],
  ['KHR_meshopt_compression', 'Meshopt'],
]);

/**
 * The model as the core and the scene read it: itself when it is not compressed. Rejects with a FileError when it cannot
 * be read, with the signal's reason when cancelled.
 */
export async function decompressed(
  files: ModelFiles,
  { signal, onProgress }: { signal: AbortSignal; onProgress: (progress: Progress) => void },
): Promise<ModelFiles> {
  const used = gltfJson(files.main)?.['extensionsUsed'];
  const compression = (Array.isArray(used) ? used : []).map((name) => compressions.get(name)).find(Boolean);
  if (compression === undefined) return files;
  signal.throwIfAborted();
  onProgress({ step: t`decompressing ${compression}`, done: 0, total: 1 });
  const reply = await askOnce<Decompressed>(
    (name) => new Worker(new URL('../worker/decompress.worker.ts', import.meta.url), { type: 'module', name }),
    files,
    {
      signal,
      unstarted: t`the decoder did not start`,
      ended: t`the browser ended the decoder: it may want too much memory`,
    },
  );
  if ('error' in reply) {
    throw new FileError(
      t`${files.name}: its ${compression} data cannot be read (${reply.error}). Export it again, without compression if need be.`,
    );
  }
  if (reply.glb.length > fileLimits.bytes) {
    throw new FileError(t`${files.name} is more than 512 MB when it is decompressed. Open a smaller model.`);
  }
  return { name: files.name, main: reply.glb, external: new Map(), decompressed: { compression, lost: reply.lost } };
}
