// Which room of the core may include which: one table. Run by `npm run lint`; a wrong include fails with the room's rule, and
// modules (a header and its source) that need each other in a circle with the circle.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';
import { cyclesIn, inWords } from './module_cycles.mjs';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');

/** room: what it may include besides itself, and why. */
const rooms = {
  base: { may: [], rule: 'base is what every room shares and knows none of them' },
  gltf: { may: ['base'], rule: 'gltf reads files and knows nothing of parts or edits' },
  shape: { may: ['base', 'gltf'], rule: 'shape finds parts and relations and knows nothing of edits' },
  amount: { may: ['base'], rule: 'amount is the expression language alone' },
  edit: { may: ['base', 'shape', 'amount'], rule: 'edit holds programs and their evaluation, not how they are found' },
  export: {
    may: ['base', 'gltf', 'shape', 'edit', 'propagate/contact.h'],
    rule: 'export writes edited models; it evaluates programs, and of propagation it knows how two boxes touch, no more',
  },
  split: {
    may: ['base', 'gltf', 'shape', 'export/apply_file.h'],
    rule: 'split tells parts apart before shape sees the file; of export it knows what writes a GLB alone',
  },
  prove: { may: ['base', 'shape', 'amount', 'edit'], rule: 'prove bounds what a program does and knows no search' },
  propagate: {
    may: ['base', 'shape', 'amount', 'edit', 'prove'],
    rule: 'propagate searches; it neither writes models nor asks the checker',
  },
  check: {
    may: ['base', 'shape', 'edit/program.h'],
    rule: 'check is worth something only as long as it shares no code with what it checks: base, shape and the types of programs',
  },
  infer: {
    may: ['base', 'shape', 'edit', 'propagate/edit_request.h', 'propagate/transfer.h', 'cad', 'family/vote.h'],
    rule: 'infer speaks to language models about shapes, edits and CAD models; of the search it knows the request alone, of families how variations are voted on',
  },
  cad: {
    may: ['base', 'amount/number.h', 'shape/label.h', 'gallery/glb_writer.h'],
    rule: 'cad reads and writes CAD programs; of amount it knows decimals, of shape the names of parts, of the gallery what writes a GLB',
  },
  family: {
    may: ['base', 'cad', 'edit/program.h'],
    rule: 'family finds what variations of a CAD model share; of edit it knows the types of programs alone',
  },
  gallery: { may: ['base', 'shape/shape.h'], rule: 'gallery generates models; of shape it knows the type alone' },
  cli: {
    may: [
      'base',
      'gltf',
      'shape',
      'edit',
      'export',
      'prove',
      'propagate',
      'check',
      'infer',
      'gallery',
      'cad',
      'family',
      'split',
    ],
    rule: 'cli is a leaf: commands call rooms',
  },
};

/** Circles that are there, and why they still are. */
const knots = {
  'core/edit/displacement → core/edit/operators → core/edit/displacement':
    'the formula is a template beside the table of operators, whose header nearly every file includes',
  'core/gallery/gallery → core/gallery/model_builder → core/gallery/gallery':
    'the types of a model stand beside the list of models; to be parted when it changes next',
  'core/propagate/alternatives → core/propagate/seeds → core/propagate/propagate → core/propagate/alternatives':
    'the types of a search stand beside the search; to be parted when it changes next',
  'core/propagate/compose → core/propagate/compose_part → core/propagate/compose': 'the same',
  'core/shape/abstraction → core/shape/gltf_import → core/shape/abstraction':
    'the importer takes the types of what the stage begins with; to be parted when it changes next',
  'core/shape/symmetry → core/shape/symmetry_search → core/shape/symmetry': 'the same',
};

const included = /^\s*#\s*include\s*["<]([^">]+)[">]/gm;
const moduleOf = (file) => file.replace(/\.(h|cpp)$/, '');

/** @param texts by the path of each header and source: "core/edit/program.h" */
export function circleFaults(texts, known = knots) {
  const graph = new Map();
  for (const [file, text] of texts) {
    const needed = graph.get(moduleOf(file)) ?? new Set();
    graph.set(moduleOf(file), needed);
    for (const [, path] of text.matchAll(included))
      if (moduleOf(path) !== moduleOf(file) && texts.has(path)) needed.add(moduleOf(path));
  }
  const circles = cyclesIn(graph).map(inWords);
  return [
    ...circles
      .filter((circle) => !(circle in known))
      .map((circle) => `${circle}: they need each other in a circle; give what both need a header of its own`),
    ...Object.keys(known)
      .filter((circle) => !circles.includes(circle))
      .map((circle) => `${circle}: it is no circle any more; take it off the list in tests/check_includes.mjs`),
  ];
}

/** What a room's file includes and may not. */
function includeFaults(room, file, text) {
  const { may, rule } = rooms[room];
  return text.split('\n').flatMap((line, i) => {
    const found = /^\s*#\s*include\s*["<]([^">]+)[">]/.exec(line);
    if (!found) return [];
    const place = `${file}:${i + 1}: ${found[1]}`;
    if (/^(emscripten|wasm|tests|web)\//.test(found[1])) return [`${place}: the core is plain C++ and knows no leaf`];
    const [top, other, header] = found[1].split('/');
    const isAllowed = top !== 'core' || other === room || may.includes(other) || may.includes(`${other}/${header}`);
    return isAllowed ? [] : [`${place}: ${rule}`];
  });
}

if (argv[1] === fileURLToPath(import.meta.url)) {
  const faults = [];
  const texts = new Map();
  for (const room of readdirSync(join(root, 'core'), { withFileTypes: true })) {
    if (!room.isDirectory()) continue;
    if (!(room.name in rooms)) {
      faults.push(
        `core/${room.name}: this folder has no row in tests/check_includes.mjs; say there what it may include`,
      );
      continue;
    }
    for (const name of readdirSync(join(root, 'core', room.name))) {
      if (!/\.(h|cpp)$/.test(name)) continue;
      const file = `core/${room.name}/${name}`;
      texts.set(file, readFileSync(join(root, file), 'utf8'));
      faults.push(...includeFaults(room.name, file, texts.get(file)));
    }
  }
  faults.push(...circleFaults(texts));
  if (faults.length > 0) {
    process.stderr.write(`${faults.join('\n')}\n`);
    process.exit(1);
  }
}
