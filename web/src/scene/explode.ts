// The exploded view: every part moved away from the middle of the shape, as it is drawn and picked, not as it is edited.
import type { Evaluator, GroupView } from '../program/compile';
import type { CageShape } from '../program/types';

const reach = 0.6;

/** What is drawn of an evaluator. */
export type State = Pick<Evaluator, 'corners' | 'groups'>;

/**
 * A state whose parts and instances stand farther from the middle of the shape than they do.
 * @param amount 0 … 1: as they are … 1 + reach times as far
 */
export function explode(shape: CageShape, { corners, groups }: State, amount: number): State {
  const middle = [0, 0, 0];
  const real = shape.parts.filter(({ virtual }) => !virtual).length;
  for (const [part, { virtual }] of shape.parts.entries()) {
    if (virtual) continue;
    for (let i = 0; i < 24; i++) middle[i % 3] = (middle[i % 3] ?? 0) + (corners[part * 24 + i] ?? 0) / 8 / real;
  }
  return {
    corners: apart(corners, shape.parts.length, middle, amount),
    groups: groups.map(
      (group): GroupView | null =>
        group && {
          relation: group.relation,
          count: group.count,
          source: group.source,
          points: group.points,
          instances: apart(group.instances, group.count, middle, amount),
        },
    ),
  };
}

function apart(corners: Float64Array, boxes: number, middle: readonly number[], amount: number): Float64Array {
  const moved = corners.slice();
  for (let at = 0; at < boxes * 24; at += 24) {
    for (let axis = 0; axis < 3; axis++) {
      let centre = 0;
      for (let i = axis; i < 24; i += 3) centre += (corners[at + i] ?? 0) / 8;
      for (let i = axis; i < 24; i += 3)
        moved[at + i] = (corners[at + i] ?? 0) + amount * reach * (centre - (middle[axis] ?? 0));
    }
  }
  return moved;
}
