// Keeps the work of every tab in IndexedDB, so that a reload or a crash loses nothing, and tabs do not write over each
// other: a record for each tab, and the models that they name. A new tab begins with the work that was saved last.
import { effect } from '@preact/signals';
import { createStore, get, promisifyRequest, setMany, type UseStore } from 'idb-keyval';
import type { ModelFiles } from '../scene/load';
import { readSaved, type Saved, save } from '../share/saved';
import type { ModelSource } from './document';
import { document } from './session';

const delay = 400; // milliseconds
/** Records of closed tabs that are kept. */
const mostRecords = 4;

interface StoredModel {
  readonly files: ModelFiles;
  readonly source: ModelSource;
}

export interface Restored extends StoredModel {
  readonly saved: Saved;
}

/** What a tab was at. */
interface TabRecord {
  /** Date.now() when it was saved. */
  readonly at: number;
  readonly work: unknown;
}

let store: UseStore | null = null;
const opened = () => {
  store ??= createStore('parsel', 'work');
  return store;
};

const tabPrefix = 'tab ';
/** By name as well: the same file may be open under two. */
const modelKey = ({ sha256, name }: Saved['model']) => `model ${sha256} ${name}`;

// ------------------------------------------------------------------------------------------------------- this tab

/** In sessionStorage, which lives as long as the tab: its name, and what pagehide had no time to store. */
const nameKey = 'parsel.tab';
const unsavedKey = 'parsel.unsaved';

/** Milliseconds for the page before a reload to let its lock go. */
const lockPatience = 400;

/** Whether no living tab has this name; from then on this one has. A duplicated tab comes with the name of the other. */
async function claim(name: string): Promise<boolean> {
  if (!('locks' in navigator)) return true;
  return new Promise((resolve) => {
    const options = { signal: AbortSignal.timeout(lockPatience) };
    const held = () => {
      resolve(true);
      return new Promise<never>(() => {}); // until the tab closes
    };
    navigator.locks.request(`parsel ${name}`, options, held).catch(() => resolve(false));
  });
}

let tab: Promise<{ readonly name: string; readonly isNew: boolean }> | null = null;

function thisTab() {
  tab ??= (async () => {
    const before = sessionStorage.getItem(nameKey);
    if (before !== null && (await claim(before))) return { name: before, isNew: false };
    const name = `${tabPrefix}${Date.now().toString(36)} ${Math.random().toString(36).slice(2)}`;
    await claim(name);
    sessionStorage.setItem(nameKey, name);
    sessionStorage.removeItem(unsavedKey);
    return { name, isNew: true };
  })();
  return tab;
}

// -------------------------------------------------------------------------------------------------------- reading

function unsavedRecord(): TabRecord | undefined {
  const text = sessionStorage.getItem(unsavedKey);
  sessionStorage.removeItem(unsavedKey);
  return text === null ? undefined : JSON.parse(text);
}

async function readRecord(record: TabRecord | undefined): Promise<Restored | null> {
  if (record === undefined) return null;
  const read = readSaved(record.work);
  if (!read.ok) return null;
  const model = await get<StoredModel>(modelKey(read.saved.model), opened());
  return model === undefined ? null : { ...model, saved: read.saved };
}

/** Names and records of all tabs, the latest first. */
async function recordsIn(objects: IDBObjectStore): Promise<[string, TabRecord][]> {
  const tabs = IDBKeyRange.bound(tabPrefix, `${tabPrefix}\uffff`); // models are large, and stay where they are
  const [names, records] = await Promise.all([
    promisifyRequest(objects.getAllKeys(tabs) as IDBRequest<string[]>),
    promisifyRequest(objects.getAll(tabs) as IDBRequest<TabRecord[]>),
  ]);
  return names
    .flatMap((name, i): [string, TabRecord][] => (records[i] === undefined ? [] : [[name, records[i]]]))
    .sort(([, a], [, b]) => b.at - a.at);
}

/** The work of this tab before it was reloaded, or else what was saved last; null when the browser kept nothing. */
export async function restore(): Promise<Restored | null> {
  try {
    const { name, isNew } = await thisTab();
    if (isNew) return await readRecord((await opened()('readonly', recordsIn))[0]?.[1]);
    const stored = await get<TabRecord>(name, opened());
    const unsaved = unsavedRecord();
    const isLater = unsaved !== undefined && unsaved.at > (stored?.at ?? 0);
    return (isLater ? await readRecord(unsaved) : null) ?? (await readRecord(stored));
  } catch {
    return null;
  }
}

// -------------------------------------------------------------------------------------------------------- writing

let timer: ReturnType<typeof setTimeout> | undefined;
/** The model that is in the store, as far as this page knows. */
let written: ModelFiles | null = null;

/** Writes the work now, and its model unless it is there. False when the browser refuses, as private windows do. */
export async function saveNow(): Promise<boolean> {
  clearTimeout(timer);
  timer = undefined;
  const current = document.peek();
  if (current.model === null) return true;
  const { files, source } = current.model;
  const work = save(current);
  const record: TabRecord = { at: Date.now(), work };
  try {
    const { name } = await thisTab();
    const changes: [string, unknown][] = [[name, record]];
    if (files !== written) changes.push([modelKey(work.model), { files, source } satisfies StoredModel]);
    await setMany(changes, opened());
    if (files !== written) void tidy().catch(() => {});
    written = files;
    return true;
  } catch {
    return false;
  }
}

/** Forgets tabs that are long closed, and models that no tab is at. One transaction: other tabs write meanwhile. */
async function tidy(): Promise<void> {
  const held = 'locks' in navigator ? ((await navigator.locks.query()).held ?? []).map((lock) => lock.name) : [];
  await opened()('readwrite', async (objects) => {
    const records = await recordsIn(objects);
    const kept = records.filter(([name], i) => i < mostRecords || held.includes(`parsel ${name}`));
    const wanted = new Set(kept.map(([name]) => name));
    for (const [, { work }] of kept) {
      const read = readSaved(work);
      if (read.ok) wanted.add(modelKey(read.saved.model));
    }
    for (const key of await promisifyRequest(objects.getAllKeys() as IDBRequest<string[]>)) {
      if (!wanted.has(key)) objects.delete(key);
    }
  });
}

/** A page that is left has no time for IndexedDB: what it had not saved yet is put where this tab's next page looks. */
function leave(): void {
  if (timer === undefined) return;
  const current = document.peek();
  if (current.model === null) return;
  try {
    sessionStorage.setItem(unsavedKey, JSON.stringify({ at: Date.now(), work: save(current) } satisfies TabRecord));
  } catch {
    // Too large: IndexedDB may still make it.
  }
  void saveNow();
}

/** Starts saving. Where the browser refuses, the page works on, without a net. */
export function startAutosave(): () => void {
  addEventListener('pagehide', leave);
  const stop = effect(() => {
    if (document.value.model === null) return;
    clearTimeout(timer);
    timer = setTimeout(() => void saveNow(), delay);
  });
  return () => {
    stop();
    removeEventListener('pagehide', leave);
    clearTimeout(timer);
  };
}
