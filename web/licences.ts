// What the licences ask of whoever hands the page on: their texts, the notices of everything that is built into it, and
// its source. The build puts licences.txt and source.tar.gz beside the page, which links to both.
import { execFileSync } from 'node:child_process';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import type { Plugin } from 'vite';

const root = fileURLToPath(new URL('..', import.meta.url));
const modules = join(root, 'web/node_modules');

/** What the service worker is made of, by way of vite-plugin-pwa. */
const ofTheServiceWorker = ['workbox-core', 'workbox-precaching', 'workbox-routing', 'workbox-strategies'];
/** Whose dependencies are for a tool of theirs that the page does not use. */
const withTools: readonly string[] = ['manifold-3d'];
/** For packages that name their licence but bring no text. */
const texts: Readonly<Record<string, string>> = { 'Apache-2.0': 'web/tools/apache-2.0.txt' };

interface Manifest {
  readonly name: string;
  readonly version: string;
  readonly license?: string;
  readonly author?: string | { readonly name?: string };
  readonly dependencies?: Readonly<Record<string, string>>;
}

const manifestOf = (folder: string) => JSON.parse(readFileSync(join(folder, 'package.json'), 'utf8')) as Manifest;

/** Every package that may be in the page: its dependencies, and theirs. */
export function packages(): readonly Manifest[] {
  const found = new Map<string, Manifest>();
  const visit = (name: string) => {
    const folder = join(modules, name);
    if (found.has(name) || !existsSync(folder)) return;
    const manifest = manifestOf(folder);
    found.set(name, manifest);
    if (withTools.includes(name)) return;
    for (const other of Object.keys(manifest.dependencies ?? {})) visit(other);
  };
  for (const name of Object.keys(manifestOf(join(root, 'web')).dependencies ?? {})) visit(name);
  for (const name of ofTheServiceWorker) visit(name);
  return [...found.values()].sort((a, b) => a.name.localeCompare(b.name));
}

/** A package's licence, its own text where it brings one. Throws when there is none: the page could not be handed on. */
function noticeOf({ name, version, license = 'no licence named', author }: Manifest): string {
  const folder = join(modules, name);
  const files = readdirSync(folder).filter((file) => /^(licen[cs]e|copying|notice)/i.test(file));
  const by = typeof author === 'string' ? author : author?.name;
  const own = files.map((file) => readFileSync(join(folder, file), 'utf8').trim());
  const general = texts[license];
  if (own.length === 0 && general === undefined) throw new Error(`${name} has no licence text: add it to licences.ts`);
  const text = own.length > 0 ? own.join('\n\n') : readFileSync(join(root, general as string), 'utf8').trim();
  return `${name} ${version} (${license})${own.length > 0 || by === undefined ? '' : `, by ${by}`}\n\n${text}`;
}

/** The licence of the page, and the notices of all that is in it. */
export function licences(): string {
  const line = `\n\n${'='.repeat(100)}\n\n`;
  const own = readFileSync(join(root, 'LICENSE'), 'utf8').trim();
  const intro =
    'ParSEL is free software under the GNU General Public License, version 3 or later. Its source is source.tar.gz\n' +
    'beside this file. Below: that licence, then the notices of the libraries in the page, each under its own licence.';
  const compiled = readFileSync(join(root, 'wasm/NOTICES.txt'), 'utf8').trim();
  return `${[intro, own, compiled, ...packages().map(noticeOf)].join(line)}\n`;
}

/** What the page was built from, as a .tar.gz: as it stands in the working tree, without what the build makes. */
export function source(): Uint8Array {
  const run = (command: string, ...args: string[]) =>
    execFileSync(command, args, { cwd: root, maxBuffer: 256 * 2 ** 20, stdio: ['ignore', 'pipe', 'ignore'] });
  // In a checkout git knows what belongs to it; without one, the folder is what was handed on.
  const files = existsSync(join(root, '.git'))
    ? run('git', 'ls-files', '-z')
        .toString()
        .split('\0')
        .filter((file) => file !== '' && existsSync(join(root, file)))
    : ['.'];
  const made = ['node_modules', './build', './web/dist', './web/public/wasm', './web/public/gallery'];
  return run('tar', '-cz', ...made.map((path) => `--exclude=${path}`), '--', ...files);
}

export function licencePlugin(): Plugin {
  return {
    name: 'licences',
    apply: 'build',
    generateBundle() {
      this.emitFile({ type: 'asset', fileName: 'licences.txt', source: licences() });
      this.emitFile({ type: 'asset', fileName: 'source.tar.gz', source: source() });
    },
  };
}
