// Where the slider stands when a pair of the paper is judged: the pairs say "where the seed has moved by about 0.2
// half-diagonals, for turns by about 0.2 rad", so that a thin leg that gets thicker is judged where one sees it.
import { halfDiagonal } from '../predicates.mjs';

export const judgedAt = 0.2;
const steps = 20;

/** The nodes that a part or a group, by its id or as node:<index>, stands for. */
function nodesOf(shape, seed) {
  const nodes = new Map(shape.parts.filter((part) => !part.virtual).map(({ id, node }) => [id, `node:${node}`]));
  const group = shape.relations.find(({ id, parent }) => id === seed.relation || (parent && parent === seed.part));
  if (group) return group.parts.map((id) => nodes.get(id));
  return [nodes.get(seed.part) ?? seed.part];
}

function shifted(rest, now, nodes) {
  const far = nodes.flatMap((node) => {
    const [before, after] = [rest.get(node)?.points, now.get(node)?.points];
    if (!before || before.length !== after?.length) return [];
    return before.map((p, i) => Math.hypot(...[0, 1, 2].map((k) => after[i][k] - p[k])));
  });
  return far.reduce((most, one) => Math.max(most, one), 0) / halfDiagonal(rest);
}

/**
 * @param rest readNodes() of the model. @param seed statements. @param max the slider's end
 * @param at slider → readNodes() of the model there
 * @returns a value of the slider, above 0 and at most max
 */
export async function sliderAt(shape, rest, seed, max, at) {
  const turns = seed.some(({ op }) => op === 'rotate');
  const nodes = seed.flatMap((one) => nodesOf(shape, one));
  if (turns || seed.some(({ op }) => op.startsWith('change')) || nodes.length === 0) return Math.min(judgedAt, max);
  if (shifted(rest, await at(max), nodes) <= judgedAt) return max;
  let [low, high] = [0, max];
  for (let step = 0; step < steps; ++step) {
    const middle = (low + high) / 2;
    if (shifted(rest, await at(middle), nodes) < judgedAt) low = middle;
    else high = middle;
  }
  return high;
}
