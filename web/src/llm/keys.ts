// Keys, each for one host: a key is looked up by the origin that a request goes to, so that none can go elsewhere. In
// memory by default; for as long as the tab, or until it is forgotten, only when asked.
import { signal } from '@preact/signals';

export type Keeping = 'memory' | 'session' | 'remember';
const prefix = 'parsel-key:';

const inMemory = new Map<string, string>();
/** Counts changes: what shows a key's state reads this. */
export const keysChanged = signal(0);

const originOf = (base: string): string => (URL.canParse(base) ? new URL(base).origin : '');

/** Storage of the browser, or null where it is closed to pages. */
function storage(keeping: Keeping): Storage | null {
  try {
    return keeping === 'session' ? sessionStorage : keeping === 'remember' ? localStorage : null;
  } catch {
    return null;
  }
}

/** The key for this address and where it is kept; an empty one when there is none. */
export function keyFor(base: string): { key: string; keeping: Keeping } {
  keysChanged.value;
  const origin = originOf(base);
  for (const keeping of ['session', 'remember'] as const) {
    const key = storage(keeping)?.getItem(prefix + origin);
    if (key) return { key, keeping };
  }
  return { key: inMemory.get(origin) ?? '', keeping: 'memory' };
}

/** Keeps a key for this address, and nowhere else than said. An empty key is forgotten. */
export function keepKey(base: string, key: string, keeping: Keeping): void {
  const origin = originOf(base);
  inMemory.delete(origin);
  for (const other of ['session', 'remember'] as const) storage(other)?.removeItem(prefix + origin);
  // White space comes along when a key is pasted; other characters cannot be sent in a header.
  const clean = key.replace(/[^\x21-\x7e]/g, '');
  if (clean !== '' && origin !== '') {
    try {
      const kept = storage(keeping);
      if (kept === null) inMemory.set(origin, clean);
      else kept.setItem(prefix + origin, clean);
    } catch {
      inMemory.set(origin, clean); // the storage is full or closed
    }
  }
  keysChanged.value = keysChanged.peek() + 1;
}

export const forgetKey = (base: string): void => keepKey(base, '', 'memory');
