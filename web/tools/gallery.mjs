// Writes the gallery into web/public/gallery, through the WebAssembly module: no native build is needed for the page.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { loadCore, root } from './core.mjs';

const folder = join(root, 'web', 'public', 'gallery');
const core = await loadCore();
const { result, buffers } = core('gallery', {});
mkdirSync(folder, { recursive: true });
for (const [index, { file }] of result.models.entries()) writeFileSync(join(folder, file), buffers[index]);
writeFileSync(join(folder, 'gallery.json'), JSON.stringify(result.models));
