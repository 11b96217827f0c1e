// The page's end of reading other formats: a worker for one file, ended when it is done or cancelled.
import type { ModelFiles } from '../scene/load';
import type { ConvertReply, ConvertRequest } from '../worker/convert.worker';
import type { Progress } from '../worker/protocol';
import { watched } from '../worker/watch';
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
  onProgress({ step: `reading ${format.kind.toUpperCase()}`, done: 0, total: 1 });
  const source = { path: format.path, main: files.main, external: files.external };
  const reply = await ask({ source, format: format.kind, limit: fileLimits.bytes }, signal);
  if ('error' in reply) throw new FileError(reply.error);
  const { glb, remarks } = reply;
  return {
    name: files.name,
    main: glb,
    external: new Map(),
    converted: { format: format.kind.toUpperCase(), remarks },
  };
}

async function ask(request: ConvertRequest, signal: AbortSignal): Promise<ConvertReply> {
  const worker = watched(
    (name) => new Worker(new URL('../worker/convert.worker.ts', import.meta.url), { type: 'module', name }),
  );
  const ended = `The browser ended the reader of ${request.format.toUpperCase()}: it may want too much memory. Open a smaller model.`;
  try {
    return await new Promise((resolve, reject) => {
      worker.onmessage = ({ data }: MessageEvent<ConvertReply>) => resolve(data);
      worker.onerror = ({ message }) => resolve({ error: message || 'The reader did not start. Reload the page.' });
      worker.ondeath = () => resolve({ error: ended });
      signal.addEventListener('abort', () => reject(signal.reason), { once: true });
      worker.postMessage(request);
    });
  } finally {
    worker.terminate();
  }
}
