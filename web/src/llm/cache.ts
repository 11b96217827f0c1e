// Replies that were paid for, by prompt, model and vote, so that what came is not asked again when something else failed.
import { clear, createStore, del, get, set, type UseStore } from 'idb-keyval';
import type { Reply } from './adapter';

export interface ReplyCache {
  get(key: string): Promise<Reply | undefined>;
  set(key: string, reply: Reply): Promise<void>;
  delete(key: string): Promise<void>;
}

let store: UseStore | null = null;
const opened = () => {
  store ??= createStore('parsel-replies', 'replies');
  return store;
};

/** In IndexedDB. Where the browser keeps nothing, everything is asked anew. */
export const browserCache: ReplyCache = {
  get: (key) => get<Reply>(key, opened()).catch(() => undefined),
  set: (key, reply) => set(key, reply, opened()).catch(() => {}),
  delete: (key) => del(key, opened()).catch(() => {}),
};

export const clearReplies = (): Promise<void> => clear(opened()).catch(() => {});
