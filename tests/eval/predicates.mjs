// Judges an edited model by predicates that were written down before anything was run: what should have changed, what
// should not, what should still touch. It reads the two files and knows nothing of programs, so it is independent of what
// it judges.
//
// A predicate is one of
//   {"part", "measure", "change": "increase" | "decrease" | "none", "tol"?}
//   {"part", "measure", "by" | "to" | "times": number}                           in the file's units, or as a ratio
//   {"pair": [part, part], "touching": true | false}
//   {"pair": [part, part], "mirror": "x" | "y" | "z", "holds": true | false}     about the middle of the two at rest
//   {"group": name, "change": "increase" | "decrease"}                           how many nodes have that name, its number aside
//   {"group": name, "by" | "to": number}                                         likewise
//   {"any_of": [[predicate…], …]}                                                all of at least one list
// part: "node:<index>", a node's name or "whole". measure: "any" (the largest shift of a vertex), "<side>_face" (of those on one
// side), "<size|min|max|center>_<axis>", "<side>_<min|max|center>_<axis>"; side: left, right, top, bottom, front, back.
// The object's own left is +x, top +y, front +z. Lengths are in half-diagonals of the model at rest.
import { createRequire } from 'node:module';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root } from '../../web/tools/core.mjs';

const inWeb = createRequire(join(root, 'web', 'package.json'));
const { NodeIO } = await import(pathToFileURL(inWeb.resolve('@gltf-transform/core')).href);
const { ALL_EXTENSIONS } = await import(pathToFileURL(inWeb.resolve('@gltf-transform/extensions')).href);

const sides = { left: [0, 1], right: [0, -1], top: [1, 1], bottom: [1, -1], front: [2, 1], back: [2, -1] };
/** Less than this is no change, and more than the first no touching; the paper's delta is 0.0433. */
export const smallest = { change: 0.01, rest: 0.005, gap: 0.02, mirror: 0.015 };

/** @returns Map of "node:<index>" → {name, points: [[x, y, z]], triangles: [i, j, k, …]}, of all nodes with a mesh, in the
 * world's frame */
export async function readNodes(glb) {
  const document = await new NodeIO().registerExtensions(ALL_EXTENSIONS).readBinary(new Uint8Array(glb));
  const found = new Map();
  const shown = new Set();
  document
    .getRoot()
    .getDefaultScene()
    ?.traverse((node) => shown.add(node));
  for (const [index, node] of document.getRoot().listNodes().entries()) {
    if (!shown.has(node)) continue; // an instance that a count took away
    const m = node.getWorldMatrix();
    const points = [];
    const triangles = [];
    for (const primitive of node.getMesh()?.listPrimitives() ?? []) {
      const positions = primitive.getAttribute('POSITION');
      const indices = primitive.getIndices()?.getArray() ?? Array.from({ length: positions.getCount() }, (_, i) => i);
      for (const i of indices) triangles.push(points.length + i);
      for (let i = 0; i < positions.getCount(); ++i) {
        const [x, y, z] = positions.getElement(i, []);
        points.push([0, 1, 2].map((k) => m[k] * x + m[4 + k] * y + m[8 + k] * z + m[12 + k]));
      }
    }
    if (points.length > 0) found.set(`node:${index}`, { name: node.getName(), points, triangles });
  }
  return found;
}

const least = (points, k) => points.reduce((best, p) => Math.min(best, p[k]), Infinity);
const most = (points, k) => points.reduce((best, p) => Math.max(best, p[k]), -Infinity);

/** Half the diagonal of the box around all nodes. */
export function halfDiagonal(nodes) {
  const all = [...nodes.values()].flatMap(({ points }) => points);
  return Math.hypot(...[0, 1, 2].map((k) => most(all, k) - least(all, k))) / 2;
}

/** Which vertices lie on a side: of a box the four corners, also when it leans; else those within 2 % of the end. */
function onSide(points, [axis, sign]) {
  const order = points.map((p, i) => [sign * p[axis], i]).sort((a, b) => b[0] - a[0]);
  if (points.length === 8) return order.slice(0, 4).map(([, i]) => i);
  const reach = order[0][0] - 0.02 * (order[0][0] - order.at(-1)[0]);
  return order.filter(([at]) => at >= reach).map(([, i]) => i);
}

const shift = (rest, now, which) =>
  Math.max(...which.map((i) => Math.hypot(...[0, 1, 2].map((k) => now[i][k] - rest[i][k]))));

/** A measure of a part; `rest` says which vertices are meant. */
function measured(rest, now, measure) {
  const words = measure.split('_');
  if (measure === 'any') return shift(rest, now, [...rest.keys()]);
  if (words[1] === 'face') return shift(rest, now, onSide(rest, sides[words[0]]));
  const points = words.length === 3 ? onSide(rest, sides[words.shift()]).map((i) => now[i]) : now;
  const [what, axis] = words;
  const k = 'xyz'.indexOf(axis);
  const [low, high] = [least(points, k), most(points, k)];
  const values = { size: high - low, min: low, max: high, center: (low + high) / 2 };
  if (k < 0 || !(what in values)) throw new Error(`There is no measure '${measure}'.`);
  return values[what];
}

/** Distance of two convex hulls: Gilbert's algorithm on the difference of the two (SIAM J. Control 4, 1966). */
export function gap(a, b) {
  const support = (points, d) => {
    let best = points[0];
    let reach = -Infinity;
    for (const p of points) {
      const along = p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
      if (along > reach) [best, reach] = [p, along];
    }
    return best;
  };
  const difference = (p, q) => p.map((x, k) => x - q[k]);
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  let x = difference(a[0], b[0]);
  for (let round = 0; round < 2000; ++round) {
    const away = x.map((v) => -v);
    const s = difference(support(a, away), support(b, x));
    const step = difference(s, x);
    if (-dot(x, step) <= 1e-6 * (dot(x, x) + 1e-12)) break;
    const t = Math.min(1, -dot(x, step) / dot(step, step));
    x = x.map((v, k) => v + t * step[k]);
  }
  return Math.sqrt(dot(x, x));
}

/** What a measure shall be that was `rest`; null when the predicate names no number. */
function wantedOf({ by, to, times }, rest) {
  if (to !== undefined) return to;
  return by !== undefined ? rest + by : times !== undefined ? rest * times : null;
}

/**
 * @param rest, now from readNodes()
 * @param share a size that changes by this share of itself has changed, however little that is of the whole: for thin parts
 * @returns {ok, why}
 */
export function judge(predicate, rest, now, share = Infinity) {
  const unit = halfDiagonal(rest);
  const find = (nodes, part) => {
    if (part === 'whole') return [...nodes.values()].flatMap(({ points }) => points);
    const node = nodes.get(part) ?? [...nodes.values()].find(({ name }) => name === part);
    if (node === undefined) throw new Error(`there is no part '${part}'`);
    return node.points;
  };
  if ('any_of' in predicate) {
    const results = predicate.any_of.map((list) => list.every((one) => judge(one, rest, now, share).ok));
    return { ok: results.includes(true), why: results.join(', ') };
  }
  if ('group' in predicate) {
    const count = (nodes) =>
      [...nodes.values()].filter(({ name }) => name.replace(/[ _.]\d+$/, '') === predicate.group).length;
    const [before, after] = [count(rest), count(now)];
    const wanted = wantedOf(predicate, before);
    if (wanted !== null) return { ok: after === wanted, why: `${before} -> ${after}` };
    return { ok: predicate.change === 'increase' ? after > before : after < before, why: `${before} -> ${after}` };
  }
  if ('touching' in predicate) {
    const [a, b] = predicate.pair;
    const before = gap(find(rest, a), find(rest, b)) / unit;
    const after = gap(find(now, a), find(now, b)) / unit;
    const touches = after <= Math.max(smallest.gap, before + smallest.rest);
    return { ok: touches === predicate.touching, why: `gap ${before.toFixed(3)} -> ${after.toFixed(3)}` };
  }
  if ('mirror' in predicate) {
    const k = 'xyz'.indexOf(predicate.mirror);
    const middle = (points) => (least(points, k) + most(points, k)) / 2;
    const [a, b] = predicate.pair.map((part) => find(now, part));
    const centre = (middle(find(rest, predicate.pair[0])) + middle(find(rest, predicate.pair[1]))) / 2;
    const image = a.map((p) => p.map((x, i) => (i === k ? 2 * centre - x : x)));
    const off = image.map((p) => Math.min(...b.map((q) => Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]))));
    const worst = Math.max(...off) / unit;
    return { ok: worst <= smallest.mirror === predicate.holds, why: `off ${worst.toFixed(3)}` };
  }
  const { part, measure, change, tol = smallest.rest } = predicate;
  const [before, after] = [find(rest, part), find(now, part)];
  if (before.length !== after.length) return { ok: false, why: 'another mesh' };
  const moved = measure === 'any' || measure.endsWith('_face');
  const start = moved ? 0 : measured(before, before, measure);
  const wanted = wantedOf(predicate, start);
  if (wanted !== null) {
    const off = (measured(before, after, measure) - wanted) / unit;
    return { ok: Math.abs(off) <= smallest.rest, why: `off ${off.toFixed(3)}` };
  }
  const by = (measured(before, after, measure) - start) / unit;
  const isThin = measure.startsWith('size') && Number.isFinite(share);
  const seen = isThin ? Math.min(smallest.change, (share * start) / unit) : smallest.change;
  const right = { increase: by > seen, decrease: by < -seen, none: Math.abs(by) <= tol }[change];
  if (right === undefined) throw new Error(`There is no change '${change}'.`);
  return { ok: right, why: `${by >= 0 ? '+' : ''}${by.toFixed(3)}` };
}
