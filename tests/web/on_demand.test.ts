// What is fetched when it is first asked for: once for all who ask, ended when nobody waits, anew after a failure.
import { describe, expect, it } from 'vitest';
import type { CoreClient } from '../../web/src/worker/client';
import { CoreError } from '../../web/src/worker/client';
import { counted } from '../../web/src/worker/fetch_cad';
import { withModules } from '../../web/src/worker/modules';
import { type FetchOptions, onDemand } from '../../web/src/worker/on_demand';
import type { Progress } from '../../web/src/worker/protocol';

/** A load that the test ends, and what was begun. */
function loads() {
  const begun: { options: Required<FetchOptions>; give: (value: string) => void; fail: (error: unknown) => void }[] =
    [];
  const get = onDemand((options) => new Promise<string>((give, fail) => void begun.push({ options, give, fail })));
  return { begun, get };
}

describe('what is fetched on demand', () => {
  it('is fetched once for all who ask, and stays', async () => {
    const { begun, get } = loads();
    expect(begun).toHaveLength(0);
    const both = [get(), get()];
    begun[0]?.give('module');
    expect(await Promise.all([...both, get()])).toEqual(['module', 'module', 'module']);
    expect(begun).toHaveLength(1);
  });

  it('tells all who wait how far it is', async () => {
    const { begun, get } = loads();
    const told: string[] = [];
    const both = ['a', 'b'].map((name) => get({ onProgress: ({ step }) => void told.push(`${name} ${step}`) }));
    begun[0]?.options.onProgress({ step: 'half', done: 0, total: 0 });
    begun[0]?.give('module');
    await Promise.all(both);
    expect(told).toEqual(['a half', 'b half']);
  });

  it('goes on when one of two gives up, ends when both do, and begins anew then', async () => {
    const { begun, get } = loads();
    const [one, two] = [new AbortController(), new AbortController()];
    const asked = [get({ signal: one.signal }), get({ signal: two.signal })];
    one.abort(new Error('cancelled'));
    await expect(asked[0]).rejects.toThrow('cancelled');
    expect(begun[0]?.options.signal.aborted).toBe(false);
    two.abort(new Error('cancelled as well'));
    await expect(asked[1]).rejects.toThrow('cancelled as well');
    expect(begun[0]?.options.signal.aborted).toBe(true);
    const again = get();
    begun[0]?.fail(new Error('aborted')); // the old one ends late, and takes nothing with it
    begun[1]?.give('module');
    expect(await again).toBe('module');
    await expect(get({ signal: AbortSignal.abort(new Error('before')) })).rejects.toThrow('before');
  });

  it('is tried again after a failure', async () => {
    const { begun, get } = loads();
    const first = get();
    begun[0]?.fail(new Error('no network'));
    await expect(first).rejects.toThrow('no network');
    const second = get();
    begun[1]?.give('module');
    expect(await second).toBe('module');
  });
});

describe('a response whose bytes are counted', () => {
  const bytes = new Uint8Array(1_500_000).map((_, i) => i);
  const steps = async (headers: Record<string, string>) => {
    const told: Progress[] = [];
    const response = counted(new Response(bytes, { headers }), 'fetching', (progress) => void told.push(progress));
    expect(Buffer.compare(Buffer.from(await response.arrayBuffer()), bytes)).toBe(0);
    expect(response.headers.get('content-type')).toBe('application/wasm');
    return told.at(-1)?.step;
  };
  it('is the same, and says of how much when that is known', async () => {
    expect(await steps({ 'content-length': '1500000' })).toBe('fetching, 1.5 of 1.5 MB');
    expect(await steps({ 'content-length': '400000', 'content-encoding': 'br' })).toBe('fetching, 1.5 MB');
  });
});

describe('the modules as one core', () => {
  const client = (name: string) =>
    ({ call: async (method: string) => ({ result: `${name}: ${method}`, buffers: [] }) }) as unknown as CoreClient;
  it('ask each for its own methods, and fetch the second when it is needed', async () => {
    let fetched = 0;
    const core = withModules(client('core'), async () => {
      fetched++;
      return client('cad');
    });
    expect((await core.call('version', {})).result).toBe('core: version');
    expect(fetched).toBe(0);
    const about = { cad: {}, variations: null, choices: {} };
    expect((await core.call('find_family', about)).result).toBe('cad: find_family');
    await core.call('find_family', about);
    expect(fetched).toBe(1);
  });
  it('pass on why the second cannot be had', async () => {
    const value = { stage: 'worker', place: '', cause: 'no network', fix: 'look whether there is one' };
    const core = withModules(client('core'), () => Promise.reject(new CoreError(value)));
    await expect(core.call('open_cad', { name: 'x' })).rejects.toThrow('no network; look whether there is one');
  });
});
