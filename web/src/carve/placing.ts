// How a model stands: which of its file's directions are up and to the front, and how long a unit of the file is.

export const directions = ['+x', '-x', '+y', '-y', '+z', '-z'] as const;
/** A direction of the file. */
export type Direction = (typeof directions)[number];

/** How the model stands: which directions of its file are up and to the front, and how many metres a unit of it is. */
export interface Placing {
  readonly up: Direction;
  /** Across `up`. */
  readonly front: Direction;
  readonly metres: number;
}

/** As glTF says that files are. */
export const asInFile: Placing = { up: '+y', front: '+z', metres: 1 };

/** Name of the node that is put above all others; whoever exports the model as its file was finds it by that. */
export const placingNode = 'ParSEL: as it stands';

/** The direction as a unit vector. */
export function vectorOf(direction: Direction): [number, number, number] {
  const vector: [number, number, number] = [0, 0, 0];
  vector['xyz'.indexOf(direction.charAt(1))] = direction.startsWith('-') ? -1 : 1;
  return vector;
}

const directionOf = (vector: readonly number[]): Direction => {
  const axis = vector.findIndex((value) => Math.abs(value) > 0.5);
  return `${(vector[axis] ?? 0) < 0 ? '-' : '+'}${'xyz'.charAt(axis)}` as Direction;
};

const across = ([a, b, c]: readonly number[], [x, y, z]: readonly number[]): [number, number, number] => [
  (b ?? 0) * (z ?? 0) - (c ?? 0) * (y ?? 0),
  (c ?? 0) * (x ?? 0) - (a ?? 0) * (z ?? 0),
  (a ?? 0) * (y ?? 0) - (b ?? 0) * (x ?? 0),
];

/** The file's directions that are the model's own x, y and z where it stands like that. */
export function axesOf({ up, front }: Placing): readonly [number[], number[], number[]] {
  const [y, z] = [vectorOf(up), vectorOf(front)];
  return [across(y, z), y, z];
}

/**
 * The placing after a direction of the model, as it stands, is made its new up (its front turns with it, or stays).
 * @param up as it stands now
 */
export function turnedUp(now: Placing, up: Direction): Placing {
  const axes = axesOf(now);
  const inFile = (direction: Direction) => {
    const [x = 0, y = 0, z = 0] = vectorOf(direction);
    return [0, 1, 2].map((i) => x * (axes[0][i] ?? 0) + y * (axes[1][i] ?? 0) + z * (axes[2][i] ?? 0));
  };
  if (up === '+y') return now;
  // What looked up comes to look to the front or back where the front was what is up now; else the front stays.
  const front: Direction = up === '+z' ? '-y' : up === '-z' ? '+y' : '+z';
  return { ...now, up: directionOf(inFile(up)), front: directionOf(inFile(front)) };
}

/** The same turned about what is up until a side of the model, as it stands, is its front. */
export function turnedTo(now: Placing, side: Direction): Placing {
  const quarters = { '+z': 0, '-x': 1, '-z': 2, '+x': 3, '+y': 0, '-y': 0 }[side];
  let turned = now;
  for (let i = 0; i < quarters; i++) turned = turnedRound(turned);
  return turned;
}

/** The same turned to the left about what is up, a quarter: what faced its right faces its front. */
export function turnedRound(now: Placing): Placing {
  const [x] = axesOf(now);
  return { ...now, front: directionOf(x.map((value) => -value)) };
}
