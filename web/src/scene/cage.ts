// The corners of every hexahedron in one small float texture, which the vertex shader reads (cage_material.ts).
//
// Row r of the texture belongs to one hexahedron: texels 0 … 7 are its corners, texel 8 its tint (r, g, b, strength).
// Rows 0 … parts-1 are the parts in the shape's order; behind them every group has a run of rows for its instances.
// A vertex knows its local coordinates (u,v,w) ∈ [-1,1]³ in the hexahedron at rest and its row; its position is
// Σₖ Nₖ(u,v,w)·Hₖ with Nₖ = Π(1 ± ·)/2. On a box these trilinear weights are the harmonic coordinates of Joshi et al.
// 2007: each is multilinear, hence harmonic, and has the right values on the boundary.
import * as three from 'three';
import { type CageShape, type Corners, isGroup, type Vec3 } from '../program/types';
import type { State } from './explode';

export const texelsPerRow = 9;
const tintTexel = 8;
const floatsPerRow = texelsPerRow * 4;

/** A run of rows for the instances of a group. */
interface GroupRows {
  relation: number;
  first: number;
  capacity: number;
}

export class CageTexture {
  /** Shared by all materials of the model. */
  readonly uniform: { value: three.DataTexture };
  #rows: number;
  #data: Float32Array;
  readonly #groups: GroupRows[] = [];
  readonly #partCount: number;

  constructor(shape: CageShape) {
    this.#partCount = shape.parts.length;
    let rows = this.#partCount;
    for (const [relation, group] of shape.relations.entries()) {
      if (!isGroup(group)) continue;
      const capacity = 2 * group.parts.length;
      this.#groups.push({ relation, first: rows, capacity });
      rows += capacity;
    }
    this.#rows = rows;
    this.#data = new Float32Array(rows * floatsPerRow);
    this.uniform = { value: createTexture(this.#data, rows) };
    for (const [row, part] of shape.parts.entries()) {
      for (const [k, corner] of part.corners.entries()) this.#data.set(corner, row * floatsPerRow + k * 4);
    }
  }

  /** Row of instance `number` of a group. */
  rowOfInstance(relation: number, number: number): number {
    const group = this.#groups.find((other) => other.relation === relation);
    if (group === undefined) throw new Error(`relation ${relation} is no group`);
    return group.first + number;
  }

  /**
   * Takes the corners of a state over. Allocates nothing unless a group has outgrown its rows; answers whether that
   * was so, because the rows of instances are others then.
   */
  write({ corners, groups }: State): boolean {
    let moved = false;
    for (const group of this.#groups) {
      const count = groups[group.relation]?.count ?? 0;
      if (count > group.capacity) {
        group.capacity = 2 * count;
        moved = true;
      }
    }
    if (moved) this.#reallocate();
    this.#writeRows(0, this.#partCount, corners);
    for (const { relation, first } of this.#groups) {
      const group = groups[relation];
      if (group) this.#writeRows(first, group.count, group.instances);
    }
    this.uniform.value.needsUpdate = true;
    return moved;
  }

  /** The corners of a row as they were written, at the texture's precision, to out[0 … 23]. */
  readRow(row: number, out: Float64Array): void {
    for (let i = 0; i < 24; i++) out[i] = this.#data[row * floatsPerRow + 4 * Math.floor(i / 3) + (i % 3)] as number;
  }

  /** @param strength 0 leaves the material's own colour, 1 replaces it. Display colour, 0 … 1. */
  setTint(row: number, red: number, green: number, blue: number, strength: number): void {
    const at = row * floatsPerRow + tintTexel * 4;
    this.#data[at] = red;
    this.#data[at + 1] = green;
    this.#data[at + 2] = blue;
    this.#data[at + 3] = strength;
    this.uniform.value.needsUpdate = true;
  }

  dispose(): void {
    this.uniform.value.dispose();
  }

  #writeRows(first: number, count: number, corners: Float64Array): void {
    const data = this.#data;
    for (let row = 0; row < count; row++) {
      let to = (first + row) * floatsPerRow;
      for (let from = row * 24; from < row * 24 + 24; from += 3, to += 4) {
        data[to] = corners[from] as number;
        data[to + 1] = corners[from + 1] as number;
        data[to + 2] = corners[from + 2] as number;
      }
    }
  }

  #reallocate(): void {
    const old = this.#data;
    let rows = this.#partCount;
    for (const group of this.#groups) {
      group.first = rows;
      rows += group.capacity;
    }
    this.#rows = rows;
    this.#data = new Float32Array(rows * floatsPerRow);
    this.#data.set(old.subarray(0, this.#partCount * floatsPerRow));
    this.uniform.value.dispose();
    this.uniform.value = createTexture(this.#data, this.#rows);
  }
}

function createTexture(data: Float32Array, rows: number): three.DataTexture {
  const texture = new three.DataTexture(data, texelsPerRow, rows, three.RGBAFormat, three.FloatType);
  texture.needsUpdate = true;
  return texture;
}

/** From model coordinates to local coordinates of a box: u = matrix · (p − centre). */
export interface LocalFrame {
  readonly centre: three.Vector3;
  /** Columns: half the box's mean edges, the Jacobian of the trilinear map at the box's centre. */
  readonly edges: three.Matrix3;
  readonly inverse: three.Matrix3;
}

/** Of a hexahedron at rest, which is a box: its faces are parallelograms, so the trilinear map is affine. */
export function localFrame(corners: Corners): LocalFrame {
  const centre = new three.Vector3();
  const edges = [new three.Vector3(), new three.Vector3(), new three.Vector3()] as const;
  const corner = new three.Vector3();
  for (const [k, at] of corners.entries()) {
    corner.set(...(at as [number, number, number])).divideScalar(8);
    centre.add(corner);
    for (const [axis, edge] of edges.entries()) edge.addScaledVector(corner, k & (1 << axis) ? 1 : -1);
  }
  const [x, y, z] = edges;
  const matrix = new three.Matrix3().set(x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z);
  return { centre, edges: matrix, inverse: matrix.clone().invert() };
}

/** Σₖ Nₖ(u,v,w)·Hₖ on flat corners (24 numbers from `start`). */
export function trilinear(
  corners: ArrayLike<number>,
  start: number,
  [u, v, w]: Vec3,
  out: three.Vector3,
): three.Vector3 {
  out.set(0, 0, 0);
  for (let k = 0; k < 8; k++) {
    const weight = ((1 + (k & 1 ? u : -u)) * (1 + (k & 2 ? v : -v)) * (1 + (k & 4 ? w : -w))) / 8;
    const at = start + 3 * k;
    out.x += weight * (corners[at] as number);
    out.y += weight * (corners[at + 1] as number);
    out.z += weight * (corners[at + 2] as number);
  }
  return out;
}
