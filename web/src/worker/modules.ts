// The core's modules in the page: what each is loaded from, and the one core that they make together. Each has a worker of
// its own; those on demand are fetched when one of their methods is first called (methodsOf in protocol.ts).

import coreUrl from 'parsel-module/parsel.wasm?url';
import { type Calls, CoreClient, CoreError } from './client';
import { type FetchOptions, onDemand } from './on_demand';
import { type Method, methodsOf } from './protocol';
import { watched } from './watch';

/** Compiles the module that the page begins with, and starts its worker. */
export async function startCore(): Promise<CoreClient> {
  const module = await WebAssembly.compileStreaming(fetch(coreUrl));
  return new CoreClient(module, () =>
    watched((name) => new Worker(new URL('./core.worker.ts', import.meta.url), { type: 'module', name })),
  );
}

async function fetchCad(options: Required<FetchOptions>): Promise<CoreClient> {
  try {
    return await (await import('./fetch_cad')).fetchCad(options);
  } catch (error) {
    options.signal.throwIfAborted();
    const reason = error instanceof Error ? error.message : String(error);
    throw new CoreError({
      stage: 'worker',
      place: '',
      cause: `what reads CAD programs could not be fetched (${reason})`,
      fix: 'look whether there is a network, and open it again',
    });
  }
}

/** All methods: those of the first module at once, the others as soon as what they live in is there. */
export function withModules(first: CoreClient, fetchModule = fetchCad): Calls {
  const cad = onDemand(fetchModule);
  const clientOf = (method: Method, options: FetchOptions) => (method in methodsOf.core ? first : cad(options));
  return {
    async call(method, parameters, options = {}) {
      return (await clientOf(method, options)).call(method, parameters, options);
    },
    async setUp(state, options = {}) {
      return (await clientOf(state.method, options)).setUp(state, options);
    },
  };
}
