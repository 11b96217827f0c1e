// Writes web/public/recordings/<model>.json: what the page offers without a key, and the recorded replies to it.
import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { loadCore, root } from './core.mjs';
import { fusedIds, namelessIds } from './nameless.mjs';
import { compare, readRecordings, renderAll } from './prompts.mjs';

const folder = join(root, 'web', 'public', 'recordings');
const core = await loadCore();
const recordings = readRecordings();
const { offered, missing } = compare(renderAll(core, recordings), recordings);
if (missing.length > 0)
  process.stderr.write(`${missing.length} prompts have no recording: node web/tools/record.mjs lists them.\n`);

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
// Every model has a file, an empty one too: the page asks for it, and a missing file is an error in the console.
const ids = [
  ...core('gallery', {}).result.models.map(({ id }) => id),
  ...core('cad_gallery', {}).result.programs.map(({ id }) => `${id}_program`),
  ...namelessIds.map((id) => `${id}_nameless`),
  ...fusedIds.map((id) => `${id}_fused`),
];
for (const id of ids) {
  const own = offered.filter(({ model }) => model === id);
  const used = own.flatMap(({ prompts }) => prompts.map(({ hash }) => recordings.get(hash)));
  writeFileSync(
    join(folder, `${id}.json`),
    JSON.stringify({
      // What is proposed is found by its prompts alone.
      requests: own
        .filter(({ task }) => task === undefined)
        .map(({ request, mentioned, suggest }) => ({ request, mentioned, suggest })),
      replies: Object.fromEntries(used.map(({ hash, replies }) => [hash, replies.map(({ text }) => text)])),
      models: [...new Set(used.map((recording) => recording.model))],
    }),
  );
}
