// The WebAssembly module under Node, for tools that need the core: build it first (web/start.sh does).
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');

async function load(name) {
  const module = join(root, 'build', 'wasm', 'wasm', name);
  const { default: createModule } = await import(pathToFileURL(`${module}.mjs`).href);
  const compiled = await WebAssembly.compile(readFileSync(`${module}.wasm`));
  return new Promise((resolve, reject) => {
    createModule({
      instantiateWasm(imports, receive) {
        WebAssembly.instantiate(compiled, imports).then(receive, reject);
        return {};
      },
    }).then(resolve, reject);
  });
}

/** @returns call(method, parameters, buffers) → {result, buffers}; throws an Error that says what the core refused */
export async function loadCore() {
  const [core, cad] = await Promise.all(['parsel', 'parsel_cad'].map(load));
  const ofCad = new Set(cad.methods());
  return (method, parameters, buffers = []) => {
    const module = ofCad.has(method) ? cad : core;
    const reply = module.invoke(method, JSON.stringify(parameters), buffers, null);
    const { result, error } = JSON.parse(reply.json);
    if (error) throw new Error(`${method}: ${[error.place, error.cause, error.fix].filter(Boolean).join('; ')}.`);
    return { result, buffers: reply.buffers };
  };
}
