// Checks (or with --write fixes) the layout of all C++ files with the clang-format that package.json pins, so that every
// machine agrees on it.
import { execFileSync, spawnSync } from 'node:child_process';
import { createRequire } from 'node:module';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..', '..');
const clangFormat = createRequire(import.meta.url).resolve('clang-format/index.js');
const files = execFileSync('git', ['ls-files', '--cached', '--others', '--exclude-standard', '*.cpp', '*.h'], {
  cwd: root,
  encoding: 'utf8',
})
  .split('\n')
  .filter((file) => file !== '' && !file.startsWith('wasm/deps/'));

const mode = process.argv.includes('--write') ? ['-i'] : ['--dry-run', '--Werror'];
const { status } = spawnSync(process.execPath, [clangFormat, ...mode, ...files], { cwd: root, stdio: 'inherit' });
if (status !== 0) {
  process.stderr.write('C++ layout differs from .clang-format: run `npm run format` in web/.\n');
  process.exit(1);
}
