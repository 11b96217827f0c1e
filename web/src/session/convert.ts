// The page's end of reading other formats: a worker for one file, ended when it is done or cancelled.

import type { Converted } from '../formats/convert';
import type { ModelFiles } from '../scene/load';
import { t } from '../texts/texts';
import type { ConvertRequest } from '../worker/convert.worker';
import { askOnce } from '../worker/once';
import type { Progress } from '../worker/protocol';
import { FileError, type FoundFiles, fileLimits } from './files';

/**
 * The model as a GLB: itself when it is glTF. Rejects with a FileError when it cannot be read, with the signal's reason
 * when cancelled.
 */
export async function converted(
  files: FoundFiles,
  { signal, onProgress }: { signal: AbortSignal; onProgress: (progress: Progress) => void },
): Promise<ModelFiles> {
  const { format } = files;
  if (format === undefined) return files; // the same object: that is what the core and the store know it by
  signal.throwIfAborted();
  onProgress({ step: t`reading ${format.kind.toUpperCase()}`, done: 0, total: 1 });
  const source = { path: format.path, main: files.main, external: files.external };
  const request: ConvertRequest = { source, format: format.kind, limit: fileLimits.bytes };
  const reply = await askOnce<Converted>(
    (name) => new Worker(new URL('../worker/convert.worker.ts', import.meta.url), { type: 'module', name }),
    request,
    {
      signal,
      unstarted: t`The reader did not start. Reload the page.`,
      ended: t`The browser ended the reader of ${format.kind.toUpperCase()}: it may want too much memory. Open a smaller model.`,
    },
  );
  if ('error' in reply) throw new FileError(reply.error);
  const { glb, remarks } = reply;
  return {
    name: files.name,
    main: glb,
    external: new Map(),
    converted: { format: format.kind.toUpperCase(), remarks },
  };
}
