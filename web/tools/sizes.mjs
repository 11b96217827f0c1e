// Prints what a visitor downloads, and fails when the module or the JavaScript of the first sight have outgrown their
// limits. --figures: as figures of the benchmarks (tests/bench/compare.mjs) instead.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, gzipSync } from 'node:zlib';

/** Of WebAssembly, by the beginning of a file's name: bytes, brotli. The first is what the page begins with. */
const wasmLimits = {
  'parsel-': 1.3e6,
  'parsel_cad-': 0.76e6,
  'manifold-': 0.2e6,
  'poisson-': 0.1e6,
  'draco_decoder_gltf-': 0.1e6,
};
const firstLimit = 350e3; // bytes, gzip
const asFigures = process.argv.includes('--figures');
const say = (line) => asFigures || process.stdout.write(`${line}\n`);
const figure = (line) => asFigures && process.stdout.write(`${line}\n`);
const dist = join(dirname(fileURLToPath(import.meta.url)), '..', 'dist');
const assets = join(dist, 'assets');

let failed = false;
for (const file of readdirSync(assets).sort()) {
  if (!['.wasm', '.js', '.css'].includes(extname(file))) continue;
  const bytes = readFileSync(join(assets, file));
  const brotli = brotliCompressSync(bytes).length;
  const kilobytes = [bytes.length, gzipSync(bytes).length, brotli].map((n) => `${(n / 1e3).toFixed(0)} kB`);
  say(`${file}: ${kilobytes[0]}, ${kilobytes[1]} gzip, ${kilobytes[2]} brotli`);
  if (file.startsWith('parsel-') && extname(file) === '.wasm')
    figure(`page,WebAssembly module,kB_brotli,${(brotli / 1e3).toFixed(1)}`);
  if (file.startsWith('parsel_cad-')) figure(`page,WebAssembly of CAD programs,kB_brotli,${(brotli / 1e3).toFixed(1)}`);
  if (extname(file) !== '.wasm') continue;
  const limit = Object.entries(wasmLimits).find(([name]) => file.startsWith(name))?.[1] ?? 0;
  if (brotli > limit) {
    process.stderr.write(`${file} is over its limit of ${limit / 1e6} MB brotli.\n`);
    failed = true;
  }
}
const html = readFileSync(join(dist, 'index.html'), 'utf8');
const first = [...html.matchAll(/"\.\/(assets\/[^"]+\.js)"/g)].map(([, path]) =>
  gzipSync(readFileSync(join(dist, path))),
);
const firstSize = first.reduce((sum, { length }) => sum + length, 0);
say(`JavaScript before anything shows: ${(firstSize / 1e3).toFixed(0)} kB gzip`);
figure(`page,initial JavaScript,kB_gzip,${(firstSize / 1e3).toFixed(1)}`);
if (firstSize > firstLimit) {
  process.stderr.write(`That is over its limit of ${firstLimit / 1e3} kB gzip.\n`);
  failed = true;
}
process.exit(failed ? 1 : 0);
