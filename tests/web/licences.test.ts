// Whoever hands the page on hands on what its licences ask for.
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { describe, expect, it } from 'vitest';
import { licences, packages } from '../../web/licences';

const root = fileURLToPath(new URL('../..', import.meta.url));
const text = licences();

/** Who is named, for each library that the core includes. */
const compiled: Readonly<Record<string, string>> = {
  ginac: 'GiNaC 1.8.6',
  cln: 'CLN 1.3.6',
  Eigen: 'Eigen 3',
  nlohmann: 'Copyright (c) 2013-2022 Niels Lohmann',
  'tiny_gltf.h': 'Syoyo Fujita',
  emscripten: 'Emscripten authors',
};

function included(folder: string): Set<string> {
  const files = readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' });
  const found = files
    .filter((file) => /\.(cpp|h)$/.test(file))
    .flatMap((file) => [...readFileSync(join(root, folder, file), 'utf8').matchAll(/^#include <([^>]+)>/gm)]);
  // The standard library's headers have no extension and no folder.
  return new Set(
    found.flatMap(([, path]) => (/[./]/.test(path ?? '') ? [(path as string).split('/')[0] as string] : [])),
  );
}

describe('licences.txt', () => {
  it('begins with the licence of the page and where its source is', () => {
    expect(text).toMatch(/^ParSEL is free software .* version 3 or later/);
    expect(text.slice(0, 400)).toContain('source.tar.gz');
    expect(text).toContain('GNU GENERAL PUBLIC LICENSE');
  });

  it('names every library that is compiled into the module', () => {
    const used = new Set([...included('core'), ...included('wasm')]);
    expect([...used].filter((name) => !(name in compiled))).toEqual([]);
    for (const notice of Object.values(compiled)) expect(text).toContain(notice);
    const versions = readFileSync(join(root, 'wasm/deps/sources.sha256'), 'utf8');
    for (const [, name, version] of versions.matchAll(/(cln|ginac)_([\d.]+)\.orig/g))
      expect(text.toLowerCase()).toContain(`${name} ${version}`);
  });

  it('has the text of every package that may be in the page', () => {
    const names = packages().map(({ name }) => name);
    expect(names).toEqual(expect.arrayContaining(['three', 'preact', 'draco3dgltf', 'property-graph', 'workbox-core']));
    for (const { name, version } of packages()) expect(text).toContain(`${name} ${version} (`);
    expect(text).toContain('Copyright © 2010-2026 three.js authors');
  });
});
