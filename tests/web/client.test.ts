import { describe, expect, it, vi } from 'vitest';
import { CoreClient, CoreError, type CoreState, type WorkerLike } from '../../web/src/worker/client';
import type { Request, Response } from '../../web/src/worker/protocol';

type Call = Request & { kind: 'call' };

/** A worker whose answers the test decides. */
class FakeWorker implements WorkerLike {
  onmessage: ((event: MessageEvent<Response>) => void) | null = null;
  onerror: ((event: ErrorEvent) => void) | null = null;
  ondeath: (() => void) | null = null;
  terminated = false;
  readonly calls: Call[] = [];

  constructor(private readonly answer: (call: Call, worker: FakeWorker) => void) {}

  postMessage(message: Request): void {
    if (message.kind === 'start') this.emit({ kind: 'ready', startMilliseconds: 1 });
    else {
      this.calls.push(message);
      this.answer(message, this);
    }
  }
  terminate(): void {
    this.terminated = true;
  }
  emit(response: Response): void {
    queueMicrotask(() => {
      if (!this.terminated) this.onmessage?.({ data: response } as MessageEvent<Response>);
    });
  }
  reply(call: Call, message: unknown): void {
    this.emit({ kind: 'reply', id: call.id, json: JSON.stringify(message), buffers: [] });
  }
}

const module = {} as WebAssembly.Module;

function client(answer: (call: Call, worker: FakeWorker) => void) {
  const workers: FakeWorker[] = [];
  const created = new CoreClient(module, () => {
    const worker = new FakeWorker(answer);
    workers.push(worker);
    return worker;
  });
  return { client: created, workers };
}

const answerVersion = (call: Call, worker: FakeWorker) => worker.reply(call, { result: { version: '1.2.3' } });

describe('a call', () => {
  it('resolves with the result', async () => {
    const { client: core } = client(answerVersion);
    expect((await core.call('version', {})).result).toEqual({ version: '1.2.3' });
  });

  it('rejects with the sentence of the core when it refuses', async () => {
    const error = { stage: 's', place: 'accessor 3', cause: 'it is broken', fix: 'export it again' };
    const { client: core } = client((call, worker) => worker.reply(call, { error }));
    const refused = await core.call('version', {}).catch((reason: unknown) => reason);
    expect(refused).toBeInstanceOf(CoreError);
    expect((refused as CoreError).message).toBe('accessor 3: it is broken; export it again');
  });

  it('rejects a result of another type than the protocol says', async () => {
    const { client: core } = client((call, worker) => worker.reply(call, { result: { version: 7 } }));
    await expect(core.call('version', {})).rejects.toThrow();
  });

  it('reports progress to its own caller only', async () => {
    const { client: core } = client((call, worker) => {
      worker.emit({ kind: 'progress', id: call.id, step: 'reading', done: 1, total: 2 });
      answerVersion(call, worker);
    });
    const first = vi.fn();
    const second = vi.fn();
    await Promise.all([
      core.call('version', {}, { onProgress: first }),
      core.call('version', {}, { onProgress: second }),
    ]);
    expect(first).toHaveBeenCalledTimes(1);
    expect(second).toHaveBeenCalledTimes(1);
    expect(first.mock.calls[0]?.[0]).toMatchObject({ step: 'reading', done: 1, total: 2 });
  });

  it('waits its turn', async () => {
    const { client: core, workers } = client(() => {});
    void core.call('version', {});
    void core.call('warm_up', {});
    await vi.waitFor(() => expect(workers[0]?.calls).toHaveLength(1));
    const [first] = workers[0]?.calls ?? [];
    if (first !== undefined) answerVersion(first, workers[0] as FakeWorker);
    await vi.waitFor(() => expect(workers[0]?.calls.map((call) => call.method)).toEqual(['version', 'warm_up']));
  });
});

describe('cancelling', () => {
  it('terminates the running call and sends the ones behind it to a new worker', async () => {
    const { client: core, workers } = client((call, worker) => {
      if (call.method === 'version') answerVersion(call, worker);
    });
    const controller = new AbortController();
    const hanging = core.call('fail', { kind: 'hang' }, { signal: controller.signal });
    const behind = core.call('version', {});
    await vi.waitFor(() => expect(workers[0]?.calls).toHaveLength(1));
    controller.abort();
    await expect(hanging).rejects.toThrow('aborted');
    expect((await behind).result.version).toBe('1.2.3');
    expect(workers[0]?.terminated).toBe(true);
    expect(core.respawns).toBe(1);
  });

  it('forgets a call that still waits, without disturbing the running one', async () => {
    const { client: core, workers } = client(() => {});
    const running = core.call('version', {});
    const controller = new AbortController();
    const waiting = core.call('warm_up', {}, { signal: controller.signal });
    await vi.waitFor(() => expect(workers[0]?.calls).toHaveLength(1));
    controller.abort();
    await expect(waiting).rejects.toThrow('aborted');
    answerVersion(workers[0]?.calls[0] as Call, workers[0] as FakeWorker);
    await running;
    expect(core.respawns).toBe(0);
  });
});

const model: CoreState = { method: 'warm_up', parameters: {}, buffers: [new Uint8Array([7])] };
const another: CoreState = { ...model };

/** Answers every call but `fail`, which crashes; `methods` is what each worker was asked. */
function crashing(answer: (call: Call, worker: FakeWorker) => void = () => {}) {
  const made = client((call, worker) => {
    if (call.method === 'fail') worker.emit({ kind: 'crashed', text: 'out of memory' });
    else if (call.method === 'version') answerVersion(call, worker);
    else {
      worker.reply(call, { result: {} });
      answer(call, worker);
    }
  });
  return { ...made, methods: (worker: number) => made.workers[worker]?.calls.map(({ method }) => method) };
}

describe('a state that a call needs', () => {
  it('is set up once, however many calls need it', async () => {
    const { client: core, methods, workers } = crashing();
    await Promise.all([1, 2].map(() => core.call('version', {}, { needs: model })));
    expect(methods(0)).toEqual(['warm_up', 'version', 'version']);
    expect(workers[0]?.calls[0]?.buffers).toEqual(model.buffers);
  });

  it('is set up again when another has taken its place', async () => {
    const { client: core, methods } = crashing();
    for (const needs of [model, another, model]) await core.call('version', {}, { needs });
    expect(methods(0)).toEqual(['warm_up', 'version', 'warm_up', 'version', 'warm_up', 'version']);
  });

  it('is there when it was set up for what it gives', async () => {
    const { client: core, methods } = crashing();
    await core.setUp(model);
    await core.call('version', {}, { needs: model });
    expect(methods(0)).toEqual(['warm_up', 'version']);
  });

  it('tells whoever needs it that the core refuses it, and is tried again by the next', async () => {
    let refuses = true;
    const error = { stage: 's', place: 'accessor 3', cause: 'it is broken', fix: 'export it again' };
    const { client: core } = client((call, worker) => {
      if (call.method === 'version') answerVersion(call, worker);
      else worker.reply(call, refuses ? { error } : { result: {} });
    });
    await expect(core.call('version', {}, { needs: model })).rejects.toThrow('accessor 3: it is broken');
    refuses = false;
    expect((await core.call('version', {}, { needs: model })).result.version).toBe('1.2.3');
  });

  it('says how far it is to whoever waits for it', async () => {
    const { client: core } = client((call, worker) => {
      if (call.method === 'version') answerVersion(call, worker);
      else {
        worker.emit({ kind: 'progress', id: call.id, step: 'reading', done: 1, total: 2 });
        worker.reply(call, { result: {} });
      }
    });
    const onProgress = vi.fn();
    await core.call('version', {}, { needs: model, onProgress });
    expect(onProgress).toHaveBeenCalledTimes(1);
  });
});

describe('a crash of the module', () => {
  it('fails the call that caused it and goes on; a new worker gets the state before the next call asks', async () => {
    const { client: core, methods, workers } = crashing();
    await core.setUp(model);
    await expect(core.call('fail', { kind: 'memory' }, { needs: model })).rejects.toThrow('out of memory');
    await vi.waitFor(() => expect(methods(1)).toEqual(['warm_up']));
    expect((await core.call('version', {}, { needs: model })).result.version).toBe('1.2.3');
    expect(methods(1)).toEqual(['warm_up', 'version']);
    expect(workers).toHaveLength(2);
  });

  it('does not touch the calls behind it', async () => {
    const { client: core, methods } = crashing();
    await core.setUp(model);
    const failing = core.call('fail', { kind: 'memory' }, { needs: model });
    const behind = core.call('version', {}, { needs: model });
    await expect(failing).rejects.toThrow('out of memory');
    expect((await behind).result.version).toBe('1.2.3');
    expect(methods(1)).toEqual(['warm_up', 'version']);
  });

  it('in setting up a state is told to whoever needs it, and does not go on for ever', async () => {
    let crashes = false;
    const { client: core, workers } = client((call, worker) => {
      if (call.method === 'version') answerVersion(call, worker);
      else if (crashes || call.method === 'fail') worker.emit({ kind: 'crashed', text: 'unreachable' });
      else worker.reply(call, { result: {} });
    });
    await core.setUp(model);
    crashes = true;
    await expect(core.call('fail', { kind: 'abort' })).rejects.toThrow('unreachable');
    await vi.waitFor(() => expect(workers).toHaveLength(3));
    expect((await core.call('version', {})).result.version).toBe('1.2.3');
    expect(workers).toHaveLength(3);
    await expect(core.call('version', {}, { needs: model })).rejects.toThrow('unreachable');
    expect(workers).toHaveLength(4);
  });

  it('is noticed when the browser ends the worker without a word', async () => {
    const { client: core, workers } = client((call, worker) => {
      if (call.method === 'fail') queueMicrotask(() => worker.ondeath?.());
      else answerVersion(call, worker);
    });
    await expect(core.call('fail', { kind: 'memory' })).rejects.toThrow('the browser ended it');
    expect((await core.call('version', {})).result.version).toBe('1.2.3');
    expect(workers).toHaveLength(2);
    workers[0]?.ondeath?.(); // of one that has been replaced, nothing is heard
    expect((await core.call('version', {})).result.version).toBe('1.2.3');
    expect(workers).toHaveLength(2);
  });

  it('says so when the worker cannot even start, and tries again at the next call', async () => {
    const workers: FakeWorker[] = [];
    const core = new CoreClient(module, () => {
      const worker = new FakeWorker(answerVersion);
      if (workers.length === 0) {
        worker.postMessage = () => worker.emit({ kind: 'crashed', text: 'no memory' });
      }
      workers.push(worker);
      return worker;
    });
    await expect(core.call('version', {})).rejects.toThrow('no memory');
    expect((await core.call('version', {})).result.version).toBe('1.2.3');
  });
});
