// Faces that lie in one plane but for rounding are put into one plane: booleans then see them touch, where they would else
// leave a film between them or cut one off.

/**
 * Coordinates along each axis, of all meshes together, that differ by no more than `tolerance` become the lowest of them.
 * Answers the positions of each mesh anew, three numbers a corner.
 */
export function aligned(positions: readonly Float64Array[], tolerance: number): Float64Array[] {
  const made = positions.map((own) => new Float64Array(own.length));
  for (let axis = 0; axis < 3; axis++) {
    const values = new Float64Array(positions.reduce((sum, own) => sum + own.length / 3, 0));
    let count = 0;
    for (const own of positions) for (let i = axis; i < own.length; i += 3) values[count++] = own[i] as number;
    values.sort();
    const lowest = new Map<number, number>();
    let start = Number.NEGATIVE_INFINITY;
    for (const value of values) {
      if (value - start > tolerance) start = value;
      lowest.set(value, start);
    }
    for (const [m, own] of positions.entries())
      for (let i = axis; i < own.length; i += 3) (made[m] as Float64Array)[i] = lowest.get(own[i] as number) as number;
  }
  return made;
}
