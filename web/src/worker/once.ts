// One question to a worker that lives for it: ended when it is answered, cancelled, or gone.
import type { Progress } from './protocol';
import { watched } from './watch';

/** What a worker that answers one question may send. */
export type Answer<Reply> = Reply | { readonly error: string } | { readonly progress: Progress };

export interface AskOptions {
  readonly signal: AbortSignal;
  readonly onProgress?: (progress: Progress) => void;
  /** What is said when the worker does not start, and when the browser ends it. */
  readonly unstarted: string;
  readonly ended: string;
}

/** Rejects with the signal's reason when cancelled; all else that goes wrong is an answer. */
export async function askOnce<Reply extends object>(
  create: (name: string) => Worker,
  request: unknown,
  { signal, onProgress, unstarted, ended }: AskOptions,
): Promise<Reply | { readonly error: string }> {
  signal.throwIfAborted();
  const worker = watched(create);
  try {
    return await new Promise((resolve, reject) => {
      worker.onmessage = ({ data }: MessageEvent<Answer<Reply>>) => {
        if ('progress' in data) onProgress?.(data.progress);
        else resolve(data);
      };
      worker.onerror = ({ message }) => resolve({ error: message || unstarted });
      worker.ondeath = () => resolve({ error: ended });
      signal.addEventListener('abort', () => reject(signal.reason), { once: true });
      worker.postMessage(request);
    });
  } finally {
    worker.terminate();
  }
}
