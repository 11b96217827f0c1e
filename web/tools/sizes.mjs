// Prints what a visitor downloads, and fails when the module has outgrown its limit.
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { brotliCompressSync, gzipSync } from 'node:zlib';

const wasmLimit = 1.2e6; // bytes, brotli
const assets = join(dirname(fileURLToPath(import.meta.url)), '..', 'dist', 'assets');

let failed = false;
for (const file of readdirSync(assets).sort()) {
  if (!['.wasm', '.js', '.css'].includes(extname(file))) continue;
  const bytes = readFileSync(join(assets, file));
  const brotli = brotliCompressSync(bytes).length;
  const kilobytes = [bytes.length, gzipSync(bytes).length, brotli].map((n) => `${(n / 1e3).toFixed(0)} kB`);
  process.stdout.write(`${file}: ${kilobytes[0]}, ${kilobytes[1]} gzip, ${kilobytes[2]} brotli\n`);
  if (extname(file) === '.wasm' && brotli > wasmLimit) {
    process.stderr.write(`${file} is over its limit of ${wasmLimit / 1e6} MB brotli.\n`);
    failed = true;
  }
}
process.exit(failed ? 1 : 0);
