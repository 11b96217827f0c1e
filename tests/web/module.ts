// Loads the WebAssembly module under Node, as the worker does in the page.
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import createModule, { type ParselModule } from 'parsel-module/parsel.mjs';

export type LoadedModule = ParselModule;

const wasmPath = fileURLToPath(new URL('../../build/wasm/wasm/parsel.wasm', import.meta.url));

export async function loadModule(): Promise<LoadedModule> {
  const compiled = await WebAssembly.compile(await readFile(wasmPath));
  return createModule({
    instantiateWasm(imports, receive) {
      const instance = new WebAssembly.Instance(compiled, imports);
      receive(instance);
      return instance.exports;
    },
    print: () => {},
    printErr: () => {},
  });
}

/** The result and the buffers of a call; an error value is thrown. */
export function call<T>(core: LoadedModule, method: string, parameters: unknown, buffers: Uint8Array[] = []) {
  const reply = core.invoke(method, JSON.stringify(parameters), buffers, null);
  const message = JSON.parse(reply.json) as { result?: T; error?: unknown };
  if (message.result === undefined) throw new Error(JSON.stringify(message.error));
  return { result: message.result, buffers: reply.buffers };
}
