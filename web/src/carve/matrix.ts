// Matrices as glTF has them: 16 numbers, column by column.
import { CarveError } from './steps';

export type Matrix = readonly number[];

export const apply = (m: Matrix, [x = 0, y = 0, z = 0]: readonly number[]): [number, number, number] => [
  (m[0] ?? 0) * x + (m[4] ?? 0) * y + (m[8] ?? 0) * z + (m[12] ?? 0),
  (m[1] ?? 0) * x + (m[5] ?? 0) * y + (m[9] ?? 0) * z + (m[13] ?? 0),
  (m[2] ?? 0) * x + (m[6] ?? 0) * y + (m[10] ?? 0) * z + (m[14] ?? 0),
];

/** Of the upper left 3×3, its cofactors in the same places: what normals are turned by, but for their length. */
export function cofactors(m: Matrix): number[] {
  const at = (row: number, column: number) => m[4 * (column % 3) + (row % 3)] ?? 0;
  const found: number[] = [];
  for (let column = 0; column < 3; column++)
    for (let row = 0; row < 3; row++)
      found.push(at(row + 1, column + 1) * at(row + 2, column + 2) - at(row + 1, column + 2) * at(row + 2, column + 1));
  return found;
}

/** Of the upper left 3×3: negative where it mirrors. */
export function determinant(m: Matrix): number {
  const c = cofactors(m);
  return (m[0] ?? 0) * (c[0] ?? 0) + (m[4] ?? 0) * (c[3] ?? 0) + (m[8] ?? 0) * (c[6] ?? 0);
}

/** From the frame of one node into that of another. Throws a CarveError where the other is flat. */
export function relative(to: Matrix, from: Matrix): number[] {
  const size = determinant(to);
  if (!Number.isFinite(1 / size)) throw new CarveError('A part is scaled to nothing. Choose another one first.');
  const c = cofactors(to);
  // The inverse of the 3×3: its cofactors, mirrored at the diagonal.
  const inverse = (row: number, column: number) => (c[3 * row + column] ?? 0) / size;
  const made = new Array<number>(16).fill(0);
  for (let column = 0; column < 4; column++)
    for (let row = 0; row < 3; row++)
      for (let k = 0; k < 3; k++) {
        const value = (from[4 * column + k] ?? 0) - (column === 3 ? (to[12 + k] ?? 0) : 0);
        made[4 * column + row] = (made[4 * column + row] ?? 0) + inverse(row, k) * value;
      }
  made[15] = 1;
  return made;
}
