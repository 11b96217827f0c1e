// The smallest shapes that tests need: one box, and two that touch.
import type { Shape, ShapePart, Vec3 } from '../../web/src/program/types';

export const box = (id: string, node: number, centre: Vec3, half: Vec3): ShapePart => ({
  id,
  label: id,
  name: id,
  node,
  primitive: 0,
  corners: Array.from(
    { length: 8 },
    (_, k) => [0, 1, 2].map((i) => (centre[i] ?? 0) + (k & (1 << i) ? 1 : -1) * (half[i] ?? 0)) as unknown as Vec3,
  ),
  axes: [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  virtual: false,
  members: [],
});

export const oneBox: Shape = {
  format: 'parsel/shape',
  version: 1,
  name: 'box',
  sha256: '',
  frame: { centre: [0, 0, 0], scale: 1 },
  parts: [box('box', 0, [0, 0, 0], [0.5, 0.5, 0.5])],
  relations: [],
  warnings: [],
};

/** "left" and "right", which touch in the plane x = 0, joined there at a point; frame in metres. */
export const twoBoxes: Shape = {
  ...oneBox,
  parts: [box('left', 0, [0.25, 0, 0], [0.25, 0.25, 0.25]), box('right', 1, [-0.25, 0, 0], [0.25, 0.25, 0.25])],
  relations: [
    {
      id: 'a1',
      kind: 'point',
      parts: ['left', 'right'],
      points: [[0, 0, 0]],
      local_a: [[-1, 0, 0]],
      local_b: [[1, 0, 0]],
    },
  ],
};
