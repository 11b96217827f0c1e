// Sweet Home 3D's furniture libraries, unpacked, to part-labelled GLBs.
//   node tests/eval/convert.mjs UNPACKED OUTPUT
// UNPACKED holds a folder a library, with its PluginFurnitureCatalog.properties, models and licences (furniture.sh makes
// it). OUTPUT gets LIBRARY_MODEL.glb, licences/LIBRARY.txt and conversion.json, which says of every model what became of
// it.
//
// A model is usable when it has 3 to 100 parts with at least two labels, and at least 60 % of its surface belongs to
// parts whose label says something. People are left out: they are one skin.
import { cpSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { writeGlb } from './glb.mjs';
import { readMtl, readObj } from './obj.mjs';
import { partsOf } from './parts.mjs';

const fewestParts = 3;
const mostParts = 100;
const leastLabelled = 0.6;
const mostTriangles = 300_000;
const largestImage = 2_000_000;

const [unpacked, output] = process.argv.slice(2);
if (output === undefined) throw new Error('usage: node convert.mjs UNPACKED OUTPUT');

/** Of every model, by number: its properties. */
function readCatalogue(text) {
  const models = new Map();
  for (const [, key, number, value] of text.matchAll(/^(\w+)#(\d+)=(.*)$/gm)) {
    if (!models.has(number)) models.set(number, {});
    models.get(number)[key] = value.trim();
  }
  return [...models.values()].filter(({ model }) => model !== undefined);
}

/** Turns the model as its catalogue says and stretches it to the size given there (cm), standing on y = 0; metres. The
 * libraries, like glTF, have +Y up and furniture facing +Z. */
function place(obj, { modelRotation, width, height, depth }) {
  const { positions, normals, surfaces } = obj;
  if (modelRotation !== undefined) {
    const m = modelRotation.split(/\s+/).map(Number);
    for (const list of [positions, normals]) {
      for (let i = 0; i < list.length; i += 3) {
        const p = list.slice(i, i + 3);
        for (let k = 0; k < 3; k++) list[i + k] = m[3 * k] * p[0] + m[3 * k + 1] * p[1] + m[3 * k + 2] * p[2];
      }
    }
  }
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (const { corners } of surfaces) {
    for (let i = 0; i < corners.length; i += 3) {
      for (let k = 0; k < 3; k++) {
        const x = positions[3 * corners[i] + k];
        low[k] = Math.min(low[k], x);
        high[k] = Math.max(high[k], x);
      }
    }
  }
  const size = [width, height, depth].map((cm) => Number(cm) / 100);
  const scale = size.map((metres, k) => (high[k] > low[k] ? metres / (high[k] - low[k]) : 1));
  if (!scale.every(Number.isFinite)) throw new Error('the catalogue gives no size');
  const origin = [(low[0] + high[0]) / 2, low[1], (low[2] + high[2]) / 2];
  for (let i = 0; i < positions.length; i++) positions[i] = (positions[i] - origin[i % 3]) * scale[i % 3];
  for (let i = 0; i < normals.length; i++) normals[i] /= scale[i % 3];
}

/** Materials of a model by name, with their pictures where there are any. */
function materialsOf(path, text) {
  const library = [...text.matchAll(/^mtllib\s+(.+?)\s*$/gm)].map(([, name]) => join(dirname(path), name));
  const materials = new Map(library.filter(existsSync).flatMap((file) => [...readMtl(readFileSync(file, 'latin1'))]));
  return (name) => {
    const found = materials.get(name) ?? { colour: [0.8, 0.8, 0.8], opacity: 1, shininess: 0, texture: null };
    const file = found.texture === null ? null : join(dirname(path), found.texture.replaceAll('\\', '/'));
    const image = file !== null && existsSync(file) ? readFileSync(file) : null;
    const isRead = image !== null && image.length <= largestImage && (image[0] === 0x89 || image[0] === 0xff);
    return { ...found, image: isRead ? image : null };
  };
}

/** Why the parts are not to be used, or ''. */
function objection(parts) {
  if (parts.length < fewestParts) return 'fewer than 3 parts';
  if (parts.length > mostParts) return 'more than 100 parts';
  const area = (list) => list.reduce((sum, part) => sum + part.area, 0);
  if (area(parts.filter(({ from }) => from !== 'nothing')) < leastLabelled * area(parts)) return 'names say nothing';
  return new Set(parts.map(({ label }) => label)).size < 2 ? 'one label only' : '';
}

function convert(library, entry, licence) {
  const path = join(unpacked, library, entry.model);
  const name = `${library}_${entry.model
    .split('/')
    .at(-1)
    .replace(/\.\w+$/, '')}`.toLowerCase();
  const result = { name, library, title: entry.name, category: entry.category, usable: false };
  const refuse = (why) => ({ ...result, why });
  if (entry.category === 'Characters') return refuse('a person');
  if (!existsSync(path)) return refuse('no such file');
  try {
    const text = readFileSync(path, 'latin1');
    const obj = readObj(text);
    const triangles = obj.surfaces.reduce((sum, { corners }) => sum + corners.length / 9, 0);
    if (triangles > mostTriangles) return refuse('more than 300,000 triangles');
    if (triangles === 0) return refuse('no triangles');
    place(obj, entry);
    const parts = partsOf(obj, name.slice(library.length + 1));
    Object.assign(result, { triangles, parts: parts.length, labels: [...new Set(parts.map(({ label }) => label))] });
    const why = objection(parts);
    if (why !== '') return refuse(why);
    const asset = { generator: 'tests/eval/convert.mjs', copyright: `${entry.creator}, ${licence}` };
    writeFileSync(join(output, `${name}.glb`), writeGlb(parts, obj, materialsOf(path, text), asset));
    const from = (what) => parts.filter((part) => part.from === what).length;
    return { ...result, usable: true, from_groups: from('group'), from_materials: from('material') };
  } catch (error) {
    return refuse(error.message);
  }
}

rmSync(output, { recursive: true, force: true });
mkdirSync(join(output, 'licences'), { recursive: true });
const results = [];
for (const library of readdirSync(unpacked).sort()) {
  const catalogue = join(unpacked, library, 'PluginFurnitureCatalog.properties');
  if (!existsSync(catalogue)) continue;
  const text = readFileSync(catalogue, 'latin1');
  cpSync(join(unpacked, library, 'LICENSE.TXT'), join(output, 'licences', `${library}.txt`));
  const licence = /^license=(.*)$/m.exec(text)?.[1].trim() ?? 'see licences';
  for (const entry of readCatalogue(text)) results.push(convert(library, entry, licence));
}
writeFileSync(join(output, 'conversion.json'), `${JSON.stringify(results, null, 1)}\n`);

const count = (list, key) => {
  const counts = new Map();
  for (const item of list) counts.set(key(item), (counts.get(key(item)) ?? 0) + 1);
  return [...counts]
    .sort((a, b) => b[1] - a[1])
    .map(([what, n]) => `${n} ${what}`)
    .join(', ');
};
const usable = results.filter((result) => result.usable);
const refused = results.filter((result) => !result.usable);
const parts = usable.map((result) => result.parts).sort((a, b) => a - b);
process.stdout.write(
  `${usable.length} of ${results.length} models converted: ${count(usable, ({ library }) => library)}
parts a model: median ${parts[parts.length >> 1]}, most ${parts.at(-1)}
left out: ${count(refused, ({ why }) => why)}
`,
);
