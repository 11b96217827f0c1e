// Which relations of a model are still there after an edit, seen on the two meshes alone: one ruler for programs that were
// propagated and for programs that a language model wrote, which report nothing. Joints, mirror images and standing on
// the ground, between parts that are nodes; rows and what virtual parts stand for are left out, as their instances'
// joints are counted. Tolerances are those of predicates.mjs.
import { gap, halfDiagonal, smallest } from './predicates.mjs';

const centre = (points) =>
  [0, 1, 2].map((k) => (Math.min(...points.map((p) => p[k])) + Math.max(...points.map((p) => p[k]))) / 2);
const lowest = (points) => Math.min(...points.map((p) => p[1]));

/** The greatest distance from a corner of `a`'s mirror image to the nearest one of `b`. */
function asymmetry(a, b, normal, through) {
  const length = Math.hypot(...normal);
  const n = normal.map((v) => v / length);
  const image = a.map((p) => {
    const off = [0, 1, 2].reduce((sum, k) => sum + (p[k] - through[k]) * n[k], 0);
    return p.map((v, k) => v - 2 * off * n[k]);
  });
  return Math.max(...image.map((p) => Math.min(...b.map((q) => Math.hypot(...[0, 1, 2].map((k) => p[k] - q[k]))))));
}

/**
 * @param shape as the core gives it. @param rest, now from readNodes()
 * @param givenUp ids of relations that are not asked about: the request gives them up
 * @returns {kept, of, lost: [ids]}; of parts that a count took away nothing is asked
 */
export function keptRelations(shape, rest, now, givenUp = []) {
  const unit = halfDiagonal(rest);
  const nodes = new Map(shape.parts.filter((part) => !part.virtual).map(({ id, node }) => [id, `node:${node}`]));
  const lost = [];
  let of = 0;
  for (const { id, kind, parts, normal } of shape.relations) {
    if (givenUp.includes(id) || kind === 'translation' || kind === 'rotation') continue;
    const before = parts.map((part) => rest.get(nodes.get(part))?.points);
    const after = parts.map((part) => now.get(nodes.get(part))?.points);
    if ([...before, ...after].some((points) => points === undefined)) continue;
    of++;
    const [a, b] = after;
    let kept;
    if (kind === 'ground') kept = Math.abs(lowest(a) - lowest(before[0])) <= smallest.gap * unit;
    else if (kind === 'reflection') {
      const [one, other] = before.map(centre);
      const middle = one.map((v, k) => (v + other[k]) / 2);
      const was = asymmetry(...before, normal, middle);
      kept = asymmetry(a, b, normal, middle) <= Math.max(smallest.mirror * unit, was + smallest.rest * unit);
    } else kept = gap(a, b) <= Math.max(smallest.gap * unit, gap(...before) + smallest.rest * unit);
    if (!kept) lost.push(id);
  }
  return { kept: of - lost.length, of, lost };
}
