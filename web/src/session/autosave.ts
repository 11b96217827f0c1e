// Keeps the work of every tab, so that a reload or a crash loses nothing, and tabs do not write over each other. A new tab
// begins with the work that was saved last. Where the browser refuses, the page works on and says so.
import { effect, type ReadonlySignal, signal } from '@preact/signals';
import type { ModelFiles } from '../scene/load';
import { readSaved, save, type Work } from '../share/saved';
import type { Document } from './document';
import { document } from './session';
import { leaveBehind, openTabs, type Tab, takeLeft, thisTab } from './tab_name';
import { browserStore, modelKey, type StoredModel, type TabRecord, type WorkStore } from './work_store';

/** Milliseconds of rest after a change before it is written. A new model, which nothing else remembers, waits for none. */
const delay = 400;
const day = 24 * 60 * 60 * 1000; // milliseconds
/**
 * Closed tabs that are kept, and for how long. Fewer or shorter, and tabs that a browser restores late, one by one as they
 * are looked at, find their work gone; more, and models fill the disk that nobody comes back to.
 */
const mostRecords = 24;
const keptFor = 30 * day;
/** Where the disk is full, only of the last day. */
const keptWhenFull = day;

export interface Restored extends StoredModel {
  readonly work: Work;
}

export interface AutosaveParts {
  readonly document: ReadonlySignal<Document>;
  readonly store: WorkStore;
  readonly tab: {
    mine(): Promise<Tab>;
    open(): Promise<ReadonlySet<string>>;
    leaveBehind(value: unknown): void;
    takeLeft(): unknown;
  };
  /** Milliseconds since 1970. */
  readonly now: () => number;
}

/** Why work is not kept: the disk is full, or the browser refuses, as some private windows do. */
export type Unkept = 'full' | 'refused';

export interface Autosave {
  /** Null while the work is kept. */
  readonly unkept: ReadonlySignal<Unkept | null>;
  /** The work of this tab before it was reloaded, or else what was saved last; null when nothing was kept. */
  restore(): Promise<Restored | null>;
  /** Writes the work now, and its model unless it is there. False when it is not kept. */
  saveNow(): Promise<boolean>;
  /** Starts saving; answers how to stop. */
  start(): () => void;
}

export function createAutosave({ document, store, tab, now }: AutosaveParts): Autosave {
  const unkept = signal<Unkept | null>(null);
  let timer: ReturnType<typeof setTimeout> | undefined;
  let isSaving = false;
  /** The model that is in the store, as far as this page knows. */
  let written: ModelFiles | null = null;

  async function readRecord(record: TabRecord | undefined): Promise<Restored | null> {
    if (record === undefined) return null;
    const read = readSaved(record.work);
    if (!read.ok) return null;
    const model = await store.model(modelKey(read.saved.model));
    return model === undefined ? null : { ...model, work: read };
  }

  async function restore(): Promise<Restored | null> {
    try {
      const { name, isNew } = await tab.mine();
      if (isNew) return await readRecord(await store.latest());
      const stored = await store.tab(name);
      const left = tab.takeLeft() as TabRecord | undefined;
      const isLater = left !== undefined && left.at > (stored?.at ?? 0);
      return (isLater ? await readRecord(left) : null) ?? (await readRecord(stored));
    } catch {
      return null; // saving will find out as well, and say so
    }
  }

  async function write({ files, source }: StoredModel, record: TabRecord & { work: Work['saved'] }): Promise<void> {
    const { name } = await tab.mine();
    const model = files === written ? null : { key: modelKey(record.work.model), stored: { files, source } };
    try {
      await store.write(name, record, model);
    } catch (error) {
      if (!isFull(error)) throw error;
      await forget(keptWhenFull);
      await store.write(name, record, model);
    }
    if (model !== null) void forget(keptFor).catch(() => {});
    written = files;
  }

  async function forget(within: number): Promise<void> {
    const open = await tab.open();
    const since = now() - within;
    await store.forget((name, { at }, age) => open.has(name) || (age < mostRecords && at >= since));
  }

  async function saveNow(): Promise<boolean> {
    clearTimeout(timer);
    timer = undefined;
    const current = document.peek();
    if (current.model === null) return true;
    isSaving = true;
    try {
      await write(current.model, { at: now(), work: save(current) });
      unkept.value = null;
      return true;
    } catch (error) {
      unkept.value = isFull(error) ? 'full' : 'refused';
      return false;
    } finally {
      isSaving = false;
    }
  }

  /** A page that is left has no time for the store: what is not there yet is put where this tab's next page looks. */
  function leave(): void {
    if (timer === undefined && !isSaving) return;
    const current = document.peek();
    if (current.model === null) return;
    try {
      tab.leaveBehind({ at: now(), work: save(current) } satisfies TabRecord);
    } catch {
      // Too large: the store may still make it.
    }
    void saveNow();
  }

  /** Browsers then ask whether to leave. */
  function warn(event: BeforeUnloadEvent): void {
    if (unkept.peek() !== null) event.preventDefault();
  }

  function start(): () => void {
    addEventListener('pagehide', leave);
    addEventListener('beforeunload', warn);
    const stop = effect(() => {
      const { model } = document.value;
      if (model === null) return;
      clearTimeout(timer);
      timer = setTimeout(() => void saveNow(), model.files === written ? delay : 0);
    });
    return () => {
      stop();
      removeEventListener('pagehide', leave);
      removeEventListener('beforeunload', warn);
      clearTimeout(timer);
    };
  }

  return { unkept, restore, saveNow, start };
}

const isFull = (error: unknown): boolean => error instanceof DOMException && error.name === 'QuotaExceededError';

/** The page's own. */
export const autosave: Autosave = createAutosave({
  document,
  store: browserStore(),
  tab: { mine: thisTab, open: openTabs, leaveBehind, takeLeft },
  now: Date.now,
});
