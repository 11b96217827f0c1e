// Builds the package parsel-runtime into web/runtime/dist, and fails when its core has outgrown its limit.
//   node web/runtime/build.mjs [--figures]      figures of the benchmarks (tests/bench/compare.mjs) on stdout
import { execFileSync } from 'node:child_process';
import { copyFileSync, existsSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join, relative } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { build } from 'vite';

const coreLimit = 25e3; // bytes, gzip
const here = fileURLToPath(new URL('.', import.meta.url));
const dist = join(here, 'dist');
const asFigures = process.argv.includes('--figures');
const isThree = (id) => id === 'three' || id.startsWith('three/');

rmSync(dist, { recursive: true, force: true });
const shared = { configFile: false, root: here, logLevel: 'warn', publicDir: false };
const library = (entry, external, output = {}) => ({
  ...shared,
  build: {
    target: 'es2022',
    outDir: dist,
    emptyOutDir: false,
    minify: 'oxc',
    lib: { entry, formats: ['es'], fileName: (_, name) => `${name}.js` },
    rolldownOptions: { external, output: { chunkFileNames: 'chunk-[hash].js', minify: true, ...output } },
  },
});
const source = (file) => join(here, 'src', file);
await build(
  library({ index: source('index.ts'), three: source('three/index.ts'), viewer: source('viewer/index.ts') }, isThree),
);
await build(library({ 'viewer.standalone': source('viewer/index.ts') }, [], { codeSplitting: false }));

execFileSync(process.execPath, [join(here, '../node_modules/typescript/bin/tsc'), '-p', here], { stdio: 'inherit' });
keepReachable(
  ['index.d.ts', 'three/index.d.ts', 'viewer/index.d.ts'].map((file) => join(dist, 'types/runtime/src', file)),
);
copyFileSync(join(here, '../../LICENSE'), join(here, 'LICENSE'));
writeFileSync(join(here, 'NOTICES.txt'), notices(['valibot', 'three', 'camera-controls']));

/**
 * Of the declarations, those that the entries lead to. Imports between them get the ending that Node's resolution wants.
 * @param entries paths
 */
function keepReachable(entries) {
  const kept = new Set();
  const visit = (file) => {
    if (kept.has(file)) return;
    kept.add(file);
    const text = readFileSync(file, 'utf8').replace(/(\bfrom |\bimport\()'(\.[^']+)'/g, (_, before, path) => {
      const target = join(dirname(file), `${path}.d.ts`);
      visit(target);
      return `${before}'${path}.js'`;
    });
    writeFileSync(file, text);
  };
  entries.forEach(visit);
  const types = join(dist, 'types');
  for (const file of readdirSync(types, { recursive: true, encoding: 'utf8' })) {
    if (file.endsWith('.d.ts') && !kept.has(join(types, file))) rmSync(join(types, file));
  }
}

/** What the licences of the packages that are built in ask to be handed on. */
function notices(names) {
  return names
    .map((name) => {
      const folder = join(here, '../node_modules', name);
      const { version, license } = JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8'));
      const file = readdirSync(folder).find((one) => /^licen[cs]e/i.test(one));
      return `${name} ${version} (${license})\n\n${readFileSync(join(folder, file), 'utf8').trim()}\n`;
    })
    .join(`\n${'='.repeat(100)}\n\n`);
}

/** A built file with all that it imports from beside it, gzipped one by one, as a server sends them. */
function sizeOf(file, seen = new Set()) {
  const path = join(dist, file);
  if (seen.has(path) || !existsSync(path)) return 0;
  seen.add(path);
  const text = readFileSync(path, 'utf8');
  const imports = [...text.matchAll(/\b(?:from|import)\s*["'](\.[^"']+)["']/g)].map(([, other]) => other);
  return imports.reduce(
    (sum, other) => sum + sizeOf(relative(dist, join(dirname(path), other)), seen),
    gzipSync(text).length,
  );
}
for (const [name, file] of [
  ['core', 'index.js'],
  ['with three helper', 'three.js'],
  ['viewer with three', 'viewer.standalone.js'],
]) {
  const kilobytes = (sizeOf(file) / 1e3).toFixed(1);
  process.stdout.write(
    asFigures ? `runtime,${name},kB_gzip,${kilobytes}\n` : `parsel-runtime, ${name}: ${kilobytes} kB gzip\n`,
  );
}
if (sizeOf('index.js') > coreLimit) {
  process.stderr.write(`The core of parsel-runtime is over its limit of ${coreLimit / 1e3} kB gzip.\n`);
  process.exit(1);
}
