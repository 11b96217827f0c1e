// What is fetched when somebody first asks for it, and then stays.
import type { Progress } from './protocol';

export interface FetchOptions {
  readonly signal?: AbortSignal;
  readonly onProgress?: (progress: Progress) => void;
}

/**
 * Loads once for all who ask. Whoever aborts no longer waits, and when nobody does, the loading ends; after that, or a failure,
 * the next one to ask begins anew.
 */
export function onDemand<T>(load: (options: Required<FetchOptions>) => Promise<T>) {
  let loading: { readonly promise: Promise<T>; readonly waiting: Set<FetchOptions>; abort(): void } | undefined;

  function begin() {
    const controller = new AbortController();
    const waiting = new Set<FetchOptions>();
    const onProgress = (progress: Progress) => {
      for (const one of waiting) one.onProgress?.(progress);
    };
    const begun = {
      promise: load({ signal: controller.signal, onProgress }),
      waiting,
      abort: () => controller.abort(),
    };
    begun.promise.catch(() => {
      if (loading === begun) loading = undefined;
    });
    return begun;
  }

  return async (options: FetchOptions = {}): Promise<T> => {
    const { signal } = options;
    signal?.throwIfAborted();
    loading ??= begin();
    const asked = loading;
    const own = { ...options };
    asked.waiting.add(own);
    let stopListening = () => {};
    const aborted = new Promise<never>((_, reject) => {
      const giveUp = () => {
        asked.waiting.delete(own);
        if (asked.waiting.size === 0) {
          if (loading === asked) loading = undefined;
          asked.abort();
        }
        reject(signal?.reason);
      };
      signal?.addEventListener('abort', giveUp, { once: true });
      stopListening = () => signal?.removeEventListener('abort', giveUp);
    });
    try {
      return await Promise.race([asked.promise, aborted]);
    } finally {
      stopListening();
      asked.waiting.delete(own);
    }
  };
}
