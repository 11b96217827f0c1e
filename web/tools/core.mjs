// The WebAssembly module under Node, for tools that need the core: build it first (web/start.sh does).
import { readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

export const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');

/** @returns call(method, parameters, buffers) → {result, buffers}; throws an Error that says what the core refused */
export async function loadCore() {
  const module = join(root, 'build', 'wasm', 'wasm', 'parsel');
  const { default: createModule } = await import(pathToFileURL(`${module}.mjs`).href);
  const compiled = await WebAssembly.compile(readFileSync(`${module}.wasm`));
  const core = await new Promise((resolve, reject) => {
    createModule({
      instantiateWasm(imports, receive) {
        WebAssembly.instantiate(compiled, imports).then(receive, reject);
        return {};
      },
    }).then(resolve, reject);
  });
  return (method, parameters, buffers = []) => {
    const reply = core.invoke(method, JSON.stringify(parameters), buffers, null);
    const { result, error } = JSON.parse(reply.json);
    if (error) throw new Error(`${method}: ${[error.place, error.cause, error.fix].filter(Boolean).join('; ')}.`);
    return { result, buffers: reply.buffers };
  };
}
