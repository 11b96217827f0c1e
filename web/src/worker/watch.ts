// Workers that die without a word: a browser may end one that wants too much memory, and no event says so. A worker holds
// a lock as long as it lives, under its own name; when the page gets that lock, the worker is gone. Nothing is timed: a
// worker may be busy for as long as it likes.

interface Watched extends Worker {
  ondeath: (() => void) | null;
}

/** The first message of a watched worker. */
const isHeld = 'parsel: lock held';

/** Call first thing in a worker. */
export function holdWatchedLock(): void {
  // Without the lock, on a page that is no secure context, there is no watching.
  void navigator.locks?.request(self.name, () => {
    self.postMessage(isHeld);
    return new Promise<never>(() => {});
  });
}

let count = 0;

/** A worker that tells when it dies by other hands than this page's. @param create with this name */
export function watched(create: (name: string) => Worker): Watched {
  const name = `parsel worker ${Date.now().toString(36)} ${Math.random().toString(36).slice(2)} ${count++}`;
  const worker = create(name) as Watched;
  worker.ondeath = null;
  const ended = new AbortController();
  worker.addEventListener('message', (event) => {
    if (event.data !== isHeld) return;
    event.stopImmediatePropagation(); // no message for those who use the worker
    const dead = () => worker.ondeath?.();
    navigator.locks.request(name, { signal: ended.signal }, dead).catch(() => {}); // aborted: it was ended here
  });
  const terminate = worker.terminate.bind(worker);
  worker.terminate = () => {
    ended.abort();
    terminate();
  };
  return worker;
}
