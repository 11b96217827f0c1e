// Which room of the page may import what: one table. Run by `npm run lint`; a wrong import fails with the room's rule, and
// modules that need each other in a circle, be it for types alone, with the circle.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join, normalize } from 'node:path';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';
import { cyclesIn, inWords } from './module_cycles.mjs';

const web = join(dirname(fileURLToPath(import.meta.url)), '../web');
const src = join(web, 'src');
/** The packages that others install; their rooms are named from here. */
const runtime = '../runtime/src/';
const headless = '../headless/src/';

/** room: the rooms, or single files of them, and the packages that it may import, and why. */
const rooms = {
  program: {
    may: ['../../core/edit/operators.json'],
    packages: ['valibot'],
    rule: 'program reads, checks and evaluates programs, by the table of operators, and nothing else; it also runs where there is no page',
  },
  texts: {
    may: [],
    packages: ['@preact/signals'],
    rule: 'texts is what the page says, in which language; it knows nothing of what is said',
  },
  scene: {
    may: ['program', 'carve/steps'],
    packages: ['three', 'camera-controls'],
    rule: 'scene draws what it is given; it knows neither the session nor the core',
  },
  formats: {
    may: ['program/cut', 'carve/geometry', 'carve/matrix'],
    packages: ['three', '@gltf-transform', 'fflate'],
    rule: 'formats makes GLBs of files of other formats, and such files of GLBs; it also runs where there is no page',
  },
  carve: {
    may: ['formats/read_gltf'],
    packages: ['@gltf-transform'],
    rule: 'carve changes what is one part of a glTF file and nothing else; it also runs where there is no page',
  },
  solid: {
    may: [],
    packages: ['manifold-3d', 'fflate', '@gltf-transform'],
    rule: 'solid makes one closed surface of triangles and writes it for printers; it also runs where there is no page',
  },
  fill: {
    may: ['solid/parts', 'solid/types', 'solid/vectors', 'solid/weld'],
    packages: ['three', 'three-mesh-bvh', 'meshoptimizer', '@gltf-transform', 'parsel-module'],
    rule: 'fill closes gaps between surfaces by new ones and nothing else; it also runs where there is no page',
  },
  worker: {
    may: ['scene/load', 'formats', 'carve', 'solid', 'fill'],
    packages: ['valibot', 'parsel-module', 'draco3dgltf', 'meshoptimizer', '@gltf-transform', 'manifold-3d'],
    rule: 'worker is the way to the core and back; of the page it knows the type of a file alone, and what reads files',
  },
  llm: {
    may: ['texts', 'program/json', 'program/cut', 'worker/protocol'],
    packages: ['@preact/signals', 'valibot', 'idb-keyval'],
    rule: 'llm asks language models; what prompts and replies mean is the business of the core and the session',
  },
  share: {
    may: [
      'texts',
      'program',
      'scene/camera',
      'carve/steps',
      'carve/placing',
      'session/document',
      'session/family_state',
    ],
    packages: ['valibot'],
    rule: 'share writes and reads saved work; of the session it knows the type of the work alone',
  },
  session: {
    may: ['texts', 'program', 'scene', 'formats', 'carve/steps', 'carve/placing', 'solid', 'worker', 'llm', 'share'],
    packages: ['@preact/signals', 'valibot', 'idb-keyval', 'fflate', 'parsel-module', 'draco3dgltf'],
    rule: 'session is the state of the page and what can be done to it, without a single element of the page',
  },
  ui: {
    may: ['texts', 'program', 'scene', 'carve/placing', 'worker', 'llm', 'share', 'session'],
    packages: ['preact', '@preact/signals'],
    rule: 'ui shows the session and calls it; drawing, storing and asking are done in their rooms',
  },
  runtime: {
    may: ['program'],
    packages: [],
    rule: 'the core of the runtime is for pages without three.js and without WebAssembly',
  },
  'runtime/three': {
    may: ['runtime', 'program', 'scene/meshes', 'scene/model_view', 'scene/cage'],
    packages: ['three'],
    rule: 'the helper for three.js moves a scene; it brings neither a stage nor a loader',
  },
  'runtime/viewer': {
    may: ['runtime', 'runtime/three', 'program', 'scene'],
    packages: [],
    rule: 'the element shows a model on the stage of the page; of three.js it knows what scene makes of it',
  },
  headless: { may: [], packages: [], rule: 'headless runs the command line under Node and knows nothing of the page' },
};

const imported = /\b(?:from|import)\s*\(?\s*'([^']+)'/g;

/** "scene" of scene/cage.ts, "runtime/three" of ../runtime/src/three/solid.ts. */
function roomOf(path) {
  if (path.startsWith(headless)) return 'headless';
  if (!path.startsWith(runtime)) return path.split('/')[0];
  const [folder, file] = path.slice(runtime.length).split('/');
  return file === undefined ? 'runtime' : `runtime/${folder}`;
}

/** @param file its path from web/src, of a room */
export function importFaults(file, text) {
  const room = roomOf(file);
  if (!file.includes('/')) return []; // main.tsx starts it all
  if (!(room in rooms))
    return [`web/src/${room}: this folder has no row in tests/check_imports.mjs; say there what it may import`];
  const { may, packages, rule } = rooms[room];
  const isAllowed = (path) => {
    if (!path.startsWith('.'))
      return packages.some((name) => path === name || path.startsWith(`${name}/`)) || path.startsWith('node:');
    const target = normalize(join(dirname(file), path)).replace(/^\.\.\/src\//, '');
    const other = roomOf(target);
    return other === room || may.includes(other) || may.includes(target.replace(/\.tsx?$/, ''));
  };
  return text
    .split('\n')
    .flatMap((line, i) =>
      [...line.matchAll(imported)]
        .filter(([, path]) => !isAllowed(path))
        .map(([, path]) => `${normalize(join('web/src', file))}:${i + 1}: ${path}: ${rule}`),
    );
}

/** @param texts by the path of each module from web/src */
export function circleFaults(texts) {
  const modules = new Map([...texts.keys()].map((file) => [file.replace(/\.tsx?$/, ''), file]));
  const graph = new Map();
  for (const [name, file] of modules) {
    const paths = [...texts.get(file).matchAll(imported)].map(([, path]) => path);
    const targets = paths.map((path) => normalize(join(dirname(file), path)).replace(/^\.\.\/src\//, ''));
    graph.set(name, new Set(targets.filter((target, i) => paths[i].startsWith('.') && modules.has(target))));
  }
  return cyclesIn(graph)
    .map((cycle) => inWords(cycle.map((name) => normalize(join('web/src', name)))))
    .map((circle) => `${circle}: they need each other in a circle; give what both need a module of its own`);
}

if (argv[1] === fileURLToPath(import.meta.url)) {
  const filesOf = (folder) => readdirSync(join(src, folder), { recursive: true, encoding: 'utf8' });
  const files = ['', runtime, headless]
    .flatMap((folder) => filesOf(folder).map((file) => folder + file))
    .filter((file) => /\.tsx?$/.test(file));
  const texts = new Map(files.map((file) => [file, readFileSync(join(src, file), 'utf8')]));
  const faults = [...[...texts].flatMap(([file, text]) => importFaults(file, text)), ...circleFaults(texts)];
  if (faults.length > 0) {
    process.stderr.write(`${faults.join('\n')}\n`);
    process.exit(1);
  }
}
