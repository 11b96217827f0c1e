// What is kept of the work, with a store in memory and a clock that the test sets.
import { signal } from '@preact/signals';
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import { createAutosave } from '../../web/src/session/autosave';
import { type Document, emptyDocument, noLabels } from '../../web/src/session/document';
import type { StoredModel, TabRecord, WorkStore } from '../../web/src/session/work_store';

const hour = 60 * 60 * 1000;

const fileOf = (name: string) => ({ name, main: new Uint8Array([1]), external: new Map<string, Uint8Array>() });
const shapeOf = (name: string) =>
  ({ name, sha256: name.padEnd(64, '0').replace(/[^0-9a-f]/g, 'a'), parts: [], relations: [] }) as unknown as Shape;
const work = (name: string): Document => ({
  ...emptyDocument,
  model: { files: fileOf(name), source: { kind: 'file' }, shape: shapeOf(name), labels: noLabels },
});

class MemoryStore implements WorkStore {
  readonly tabs = new Map<string, TabRecord>();
  readonly models = new Map<string, StoredModel>();
  fault: Error | null = null;
  /** Rejects writes until something has been forgotten. */
  isFull = false;
  writes = 0;

  private refuse(): void {
    if (this.fault) throw this.fault;
  }
  private sorted() {
    return [...this.tabs].sort(([, a], [, b]) => b.at - a.at);
  }
  async tab(name: string) {
    this.refuse();
    return this.tabs.get(name);
  }
  async latest() {
    this.refuse();
    return this.sorted()[0]?.[1];
  }
  async model(key: string) {
    this.refuse();
    return this.models.get(key);
  }
  async write(name: string, record: TabRecord, model: { key: string; stored: StoredModel } | null) {
    this.refuse();
    this.writes++;
    if (this.isFull) throw new DOMException('', 'QuotaExceededError');
    this.tabs.set(name, record);
    if (model !== null) this.models.set(model.key, model.stored);
  }
  async forget(keeps: (name: string, record: TabRecord, age: number) => boolean) {
    for (const [age, [name, record]] of this.sorted().entries()) {
      if (keeps(name, record, age)) continue;
      this.tabs.delete(name);
      this.isFull = false;
    }
  }
}

let now = 0;
/** A tab of a browser whose store and open tabs the test holds. */
function tabOf(
  store: MemoryStore,
  name: string,
  { isNew = true, open = [name] }: { isNew?: boolean; open?: string[] } = {},
) {
  const document = signal<Document>(emptyDocument);
  let left: unknown;
  const autosave = createAutosave({
    document,
    store,
    tab: {
      mine: async () => ({ name, isNew }),
      open: async () => new Set(open),
      leaveBehind: (value) => {
        left = JSON.parse(JSON.stringify(value));
      },
      takeLeft: () => left,
    },
    now: () => now,
  });
  return { document, autosave };
}

async function saved(store: MemoryStore, name: string, at: number): Promise<void> {
  now = at;
  const { document, autosave } = tabOf(store, name, { open: [...store.tabs.keys(), name] });
  document.value = work(`model of ${name}`);
  expect(await autosave.saveNow()).toBe(true);
}

let store: MemoryStore;
beforeEach(() => {
  store = new MemoryStore();
  now = 1000 * hour;
  vi.stubGlobal('addEventListener', vi.fn());
  vi.stubGlobal('removeEventListener', vi.fn());
});
afterEach(() => {
  vi.unstubAllGlobals();
  vi.useRealTimers();
});

const modelOf = async (tab: ReturnType<typeof tabOf>) => (await tab.autosave.restore())?.files.name;

describe('the work of a tab', () => {
  it('comes back to it, and a new tab begins with what was saved last', async () => {
    await saved(store, 'tab a', now);
    await saved(store, 'tab b', now + 1);
    expect(await modelOf(tabOf(store, 'tab a', { isNew: false }))).toBe('model of tab a');
    expect(await modelOf(tabOf(store, 'tab b', { isNew: false }))).toBe('model of tab b');
    expect(await modelOf(tabOf(store, 'tab c'))).toBe('model of tab b');
  });

  it('is written at once when its model is new, and after a rest when it has changed', async () => {
    vi.useFakeTimers();
    const { document, autosave } = tabOf(store, 'tab a');
    const stop = autosave.start();
    document.value = work('chair');
    await vi.advanceTimersByTimeAsync(1);
    expect(store.writes).toBe(1);
    document.value = { ...document.value };
    await vi.advanceTimersByTimeAsync(300);
    expect(store.writes).toBe(1);
    await vi.advanceTimersByTimeAsync(101);
    expect(store.writes).toBe(2);
    stop();
  });

  it('outlives other tabs that are restored earlier, as browsers do one by one', async () => {
    const names = Array.from({ length: 7 }, (_, i) => `tab ${i}`);
    for (const [i, name] of names.entries()) await saved(store, name, now + i);
    // The first comes back alone, changes its model, and knows of no other.
    const first = tabOf(store, 'tab 0', { isNew: false, open: ['tab 0'] });
    expect(await modelOf(first)).toBe('model of tab 0');
    now += hour;
    first.document.value = work('another');
    await first.autosave.saveNow();
    for (const name of names.slice(1)) {
      expect(await modelOf(tabOf(store, name, { isNew: false, open: ['tab 0', name] }))).toBe(`model of ${name}`);
    }
  });

  it('is forgotten when its tab has been closed for long, or is one of very many', async () => {
    await saved(store, 'tab old', now);
    now += 31 * 24 * hour;
    for (let i = 0; i < 40; i++) await saved(store, `tab ${i}`, now + i);
    const last = tabOf(store, 'tab last', { open: ['tab last', 'tab 0'] });
    last.document.value = work('last');
    now += 50;
    await last.autosave.saveNow();
    await vi.waitFor(() => expect(store.tabs.size).toBeLessThan(30));
    expect(store.tabs.has('tab old')).toBe(false);
    expect(store.tabs.has('tab 0')).toBe(true); // it is open
    expect(store.tabs.has('tab 39')).toBe(true);
  });

  it('that is damaged in the store is what is whole of it', async () => {
    await saved(store, 'tab a', now);
    const record = store.tabs.get('tab a');
    store.tabs.set('tab a', { at: now, work: { ...(record?.work as object), hidden: [7] } });
    const restored = await tabOf(store, 'tab a', { isNew: false }).autosave.restore();
    expect(restored?.work.lost).toEqual(['what is hidden']);
  });
});

describe('where nothing can be kept', () => {
  it.each([
    ['a browser that refuses', new Error('denied'), 'refused'],
    ['a disk that is full', new DOMException('', 'QuotaExceededError'), 'full'],
  ] as const)('%s is told of at the first change, and again not once it works', async (_, fault, why) => {
    const { document, autosave } = tabOf(store, 'tab a');
    document.value = work('chair');
    expect(autosave.unkept.value).toBe(null);
    store.fault = fault;
    expect(await autosave.saveNow()).toBe(false);
    expect(autosave.unkept.value).toBe(why);
    store.fault = null;
    expect(await autosave.saveNow()).toBe(true);
    expect(autosave.unkept.value).toBe(null);
    expect(store.models.size).toBe(1); // the model as well, which the failed write left out
  });

  it('work of closed tabs makes room before anything is given up', async () => {
    const today = now;
    await saved(store, 'tab closed', today - 48 * hour);
    await saved(store, 'tab recent', today - 2 * hour);
    now = today;
    store.isFull = true;
    const { document, autosave } = tabOf(store, 'tab a');
    document.value = work('chair');
    expect(await autosave.saveNow()).toBe(true);
    expect([...store.tabs.keys()].sort()).toEqual(['tab a', 'tab recent']);
    expect(autosave.unkept.value).toBe(null);
  });

  it('nothing is restored, and nothing thrown', async () => {
    store.fault = new Error('denied');
    expect(await tabOf(store, 'tab a', { isNew: false }).autosave.restore()).toBe(null);
  });
});

describe('saving', () => {
  it('waits for a pause, writes once, and not without a model', async () => {
    vi.useFakeTimers();
    const { document, autosave } = tabOf(store, 'tab a');
    const stop = autosave.start();
    await vi.runAllTimersAsync();
    expect(store.writes).toBe(0);
    for (const name of ['a', 'b', 'c']) document.value = work(name);
    await vi.runAllTimersAsync();
    expect(store.writes).toBe(1);
    expect([...store.models.values()].map(({ files }) => files.name)).toEqual(['c']);
    stop();
    document.value = work('d');
    await vi.runAllTimersAsync();
    expect(store.writes).toBe(1);
  });
});
