// The page's end of one module of the core: typed calls with progress and cancel. A worker that crashed or whose call was
// cancelled is terminated and replaced. What a worker has to know before a call comes with the call, as a state: it is set up
// when the worker has another or is new, so that nobody else needs to know which worker it is.
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
  /** What the core must have been told before this call. It is told when it has another state, or none. */
  needs?: CoreState;
  /** This call is what puts the core into this state: see setUp(). */
  sets?: CoreState;
}

/** A call that puts the core into a state; the core has one at a time. The same object is the same state. */
export interface CoreState<M extends Method = Method> {
  readonly method: M;
  readonly parameters: unknown;
  readonly buffers: readonly Uint8Array[];
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
  needs: CoreState | undefined;
  sets: CoreState | undefined;
  onProgress: ((progress: Progress) => void) | undefined;
  settle: (outcome: { json: string; buffers: Uint8Array[] } | CoreError) => void;
}

/** What can be asked of the core. */
export type Calls = Pick<CoreClient, 'call' | 'setUp'>;

/** What the client needs of a Worker; tests pass their own. */
export interface WorkerLike {
  postMessage(message: Request): void;
  terminate(): void;
  onmessage: ((event: MessageEvent<Response>) => void) | null;
  onerror: ((event: ErrorEvent) => void) | null;
  /** It has ended without a word: browsers end workers that want too much memory, and tell nobody. */
  ondeath?: (() => void) | null;
}

/** Of calls that set up a state: they have no caller of their own. */
const setUpId = 0;

const envelopeSchema = v.union([v.strictObject({ result: v.unknown() }), v.strictObject({ error: errorSchema })]);

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
  /** What the worker has been told. */
  #state: CoreState | null = null;
  /** What it is being told. */
  #settingUp: CoreState | null = null;
  /** What it is told as soon as it is idle, so that the next call need not wait: what the worker before it knew. */
  #wanted: CoreState | null = null;
  #nextId = 1;
  #queue: PendingCall[] = [];
  /** How often the worker has been replaced. */
  respawns = 0;
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
    const { signal, needs, sets } = options;
    signal?.throwIfAborted();
    const buffers = options.buffers ?? [];
    const reply = await new Promise<{ json: string; buffers: Uint8Array[] }>((resolve, reject) => {
      const pending: PendingCall = {
        id: this.#nextId++,
        method,
        parameters,
        buffers,
        needs,
        sets,
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

    const envelope = v.parse(envelopeSchema, JSON.parse(reply.json));
    if ('error' in envelope) throw new CoreError(envelope.error);
    return {
      result: v.parse(methodSchemas[method].result, envelope.result) as MethodResult<M>,
      buffers: reply.buffers,
    };
  }

  /** Puts the core into a state, for what that gives: calls that need it find it there. */
  setUp<M extends Method>(
    state: CoreState<M>,
    options: Pick<CallOptions, 'signal' | 'onProgress'> = {},
  ): Promise<CallReply<M>> {
    const { method, parameters, buffers } = state;
    return this.call(method, parameters as Parameters<M>, { ...options, buffers: [...buffers], sets: state });
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
    this.#state = null;
    this.#settingUp = null;
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

  /** Sends the first call in line, or what it needs; one at a time, so that a crash is known to be its fault. */
  #send(): void {
    if (!this.#ready || this.#settingUp !== null) return;
    const [first] = this.#queue;
    const needs = first === undefined ? this.#wanted : first.needs;
    if (needs !== undefined && needs !== null && needs !== this.#state) {
      this.#settingUp = needs;
      this.#state = null;
      this.#post(setUpId, needs);
    } else if (first !== undefined) this.#post(first.id, first);
  }

  #post(id: number, { method, parameters, buffers }: CoreState): void {
    this.#worker?.postMessage({ kind: 'call', id, method, parameters, buffers: [...buffers] });
  }

  #receive(response: Response): void {
    const [first] = this.#queue;
    switch (response.kind) {
      case 'ready':
        this.startMilliseconds = response.startMilliseconds;
        this.#ready = true;
        this.#send();
        return;
      case 'progress':
        if (response.id === first?.id || response.id === setUpId) first?.onProgress?.(response);
        return;
      case 'reply':
        if (response.id === setUpId) this.#haveSetUp(response);
        else if (response.id === first?.id) {
          if (first.sets !== undefined) this.#have(first.sets, response.json);
          first.settle(response);
        }
        this.#send();
        return;
      case 'crashed':
        this.#recover(response.text);
    }
  }

  /** Where the core refuses a state, whoever needs it hears why. */
  #haveSetUp(reply: { json: string; buffers: Uint8Array[] }): void {
    const state = this.#settingUp;
    this.#settingUp = null;
    if (state === null || this.#have(state, reply.json)) return;
    const [first] = this.#queue;
    if (first?.needs === state) first.settle(reply);
  }

  /** What the core knows after it has been told a state; whether it has taken it. */
  #have(state: CoreState, json: string): boolean {
    const taken = !('error' in (JSON.parse(json) as object));
    this.#state = taken ? state : null;
    if (taken) this.#wanted = state;
    else if (this.#wanted === state) this.#wanted = null;
    return taken;
  }

  #recover(text: string): void {
    if (!this.#ready) {
      // It cannot even start, so neither would its successor: everybody waiting hears of it, the next call tries again.
      this.dispose();
      for (const call of [...this.#queue]) call.settle(crashError(text));
      return;
    }
    // A state that crashes is not set up again unless somebody needs it.
    if (this.#settingUp !== null) this.#wanted = null;
    this.#queue[0]?.settle(crashError(text));
    this.#spawn();
  }
}
