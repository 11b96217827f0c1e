// Writes the gallery into web/public/gallery, through the WebAssembly module: no native build is needed for the page.
import { mkdirSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { loadCore, root } from './core.mjs';
import { fuse } from './fuse.mjs';
import { fusedIds, namelessIds, withoutNames } from './nameless.mjs';

const folder = join(root, 'web', 'public', 'gallery');
const core = await loadCore();
const { result, buffers } = core('gallery', {});
mkdirSync(join(folder, 'programs'), { recursive: true });
for (const [index, { file }] of result.models.entries()) writeFileSync(join(folder, file), buffers[index]);
writeFileSync(join(folder, 'gallery.json'), JSON.stringify(result.models));

// What most models of the world look like.
const nameless = namelessIds.map((id) => {
  const index = result.models.findIndex((model) => model.id === id);
  writeFileSync(join(folder, `${id}_nameless.glb`), withoutNames(buffers[index]));
  return { id: `${id}_nameless`, title: `${result.models[index].title}, nameless` };
});
for (const id of fusedIds) {
  const index = result.models.findIndex((model) => model.id === id);
  writeFileSync(join(folder, `${id}_fused.glb`), (await fuse(buffers[index])).glb);
  nameless.push({ id: `${id}_fused`, title: `${result.models[index].title}, fused into one piece` });
}
writeFileSync(join(folder, 'nameless.json'), JSON.stringify(nameless));

// The CAD programs, each with its variations and what it makes: the thumbnails are drawn from that.
const { result: cad, buffers: texts } = core('cad_gallery', {});
const programs = cad.programs.map(({ id }, index) => {
  const name = `${id}_program`;
  const [scad, variations] = texts.slice(2 * index, 2 * index + 2);
  // Under the name that the page opens it by, which stands in prompts.
  writeFileSync(join(folder, 'programs', `${id}.scad`), scad);
  writeFileSync(join(folder, 'programs', `${id}.variations.json`), variations);
  writeFileSync(join(folder, `${name}.glb`), core('open_cad', { name: id }, [scad]).buffers[0]);
  return { id: name, title: id[0].toUpperCase() + id.slice(1) };
});
writeFileSync(join(folder, 'programs.json'), JSON.stringify(programs));
