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
