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

/** Why nothing was filled in: clauses on the two parts of a gap, and on what was built between them. */
export type Unfilled =
  | 'they are too far apart'
  | 'nothing of one faces the other'
  | 'what was built anew does not reach across'
  | 'one is not there any more'
  | 'one bends with a skeleton'
  | 'one has morph targets'
  | 'one is drawn many times by one node';

export interface FilledGap {
  readonly parts: readonly [number, number];
  /** By how much the parts were farther apart than at rest. */
  readonly width: number;
  readonly patches: readonly Patch[];
  /** Empty where the gap is closed. */
  readonly left: Unfilled | '';
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
