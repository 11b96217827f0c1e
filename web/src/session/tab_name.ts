// Which tab this is: a name that lives as long as the tab, reloads and restarts of the browser included. A duplicated tab
// comes with the name of the other and must take a new one, while a reloaded tab must not, however slowly the page before
// it goes. So whoever wants a name asks for it: a page that lives answers, one that is leaving lets its lock go.

export interface Tab {
  readonly name: string;
  /** It has no work of its own yet. */
  readonly isNew: boolean;
}

export const tabPrefix = 'tab ';
/** In sessionStorage, which lives as long as the tab and is copied when it is duplicated. */
const nameKey = 'parsel.tab';
const unsavedKey = 'parsel.unsaved';

const lockPrefix = 'parsel ';
const channelName = 'parsel tabs';
interface Message {
  readonly ask?: string;
  readonly alive?: string;
}

/**
 * Milliseconds after which a page that neither answers nor lets its lock go counts as frozen, and loses its name. Less, and
 * a page that is merely slow loses it; more, and a reload waits that long for one that hangs.
 */
const silence = 5000;

let isLeaving = false;
let answering: BroadcastChannel | null = null;

/** Answers those who ask for the name of this page. */
function answerFor(name: string): void {
  answering?.close();
  answering = new BroadcastChannel(channelName);
  answering.onmessage = ({ data }: MessageEvent<Message>) => {
    if (data.ask === name && !isLeaving) answering?.postMessage({ alive: name } satisfies Message);
  };
  answering.postMessage({ alive: name } satisfies Message); // to those who asked before it was held
}

/** Whether no living page has this name; from then on this one has, until it closes or `onLost`. */
function claim(name: string, onLost: () => void): Promise<boolean> {
  if (!('locks' in navigator)) return Promise.resolve(true);
  return new Promise((resolve) => {
    const giveUp = new AbortController();
    const others = new BroadcastChannel(channelName);
    let isHeld = false;
    const settle = (isOurs: boolean) => {
      clearTimeout(timer);
      others.close();
      resolve(isOurs);
    };
    const hold = () => {
      isHeld = true;
      answerFor(name);
      settle(true);
      return new Promise<never>(() => {}); // until the page closes, or another takes it
    };
    const request = (options: LockOptions) =>
      navigator.locks.request(lockPrefix + name, options, hold).catch(() => {
        if (isHeld) onLost();
      });
    others.onmessage = ({ data }: MessageEvent<Message>) => {
      if (data.alive !== name || isHeld) return;
      giveUp.abort();
      settle(false);
    };
    const timer = setTimeout(() => {
      giveUp.abort();
      void request({ steal: true });
    }, silence);
    void request({ signal: giveUp.signal });
    others.postMessage({ ask: name } satisfies Message);
  });
}

let tab: Promise<Tab> | null = null;

/** Rejects where the browser closes its storage to pages. */
export function thisTab(): Promise<Tab> {
  tab ??= (async () => {
    const onLost = () => {
      tab = null;
    };
    addEventListener('pagehide', () => {
      isLeaving = true;
    });
    addEventListener('pageshow', () => {
      isLeaving = false;
    });
    const before = sessionStorage.getItem(nameKey);
    if (before !== null && (await claim(before, onLost))) return { name: before, isNew: false };
    const name = `${tabPrefix}${Date.now().toString(36)} ${Math.random().toString(36).slice(2)}`;
    await claim(name, onLost);
    sessionStorage.setItem(nameKey, name);
    sessionStorage.removeItem(unsavedKey);
    return { name, isNew: true };
  })();
  return tab;
}

/** Names of the tabs that are open. Tabs that the browser restores late are not among them yet. */
export async function openTabs(): Promise<ReadonlySet<string>> {
  if (!('locks' in navigator)) return new Set();
  const { held = [] } = await navigator.locks.query();
  return new Set(held.flatMap(({ name }) => (name?.startsWith(lockPrefix) ? [name.slice(lockPrefix.length)] : [])));
}

/** What a page that is left had no time to store elsewhere: for the next page of this tab. Throws when it is too large. */
export function leaveBehind(value: unknown): void {
  sessionStorage.setItem(unsavedKey, JSON.stringify(value));
}

/** What the page before left behind, once; undefined when there is nothing. */
export function takeLeft(): unknown {
  const text = sessionStorage.getItem(unsavedKey);
  sessionStorage.removeItem(unsavedKey);
  return text === null ? undefined : JSON.parse(text);
}
