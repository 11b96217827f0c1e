// What goes in and comes out when gaps are filled. Lengths are millimetres, z up, as in solid.
import type { Triangles } from '../solid/types';

/** A part before and after its edit: the same corners and triangles, moved. */
export interface EditedPart {
  readonly rest: Triangles;
  readonly edited: Triangles;
}

/** A place on a part: in which of its triangles, and the weights of that one's corners. */
export interface Place {
  readonly part: number;
  readonly triangle: number;
  readonly weights: readonly [number, number, number];
}

/** New triangles of a part, whose corners lie at, or next to, places of it. */
export interface Patch {
  readonly part: number;
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
  /** One a corner: where what else the corner has is taken from. */
  readonly places: readonly Place[];
}

export interface FilledGap {
  readonly parts: readonly [number, number];
  /** By how much the parts were farther apart than at rest. */
  readonly width: number;
  readonly patches: readonly Patch[];
  /** Why nothing was filled in, a clause; empty where the gap is closed. */
  readonly left: string;
}

export interface Reconstruction {
  readonly positions: Float32Array;
  readonly triangles: Uint32Array;
}

/**
 * Screened Poisson reconstruction.
 * @param samples points in the unit cube with outward normals, six numbers each
 * @param depth of the octree, whose cells are 2^-depth wide
 */
export type Reconstruct = (samples: Float32Array, depth: number) => Reconstruction;
