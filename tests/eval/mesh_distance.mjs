// How far a model under one program is from the same model under another, wherever their sliders stand.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { root } from '../../web/tools/core.mjs';

const { runnerImport } = await import(createRequire(join(root, 'web', 'package.json')).resolve('vite'));
const load = async (file) => (await runnerImport(join(root, 'web', 'src', 'program', file))).module;
const { checkProgram } = await load('check.ts');
const { interpretProgram } = await load('interpret.ts');

/** Boxes of all parts and instances at a slider value, centred: [{label, corners}]. */
function boxes(shape, checked, x) {
  const { parts, groups } = interpretProgram(checked, shape, [x]);
  const found = [];
  const grouped = new Set();
  for (const [index, relation] of shape.relations.entries()) {
    if (groups[index] === null) continue;
    const { label } = shape.parts.find(({ id }) => id === relation.parts[0]);
    for (const id of relation.parts) grouped.add(id);
    for (const corners of groups[index].instances) found.push({ label, corners });
  }
  for (const [index, part] of shape.parts.entries()) {
    if (!part.virtual && !grouped.has(part.id)) found.push({ label: part.label, corners: parts[index] });
  }
  const all = found.flatMap(({ corners }) => corners);
  const middle = [0, 1, 2].map((i) => (Math.max(...all.map((c) => c[i])) + Math.min(...all.map((c) => c[i]))) / 2);
  return found.map(({ label, corners }) => ({ label, corners: corners.map((c) => c.map((v, i) => v - middle[i])) }));
}

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
const apart = (a, b) => Math.max(...a.map((corner) => Math.min(...b.map((other) => distance(corner, other)))));
const farthest = (from, to) =>
  Math.max(
    ...from.map(({ label, corners }) =>
      Math.min(Infinity, ...to.filter((box) => box.label === label).map((box) => apart(corners, box.corners))),
    ),
  );
/** Hausdorff distance over boxes of the same label. */
const difference = (a, b) => (a.length === b.length ? Math.max(farthest(a, b), farthest(b, a)) : Infinity);

/** Both programs were looked for on ± this; how far each slider then goes on is its own. */
const searched = 0.35;

/**
 * Least distance of the model under a program, over its slider, from the one under the true program at 0.6 of `searched`.
 * Both have one layer and are valid for the shape. Normalised; Infinity when the numbers of parts never agree.
 */
export function meshDistance(shape, program, truth) {
  const checkedTruth = checkProgram(truth, shape).value;
  const { max, min } = truth.layers[0].parameter;
  const aim = boxes(shape, checkedTruth, 0.6 * (max >= -min ? Math.min(max, searched) : Math.max(min, -searched)));
  const checked = checkProgram(program, shape).value;
  const { min: low, max: high } = program.layers[0].parameter;
  const at = (x) => difference(boxes(shape, checked, x), aim);
  let best = { x: 0, by: Infinity };
  for (let i = 0; i <= 80; ++i) {
    const x = low + ((high - low) * i) / 80;
    const by = at(x);
    if (by < best.by) best = { x, by };
  }
  for (let step = (high - low) / 160; step > 1e-5; step /= 2) {
    for (const x of [best.x - step, best.x + step]) {
      if (x < low || x > high) continue;
      const by = at(x);
      if (by < best.by) best = { x, by };
    }
  }
  return best.by;
}
