// No file of the core and the page is longer than one reads at a sitting. Run by `npm run lint`. A file that is longer for a
// reason says it in the comment at its top, in a sentence with "in one file because".
import { readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { argv } from 'node:process';
import { fileURLToPath } from 'node:url';

const root = join(dirname(fileURLToPath(import.meta.url)), '..');
const mostLines = 400;
const folders = ['core', 'web/src', 'web/runtime/src', 'web/headless/src'];
/** Too long, and to be divided when they next change: nothing may be added here. */
const undivided = [];

/** The comment that a file begins with, else ''. */
function openingComment(text) {
  return /^(?:\s*(?:\/\/.*\n|\/\*[\s\S]*?\*\/))*/.exec(text)?.[0] ?? '';
}

/** @param file its path from the root of the repository */
export function lengthFaults(file, text, exempt = undivided) {
  const lines = text.split('\n').length - 1;
  const reason = /\bin one file because\b/i.test(openingComment(text).replace(/\s*\n\s*(?:\/\/|\*)?\s*/g, ' '));
  if (lines > mostLines && !reason && !exempt.includes(file))
    return [
      `${file}: ${lines} lines, more than ${mostLines}: divide it by what its parts do, or say at its top why it is ` +
        'all "in one file because …"',
    ];
  if (lines <= mostLines && exempt.includes(file))
    return [`${file}: ${lines} lines: take it off the list in tests/check_lengths.mjs`];
  return [];
}

if (argv[1] === fileURLToPath(import.meta.url)) {
  const files = folders.flatMap((folder) =>
    readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' })
      .filter((file) => /\.(h|cpp|js|mjs|tsx?|css)$/.test(file))
      .map((file) => `${folder}/${file}`),
  );
  const faults = files.flatMap((file) => lengthFaults(file, readFileSync(join(root, file), 'utf8')));
  if (faults.length > 0) {
    process.stderr.write(`${faults.join('\n')}\n`);
    process.exit(1);
  }
}
