// Which room of the core may include which: one table. Run by `npm run lint`; a wrong include fails with the room's rule.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

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

const faults = [];
for (const room of readdirSync(join(root, 'core'), { withFileTypes: true })) {
  if (!room.isDirectory()) continue;
  if (!(room.name in rooms)) {
    faults.push(`core/${room.name}: this folder has no row in tests/check_includes.mjs; say there what it may include`);
    continue;
  }
  const { may, rule } = rooms[room.name];
  for (const file of readdirSync(join(root, 'core', room.name))) {
    if (!/\.(h|cpp)$/.test(file)) continue;
    const text = readFileSync(join(root, 'core', room.name, file), 'utf8');
    text.split('\n').forEach((line, i) => {
      const found = /^\s*#\s*include\s*["<]([^">]+)[">]/.exec(line);
      if (!found) return;
      const place = `core/${room.name}/${file}:${i + 1}: ${found[1]}`;
      if (/^(emscripten|wasm|tests|web)\//.test(found[1]))
        faults.push(`${place}: the core is plain C++ and knows no leaf`);
      const [top, other, header] = found[1].split('/');
      if (top !== 'core' || other === room.name) return;
      if (!may.includes(other) && !may.includes(`${other}/${header}`)) faults.push(`${place}: ${rule}`);
    });
  }
}
if (faults.length > 0) {
  process.stderr.write(`${faults.join('\n')}\n`);
  process.exit(1);
}
