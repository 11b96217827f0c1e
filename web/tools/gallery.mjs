// Writes the gallery into web/public/gallery, through the WebAssembly module: no native build is needed for the page.
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const module = join(root, 'build', 'wasm', 'wasm', 'parsel');
const folder = join(root, 'web', 'public', 'gallery');

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

const { json, buffers } = core.invoke('gallery', '{}', [], null);
const { result, error } = JSON.parse(json);
if (error) {
  process.stderr.write(`${error.place}: ${error.cause}; ${error.fix}.\n`);
  process.exit(1);
}
mkdirSync(folder, { recursive: true });
for (const [index, { file }] of result.models.entries()) writeFileSync(join(folder, file), buffers[index]);
writeFileSync(join(folder, 'gallery.json'), JSON.stringify(result.models));
