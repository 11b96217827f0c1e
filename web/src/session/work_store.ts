// Where the work is kept: a record for each tab, and the models that they name, in IndexedDB.
import { createStore, get, promisifyRequest, setMany, type UseStore } from 'idb-keyval';
import type { ModelFiles } from '../scene/load';
import { readSaved, type Saved } from '../share/saved';
import type { ModelSource } from './document';
import { tabPrefix } from './tab_name';

export interface StoredModel {
  readonly files: ModelFiles;
  readonly source: ModelSource;
}

/** What a tab was at. */
export interface TabRecord {
  /** Milliseconds since 1970 when it was saved. */
  readonly at: number;
  /** Saved, as it was written: untrusted when it is read. */
  readonly work: unknown;
}

/** Every function rejects when the browser refuses, as private windows do, or has no room left. */
export interface WorkStore {
  tab(name: string): Promise<TabRecord | undefined>;
  /** The record that was written last, of whatever tab. */
  latest(): Promise<TabRecord | undefined>;
  model(key: string): Promise<StoredModel | undefined>;
  /** Writes all or nothing. */
  write(
    name: string,
    record: TabRecord,
    model: { readonly key: string; readonly stored: StoredModel } | null,
  ): Promise<void>;
  /**
   * Forgets tabs, and the models that only they name. In one step: other tabs write meanwhile.
   * @param keeps whether a tab stays; the `age`-th of those that were written last, from 0
   */
  forget(keeps: (name: string, record: TabRecord, age: number) => boolean): Promise<void>;
}

/** By name as well: the same file may be open under two. */
export const modelKey = ({ sha256, name }: Saved['model']): string => `model ${sha256} ${name}`;

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

export function browserStore(): WorkStore {
  let store: UseStore | null = null;
  const opened = () => {
    store ??= createStore('parsel', 'work');
    return store;
  };
  return {
    tab: (name) => get<TabRecord>(name, opened()),
    latest: async () => (await opened()('readonly', recordsIn))[0]?.[1],
    model: (key) => get<StoredModel>(key, opened()),
    write: (name, record, model) =>
      setMany([[name, record], ...(model === null ? [] : [[model.key, model.stored] as [string, unknown]])], opened()),
    async forget(keeps) {
      await opened()('readwrite', async (objects) => {
        const records = await recordsIn(objects);
        const kept = records.filter(([name, record], age) => keeps(name, record, age));
        const wanted = new Set(kept.map(([name]) => name));
        for (const [, { work }] of kept) {
          const read = readSaved(work);
          if (read.ok) wanted.add(modelKey(read.saved.model));
        }
        for (const key of await promisifyRequest(objects.getAllKeys() as IDBRequest<string[]>)) {
          if (!wanted.has(key)) objects.delete(key);
        }
      });
    },
  };
}
