// Loads the WebAssembly modules under Node, as the workers do in the page.
import { readFile } from 'node:fs/promises';
import { fileURLToPath } from 'node:url';
import type { CreateModule, ParselModule } from 'parsel-module';
import createCore from 'parsel-module/parsel.mjs';
import createCad from 'parsel-module/parsel_cad.mjs';

export type LoadedModule = ParselModule;

async function load(createModule: CreateModule, name: string): Promise<LoadedModule> {
  const path = fileURLToPath(new URL(`../../build/wasm/wasm/${name}.wasm`, import.meta.url));
  const compiled = await WebAssembly.compile(await readFile(path));
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

/** The module that the page begins with. */
export const loadModule = () => load(createCore, 'parsel');
export const loadCadModule = () => load(createCad, 'parsel_cad');

/** Both as one. */
export async function loadWithCad(): Promise<LoadedModule> {
  const [core, cad] = await Promise.all([loadModule(), loadCadModule()]);
  const ofCad = new Set(cad.methods());
  return {
    invoke: (method, ...rest) => (ofCad.has(method) ? cad : core).invoke(method, ...rest),
    methods: () => [...core.methods(), ...cad.methods()],
  };
}

export type Caller = (
  method: string,
  parameters: unknown,
  buffers?: Uint8Array[],
) => { result: unknown; buffers: Uint8Array[] };

/** call() of a module, as the tools of web/tools and tests/eval take the core. */
export const callerOf =
  (core: LoadedModule): Caller =>
  (method, parameters, buffers) =>
    call<unknown>(core, method, parameters, buffers);

/** The result and the buffers of a call; an error value is thrown. */
export function call<T>(core: LoadedModule, method: string, parameters: unknown, buffers: Uint8Array[] = []) {
  const reply = core.invoke(method, JSON.stringify(parameters), buffers, null);
  const message = JSON.parse(reply.json) as { result?: T; error?: unknown };
  if (message.result === undefined) throw new Error(JSON.stringify(message.error));
  return { result: message.result, buffers: reply.buffers };
}
