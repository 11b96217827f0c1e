// The page's end of the core: typed calls with progress and cancel. A worker that crashed or whose call was cancelled is
// terminated and replaced, and the calls that made up its state are replayed, so that the next call finds it unchanged.
import * as v from 'valibot';
import {
  type CoreErrorValue,
  errorSchema,
  type Method,
  type MethodResult,
  methodSchemas,
  type Parameters,
  type Progress,
  type Request,
  type Response,
} from './protocol';
import { watched } from './watch';

/** The core refused, or could not do it. `message` is one sentence for people. */
export class CoreError extends Error {
  constructor(readonly value: CoreErrorValue) {
    super([value.place, [value.cause, value.fix].filter(Boolean).join('; ')].filter(Boolean).join(': '));
    this.name = 'CoreError';
  }
}

export interface CallOptions {
  buffers?: Uint8Array[];
  onProgress?: (progress: Progress) => void;
  /** Aborting terminates the worker; the call rejects with the signal's reason, the calls behind it are sent again. */
  signal?: AbortSignal;
  /** This call sets state in the core under the given name: it is replayed, in order, whenever the worker is replaced. */
  state?: string;
}

export interface CallReply<M extends Method> {
  result: MethodResult<M>;
  buffers: Uint8Array[];
}

interface PendingCall {
  id: number;
  method: Method;
  parameters: unknown;
  buffers: Uint8Array[];
  onProgress: ((progress: Progress) => void) | undefined;
  settle: (outcome: { json: string; buffers: Uint8Array[] } | CoreError) => void;
}

/** What the client needs of a Worker; tests pass their own. */
export interface WorkerLike {
  postMessage(message: Request): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Response>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  /** It has ended without a word: browsers end workers that want too much memory, and tell nobody. */
  ondeath?: (() => void) | null;
}

/** Replayed calls have no caller. */
const replayId = 0;

const crashError = (text: string): CoreError =>
  new CoreError({
    stage: 'worker',
    place: '',
    cause: `the core stopped unexpectedly (${text})`,
    fix: 'your work is kept; try again, or try a smaller model',
  });

export class CoreClient {
  #worker: WorkerLike | undefined;
  #ready = false;
  /** Replayed calls that the worker has not answered yet. */
  #replaying = 0;
  #nextId = 1;
  #queue: PendingCall[] = [];
  #state = new Map<string, { method: Method; parameters: unknown; buffers: Uint8Array[] }>();
  /** How often the worker has been replaced. */
  respawns = 0;
  /** The worker was replaced and could not take its state up again: calls that need it fail until it is set anew. */
  onStateLost: () => void = () => {};
  /** How long the module took to instantiate and warm up, last time, in milliseconds. */
  startMilliseconds = Number.NaN;

  constructor(
    private readonly module: WebAssembly.Module,
    private readonly createWorker: () => WorkerLike,
  ) {
    this.#spawn();
  }

  /** Rejects with CoreError when the core refuses, with the signal's reason when cancelled. */
  async call<M extends Method>(method: M, parameters: Parameters<M>, options: CallOptions = {}): Promise<CallReply<M>> {
    const { signal, state } = options;
    signal?.throwIfAborted();
    const buffers = options.buffers ?? [];
    const reply = await new Promise<{ json: string; buffers: Uint8Array[] }>((resolve, reject) => {
      const pending: PendingCall = {
        id: this.#nextId++,
        method,
        parameters,
        buffers,
        onProgress: options.onProgress,
        settle: (outcome) => {
          signal?.removeEventListener('abort', cancel);
          this.#queue = this.#queue.filter((other) => other !== pending);
          if (outcome instanceof CoreError) reject(outcome);
          else resolve(outcome);
        },
      };
      const cancel = () => {
        const running = this.#queue[0] === pending;
        this.#queue = this.#queue.filter((other) => other !== pending);
        reject(signal?.reason);
        if (running) this.#spawn();
      };
      signal?.addEventListener('abort', cancel, { once: true });
      this.#queue.push(pending);
      if (this.#worker === undefined) this.#spawn();
      else if (this.#queue.length === 1) this.#send();
    });

    const envelope = v.parse(
      v.union([v.strictObject({ result: v.unknown() }), v.strictObject({ error: errorSchema })]),
      JSON.parse(reply.json),
    );
    if ('error' in envelope) throw new CoreError(envelope.error);
    if (state !== undefined) {
      this.#state.delete(state); // replay in the order in which the state was last set
      this.#state.set(state, { method, parameters, buffers });
    }
    return {
      result: v.parse(methodSchemas[method].result, envelope.result) as MethodResult<M>,
      buffers: reply.buffers,
    };
  }

  /** Ends the worker; a later call starts a new one. */
  dispose(): void {
    this.#worker?.terminate();
    this.#worker = undefined;
  }

  #spawn(): void {
    if (this.#worker !== undefined) {
      this.#worker.terminate();
      this.respawns++;
    }
    this.#ready = false;
    this.#replaying = 0;
    const worker = this.createWorker();
    this.#worker = worker;
    worker.onmessage = ({ data }) => {
      if (worker === this.#worker) this.#receive(data);
    };
    worker.onerror = (event) => {
      if (worker === this.#worker) this.#receive({ kind: 'crashed', text: event.message });
    };
    worker.ondeath = () => {
      if (worker === this.#worker) this.#receive({ kind: 'crashed', text: 'the browser ended it' });
    };
    worker.postMessage({ kind: 'start', module: this.module });
  }

  /** Sends the first call in line; one at a time, so that a crash is known to be its fault. */
  #send(): void {
    const [first] = this.#queue;
    if (first === undefined || !this.#ready || this.#replaying > 0) return;
    const { id, method, parameters, buffers } = first;
    this.#worker?.postMessage({ kind: 'call', id, method, parameters, buffers });
  }

  #receive(response: Response): void {
    const [first] = this.#queue;
    switch (response.kind) {
      case 'ready':
        this.startMilliseconds = response.startMilliseconds;
        this.#ready = true;
        this.#replaying = this.#state.size;
        for (const call of this.#state.values()) this.#worker?.postMessage({ kind: 'call', id: replayId, ...call });
        this.#send();
        return;
      case 'progress':
        if (response.id === first?.id) first.onProgress?.(response);
        return;
      case 'reply':
        if (response.id === replayId) this.#replayed(response.json);
        else if (response.id === first?.id) first.settle(response);
        this.#send();
        return;
      case 'crashed':
        this.#recover(response.text);
    }
  }

  #replayed(json: string): void {
    this.#replaying--;
    if ('error' in JSON.parse(json)) this.#loseState();
  }

  #loseState(): void {
    this.#state.clear();
    this.onStateLost();
  }

  #recover(text: string): void {
    if (!this.#ready) {
      // It cannot even start, so neither would its successor: everybody waiting hears of it, the next call tries again.
      this.dispose();
      for (const call of [...this.#queue]) call.settle(crashError(text));
      return;
    }
    // State that crashes when it is replayed would do so for ever.
    if (this.#replaying > 0) this.#loseState();
    this.#queue[0]?.settle(crashError(text));
    this.#spawn();
  }
}

/** Compiles the module and starts the worker of the page. */
export async function startCore(wasmUrl: string): Promise<CoreClient> {
  const module = await WebAssembly.compileStreaming(fetch(wasmUrl));
  return new CoreClient(module, () =>
    watched((name) => new Worker(new URL('./core.worker.ts', import.meta.url), { type: 'module', name })),
  );
}
