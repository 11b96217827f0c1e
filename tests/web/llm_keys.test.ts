// Where a key is, and where it is not.
import { afterEach, beforeEach, describe, expect, it, vi } from 'vitest';

function fakeStorage(): Storage {
  const map = new Map<string, string>();
  return {
    getItem: (key: string) => map.get(key) ?? null,
    setItem: (key: string, value: string) => void map.set(key, value),
    removeItem: (key: string) => void map.delete(key),
    clear: () => map.clear(),
    key: (i: number) => [...map.keys()][i] ?? null,
    get length() {
      return map.size;
    },
  };
}

let keys: typeof import('../../web/src/llm/keys');
const everything = (storage: Storage) =>
  Array.from({ length: storage.length }, (_, i) => storage.getItem(storage.key(i) ?? '')).join();
beforeEach(async () => {
  vi.stubGlobal('localStorage', fakeStorage());
  vi.stubGlobal('sessionStorage', fakeStorage());
  vi.resetModules(); // as a reload does
  keys = await import('../../web/src/llm/keys');
});
afterEach(() => vi.unstubAllGlobals());

const base = 'https://api.openai.com/v1';

describe('a key', () => {
  it('is in memory only, until it is asked to be kept', () => {
    keys.keepKey(base, ' sk-1\n', 'memory');
    expect(keys.keyFor(base)).toEqual({ key: 'sk-1', keeping: 'memory' });
    expect(everything(localStorage) + everything(sessionStorage)).toBe('');
  });

  it.each(['session', 'remember'] as const)('moves when asked: %s', async (keeping) => {
    keys.keepKey(base, 'sk-1', 'memory');
    keys.keepKey(base, 'sk-1', keeping);
    expect(everything(keeping === 'session' ? sessionStorage : localStorage)).toBe('sk-1');
    expect(everything(keeping === 'session' ? localStorage : sessionStorage)).toBe('');
    vi.resetModules();
    const later = await import('../../web/src/llm/keys');
    expect(later.keyFor(base)).toEqual({ key: 'sk-1', keeping });
    later.forgetKey(base);
    expect(later.keyFor(base).key).toBe('');
    expect(everything(localStorage) + everything(sessionStorage)).toBe('');
  });

  it('belongs to its host', () => {
    keys.keepKey(base, 'sk-1', 'memory');
    expect(keys.keyFor('https://api.openai.com/v2').key).toBe('sk-1');
    expect(keys.keyFor('https://openrouter.ai/api/v1').key).toBe('');
    expect(keys.keyFor('http://localhost:1234').key).toBe('');
    expect(keys.keyFor('no address').key).toBe('');
  });

  it('stays in memory when the storage refuses', () => {
    vi.stubGlobal('localStorage', {
      ...fakeStorage(),
      setItem() {
        throw new Error('full');
      },
    });
    keys.keepKey(base, 'sk-1', 'remember');
    expect(keys.keyFor(base)).toEqual({ key: 'sk-1', keeping: 'memory' });
  });
});

describe('the settings', () => {
  it('ask once where a model on this machine answers, as often as was measured elsewhere, or as often as was chosen', async () => {
    const { settings, choose, votesFor, measuredVotes } = await import('../../web/src/llm/settings');
    choose('openai', {});
    expect((['request', 'names', 'kinds'] as const).map(votesFor)).toEqual(Object.values(measuredVotes));
    choose('ollama', {});
    expect((['request', 'names', 'kinds'] as const).map(votesFor)).toEqual([1, 1, 1]);
    settings.value = { ...settings.value, votes: 4 };
    expect(votesFor('kinds')).toBe(4);
    localStorage.setItem('parsel-model', JSON.stringify(settings.value));
    vi.resetModules();
    expect((await import('../../web/src/llm/settings')).votesFor('request')).toBe(4);
  });

  it('never hold a key, and survive nonsense in the storage', async () => {
    localStorage.setItem('parsel-model', '{"provider":"evil","votes":99,"choices":{"openai":{"model":7}}}');
    const { settings, choose, currentTarget, costOf } = await import('../../web/src/llm/settings');
    expect(settings.value).toMatchObject({ provider: 'recorded', votes: null, choices: { openai: { model: '' } } });
    choose('openai', { base, model: 'm' });
    expect(currentTarget).toThrow(/wants a key/);
    keys.keepKey(base, 'sk-1', 'memory');
    expect(currentTarget()).toMatchObject({ base, model: 'm', key: 'sk-1' });
    expect(localStorage.getItem('parsel-model')).not.toContain('sk-1');
    expect(costOf({ input: 1e6, output: 1e6 })).toBeNull();
    choose('openai', { inputPrice: 2, outputPrice: 8 });
    expect(costOf({ input: 1e6, output: 5e5 })).toBe(6);
    choose('openai', { base: 'https://evil.example/v1' });
    expect(currentTarget).toThrow(/not an address that this page may talk to/);
  });
});
