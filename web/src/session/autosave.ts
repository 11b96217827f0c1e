// Keeps the work in IndexedDB, so that a reload or a crash loses nothing. The model's bytes are written when it changes,
// everything else a moment after each change.
import { effect } from '@preact/signals';
import { createStore, del, get, set, setMany, type UseStore } from 'idb-keyval';
import type { ModelFiles } from '../scene/load';
import { readSaved, type Saved, save } from '../share/saved';
import type { ModelSource } from './document';
import { document } from './session';

const delay = 400; // milliseconds

interface StoredModel {
  readonly files: ModelFiles;
  readonly source: ModelSource;
}

export interface Restored extends StoredModel {
  readonly saved: Saved;
}

let store: UseStore | null = null;
const opened = () => {
  store ??= createStore('parsel', 'work');
  return store;
};

/** Where a tab remembers the work that it put aside for its own reload: another tab may save in the meantime. */
const asideKey = 'parsel.reload';

interface Aside {
  readonly model: StoredModel;
  readonly work: unknown;
}

async function takeAside(): Promise<Aside | undefined> {
  const key = sessionStorage.getItem(asideKey);
  if (key === null) return undefined;
  sessionStorage.removeItem(asideKey);
  const aside = await get<Aside>(key, opened());
  await del(key, opened());
  return aside;
}

/** The work of the last visit; null when there is none, or the browser keeps nothing. */
export async function restore(): Promise<Restored | null> {
  try {
    const aside = await takeAside();
    const [model, work] =
      aside === undefined
        ? await Promise.all([get<StoredModel>('model', opened()), get('work', opened())])
        : [aside.model, aside.work];
    if (model === undefined) return null;
    const read = readSaved(work);
    return read.ok ? { ...model, saved: read.saved } : null;
  } catch {
    return null;
  }
}

let timer: ReturnType<typeof setTimeout> | undefined;
/** The model that is in the store, as far as this page knows. */
let written: ModelFiles | null = null;

/** Whether it worked: private windows refuse, and the next change tries again. */
async function write(): Promise<boolean> {
  clearTimeout(timer);
  timer = undefined;
  const current = document.peek();
  if (current.model === null) return true;
  const { files, source } = current.model;
  const entries: [string, unknown][] = [['work', save(current)]];
  if (files !== written) entries.push(['model', { files, source } satisfies StoredModel]);
  try {
    await setMany(entries, opened());
    written = files;
    return true;
  } catch {
    return false;
  }
}

/** Puts the work aside for this tab's reload; false when the reload would lose it. */
export async function saveNow(): Promise<boolean> {
  const current = document.peek();
  if (current.model === null) return true;
  const { files, source } = current.model;
  const key = `reload ${crypto.randomUUID()}`;
  try {
    await set(key, { model: { files, source }, work: save(current) } satisfies Aside, opened());
    sessionStorage.setItem(asideKey, key);
    return true;
  } catch {
    return false;
  }
}

/** Starts saving. Where the browser refuses, the page works on, without a net. */
export function startAutosave(): () => void {
  const flush = () => {
    if (timer !== undefined) void write();
  };
  addEventListener('pagehide', flush);
  const stop = effect(() => {
    if (document.value.model === null) return;
    clearTimeout(timer);
    timer = setTimeout(() => void write(), delay);
  });
  return () => {
    stop();
    removeEventListener('pagehide', flush);
    clearTimeout(timer);
  };
}
