// A blind comparison of two variants, as in the paper's table 1: for every request two animations side by side, and which of
// them does better what was asked. Every comparison is asked twice, with the sides exchanged; the order is random; nothing
// that the page loads says which is which. A person answers the page; a model that sees pictures answers the sheets.
//
//   node tests/eval/study/make.mjs FILE [--a voted] [--b 'one go'] [--seed 1] [--out FOLDER] [--sheets]
//
// FILE: what judged_requests.mjs --json wrote. FOLDER: index.html with frames/, to be opened or served as it is; key.json,
// which score.mjs needs and who answers must not see; --sheets: sheet_<n>.png with sheet_<n>.prompt.txt, four questions each,
// both orders of a comparison never on sheets of one half; answers.mjs reads what a model replied to them.
// Where both variants look the same in every frame, nothing is asked: that is a tie.
import { createHash } from 'node:crypto';
import { copyFileSync, mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { draw, frameOf, png } from '../draw.mjs';
import { openResults, searched } from '../paper/frames.mjs';

const text = { type: 'string' };
const { values, positionals } = parseArgs({
  allowPositionals: true,
  options: {
    a: { ...text, default: 'voted' },
    b: { ...text, default: 'one go' },
    seed: { ...text, default: '1' },
    out: text,
    sheets: { type: 'boolean', default: false },
  },
});
const [file] = positionals;
if (file === undefined) throw new Error('usage: node make.mjs FILE [--a NAME] [--b NAME] [--seed N] [--out FOLDER]');
const { set, pairs } = await openResults(file);
const slug = (name) => name.replaceAll(' ', '_');
const name = `study_${set}_${slug(values.a)}_${slug(values.b)}`;
const out = values.out ?? fileURLToPath(new URL(`../../output/eval/${name}`, import.meta.url));
rmSync(out, { recursive: true, force: true });
mkdirSync(join(out, 'frames'), { recursive: true });

/** Side of a picture, and frames of an animation: from rest to the end of what the search looks at. */
const side = 320;
const count = 9;

/** Numbers in [0, 1) that a seed gives, for the same study on every machine (mulberry32). */
function random(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), state | 1);
    t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}
const next = random(Number(values.seed));
function shuffled(list) {
  const order = [...list];
  for (let i = order.length - 1; i > 0; --i) {
    const j = Math.floor(next() * (i + 1));
    [order[i], order[j]] = [order[j], order[i]];
  }
  return order;
}

/** Pictures of a row, side by side, as one. */
function strip(pictures) {
  const width = side * pictures.length;
  const all = new Uint8Array(width * side * 3);
  for (const [i, pixels] of pictures.entries())
    for (let y = 0; y < side; ++y)
      all.set(pixels.subarray(y * side * 3, (y + 1) * side * 3), (y * width + i * side) * 3);
  return { pixels: all, width };
}
const stacked = (strips) => {
  const all = new Uint8Array(strips.reduce((sum, { pixels }) => sum + pixels.length, 0));
  let at = 0;
  for (const { pixels } of strips) {
    all.set(pixels, at);
    at += pixels.length;
  }
  return all;
};

const asked = [];
const alike = [];
for (const [n, { row, at }] of pairs.entries()) {
  process.stderr.write(`\rpictures ${n + 1} of ${pairs.length}\x1b[K`);
  if (!row[values.a] || !row[values.b] || row[values.a].unclear) continue;
  const settings = (variant) => {
    const max = row[variant].program?.layers[0].parameter.max ?? 0;
    return Array.from({ length: count }, (_, i) => (i / (count - 1)) * Math.min(max, searched));
  };
  const models = [];
  for (const variant of [values.a, values.b]) {
    const list = [];
    for (const slider of settings(variant)) list.push(await at(variant, slider));
    models.push(list);
  }
  const frame = frameOf(models.flat());
  const drawn = models.map((list) => list.map((nodes) => draw(nodes, frame, side)));
  if (drawn[0].every((pixels, i) => Buffer.compare(pixels, drawn[1][i]) === 0)) alike.push(row.index);
  else asked.push({ row, drawn });
}
process.stderr.write('\n');

// Both orders of a comparison, in two rounds, so that they stand apart.
const first = shuffled(asked).map((one) => ({ ...one, swapped: next() < 0.5 }));
const second = shuffled(first.map((one) => ({ ...one, swapped: !one.swapped })));
const questions = [...first, ...second].map(({ row, drawn, swapped }, i) => {
  const sides = (swapped ? ['b', 'a'] : ['a', 'b']).map((which) => drawn[which === 'a' ? 0 : 1]);
  const files = sides.map((frames) => {
    const { pixels, width } = strip(frames);
    // The same animation has another name on the other side: names say nothing.
    const id = createHash('sha256').update(`${values.seed} ${i} ${next()}`).digest('hex').slice(0, 12);
    writeFileSync(join(out, 'frames', `${id}.png`), png(pixels, width, side));
    return `frames/${id}.png`;
  });
  return { id: `q${i + 1}`, request: row.request, left: files[0], right: files[1], swapped, index: row.index, sides };
});

const study = createHash('sha256').update(JSON.stringify([name, values.seed, questions.map(({ left }) => left)]));
const id = study.digest('hex').slice(0, 12);
const shown = questions.map(({ id: question, request, left, right }) => ({ id: question, request, left, right }));
for (const part of ['page.html', 'page.js']) {
  const as = part === 'page.html' ? 'index.html' : part;
  copyFileSync(new URL(part, import.meta.url), join(out, as));
}
const data = { study: id, frames: count, questions: shown };
writeFileSync(join(out, 'questions.js'), `globalThis.parselStudy = ${JSON.stringify(data)};\n`);
const key = questions.map(({ id: question, index, swapped }) => ({ id: question, index, left: swapped ? 'b' : 'a' }));
writeFileSync(
  join(out, 'key.json'),
  `${JSON.stringify({ study: id, set, a: values.a, b: values.b, seed: Number(values.seed), alike, key }, null, 1)}\n`,
);

/** What a sheet says to whoever knows nothing of the study. */
const sheetText = (
  part,
) => `The picture has ${part.length === 1 ? 'one row' : `${part.length} rows, from top to bottom`}, one for each request below. Every row shows a 3D model and two ways to edit it as the request asks, the left one and the right one. From left to right a row has: the model before the edit; the left edit half way and at its end; a grey field; the right edit half way and at its end. How far an edit goes is up to a slider, so that it does not matter which of the two goes farther. The models are seen from their front, their left side and above: their front looks to the lower left of the picture, their left side is on the right in the picture.

For each request: which of the two does better what was asked? Look at what was asked to change, at what was asked to stay, and at whether the parts still fit together as they did. Answer "left", "right" or, where there is no difference that matters, "same".

${part.map(({ id: question, request }, i) => `- Row ${i + 1}, ${question}: ${JSON.stringify(request)}`).join('\n')}

Say for each row in a sentence or two what you see in the left and in the right edit. Then end with exactly one JSON block, fenced with \`\`\`json and \`\`\`, with an answer for each: {${part.map(({ id: question }) => `"${question}": "left" | "right" | "same"`).join(', ')}}
`;

if (values.sheets) {
  const each = 4;
  let sheet = 0;
  for (const half of [questions.slice(0, first.length), questions.slice(first.length)]) {
    for (let start = 0; start < half.length; start += each) {
      const part = half.slice(start, start + each);
      const rows = part.map(({ sides: [left, right] }) => {
        const gap = new Uint8Array(side * side * 3).fill(120);
        return strip([left[0], left[4], left[8], gap, right[4], right[8]]);
      });
      sheet++;
      writeFileSync(join(out, `sheet_${sheet}.png`), png(stacked(rows), side * 6, side * part.length));
      writeFileSync(join(out, `sheet_${sheet}.prompt.txt`), sheetText(part));
    }
  }
}
process.stdout.write(
  `${questions.length} questions, ${alike.length} comparisons that look alike: ${join(out, 'index.html')}\n`,
);
