// How far OpenSCAD programs of other people open: fully (every part is a box, cylinder, cone or sphere), in part (of some only
// the box is known) or not at all, and why. Needs build/native-debug and Debian's openscad, for its examples; or folders of
// other programs:
//   node tests/eval/openscad.mjs [FOLDER…]
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const tool = join(dirname(fileURLToPath(import.meta.url)), '../../build/native-debug/core/parsel');
const examples = '/usr/share/openscad/examples';
const folders = process.argv.length > 2 ? process.argv.slice(2) : [examples];
const work = mkdtempSync(join(tmpdir(), 'parsel-openscad-'));
process.on('exit', () => rmSync(work, { recursive: true }));

/** What a refusal or a warning is about, without its file and place. */
const reason = (line, path) =>
  line
    .replace(/^(warning|cad\/read): /, '')
    .replace(path, '')
    .replace(/^,? ?line \d+, column \d+/, '')
    .replace(/^: /, '')
    .replace(/; [^;]*$/, '')
    .replace(/: it has no parameters that a family could vary$|: only its box is known$/, '')
    .replace(/\.$/, '');

function tried(path) {
  const json = join(work, 'parts.json');
  const start = performance.now();
  const { status, stderr } = spawnSync(tool, ['cad', path, '-o', json], { encoding: 'utf8', timeout: 60_000 });
  const seconds = (performance.now() - start) / 1000;
  const lines = stderr.split('\n').filter((line) => /^(warning|cad\/read): /.test(line));
  if (status !== 0)
    return { opens: 'not at all', seconds, why: lines[0] ? reason(lines[0], path) : `ended with ${status}` };
  const { parts } = JSON.parse(readFileSync(json, 'utf8'));
  const boxed = parts.filter(({ kind }) => kind === 'opaque').length;
  const whys = [...new Set(lines.map((line) => reason(line, path)))];
  if (boxed > 0) return { opens: 'in part', seconds, parts: parts.length, boxed, why: whys.join('; ') };
  return { opens: 'fully', seconds, parts: parts.length, boxed, why: whys.join('; ') };
}

const results = folders.flatMap((folder) =>
  readdirSync(folder, { recursive: true, encoding: 'utf8' })
    .filter((name) => name.endsWith('.scad'))
    .sort()
    .map((name) => ({ name, ...tried(join(folder, name)) })),
);
process.stdout.write('| program | opens | parts | why |\n|---|---|---|---|\n');
for (const { name, opens, parts = '', boxed = 0, why } of results) {
  const count = boxed > 0 ? `${parts}, ${boxed} as boxes` : parts;
  process.stdout.write(`| ${basename(name, '.scad')} | ${opens} | ${count} | ${why} |\n`);
}
const count = (kind) => results.filter(({ opens }) => opens === kind).length;
const slowest = Math.max(...results.map(({ seconds }) => seconds));
process.stdout.write(
  `\n${results.length} programs: ${count('fully')} fully, ${count('in part')} in part, ${count('not at all')} not at all; ` +
    `the slowest took ${slowest.toFixed(1)} s with sanitizers\n`,
);
