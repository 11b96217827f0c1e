// Where nodes are: matrices of 16 numbers, column by column, as glTF has them.
import { MathUtils, type mat4, type vec3, type vec4 } from '@gltf-transform/core';
import type { Primitive } from './model';

export type Matrix = mat4;

export const identity: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** First `inner`, then `outer`. */
export function compose(outer: Matrix, inner: Matrix): Matrix {
  if (outer === identity) return inner;
  if (inner === identity) return outer;
  const at = (m: Matrix, row: number, column: number) => m[4 * column + row] as number;
  return Array.from({ length: 16 }, (_, i) =>
    [0, 1, 2, 3].reduce((sum, k) => sum + at(outer, i % 4, k) * at(inner, k, Math.floor(i / 4)), 0),
  ) as Matrix;
}

/** Of a translation, a rotation and scales, within rounding: what a node of glTF can say. */
export function isPlaced(matrix: Matrix): boolean {
  const t: vec3 = [0, 0, 0];
  const r: vec4 = [0, 0, 0, 1];
  const s: vec3 = [1, 1, 1];
  MathUtils.decompose(matrix, t, r, s);
  const again = MathUtils.compose(t, r, s, [...identity]);
  const size = Math.max(...matrix.slice(0, 12).map(Math.abs));
  return matrix.every((value, i) => Math.abs(value - (again[i] as number)) <= 1e-6 * (i < 12 ? size : Math.abs(value)));
}

/** A primitive without normals, its corners multiplied with a matrix. */
export function moved(primitive: Primitive, matrix: Matrix): Primitive {
  const positions = new Float32Array(primitive.positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const [x = 0, y = 0, z = 0] = primitive.positions.subarray(i, i + 3);
    for (let k = 0; k < 3; k++) {
      const column = (c: number) => matrix[4 * c + k] as number;
      positions[i + k] = column(0) * x + column(1) * y + column(2) * z + column(3);
    }
  }
  return { ...primitive, positions };
}
