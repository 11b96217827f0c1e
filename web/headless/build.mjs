// Builds the package parsel-headless into web/headless/dist, from the core that CMake left in build/wasm.
//   node web/headless/build.mjs
import { chmodSync, copyFileSync, existsSync, readFileSync, rmSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { build, runnerImport } from 'vite';

const here = fileURLToPath(new URL('.', import.meta.url));
const root = join(here, '../..');
const dist = join(here, 'dist');
const core = ['parsel-tool.cjs', 'parsel-tool.wasm'].map((file) => [join(root, 'build/wasm/wasm', file), file]);
for (const [path] of core) {
  if (existsSync(path)) continue;
  process.stderr.write(`${path} is not there: ./web/start.sh --build-only makes it.\n`);
  process.exit(1);
}

rmSync(dist, { recursive: true, force: true });
const source = (file) => join(here, 'src', file);
await build({
  configFile: false,
  root: here,
  logLevel: 'warn',
  publicDir: false,
  build: {
    ssr: true,
    target: 'node20',
    outDir: dist,
    minify: false,
    rolldownOptions: {
      input: { parsel: source('parsel.ts'), job_process: source('job_process.ts') },
      output: { entryFileNames: '[name].js', chunkFileNames: '[name]-[hash].js' },
    },
  },
});
for (const [path, file] of core) copyFileSync(path, join(dist, file));
chmodSync(join(dist, 'parsel.js'), 0o755);

// What the licences ask of whoever hands the package on.
const { module } = await runnerImport(join(here, '../licences.ts'), { configFile: false, logLevel: 'error' });
writeFileSync(join(dist, 'source.tar.gz'), module.source());
copyFileSync(join(root, 'LICENSE'), join(here, 'LICENSE'));
const notices = readFileSync(join(root, 'wasm/NOTICES.txt'), 'utf8').split('\n').slice(1).join('\n').trim();
writeFileSync(
  join(here, 'NOTICES.txt'),
  `ParSEL is free software under the GNU General Public License, version 3 or later (LICENSE). Its source is
dist/source.tar.gz. What is compiled into dist/parsel-tool.wasm, each under its own licence:

${notices}
`,
);
const megabytes = (file) => (statSync(join(dist, file)).size / 1e6).toFixed(1);
process.stdout.write(`parsel-headless: ${megabytes('parsel-tool.wasm')} MB of WebAssembly\n`);
