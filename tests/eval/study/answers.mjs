// The answers that a model gave to the sheets of a study, as score.mjs reads them.
//   node tests/eval/study/answers.mjs STUDY --by NAME > ANSWERS.json
// STUDY: the folder that make.mjs --sheets wrote, with sheet_<n>.reply.txt beside each sheet_<n>.prompt.txt, unedited.
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseArgs } from 'node:util';

const { values, positionals } = parseArgs({ allowPositionals: true, options: { by: { type: 'string' } } });
const [folder] = positionals;
if (folder === undefined || !values.by) throw new Error('usage: node answers.mjs STUDY --by NAME');

const { study } = JSON.parse(readFileSync(join(folder, 'key.json'), 'utf8'));
const answers = {};
for (const prompt of readdirSync(folder).filter((name) => /^sheet_\d+\.prompt\.txt$/.test(name))) {
  const name = prompt.replace('.prompt.', '.reply.');
  const reply = existsSync(join(folder, name)) ? readFileSync(join(folder, name), 'utf8') : '';
  const block = /```json\s*([\s\S]*?)```\s*$/.exec(reply)?.[1];
  if (block === undefined) process.stderr.write(`${name}: no answers\n`);
  else Object.assign(answers, JSON.parse(block));
}
process.stdout.write(
  `${JSON.stringify({ format: 'parsel/study', version: 1, study, by: values.by, answers }, null, 1)}\n`,
);
