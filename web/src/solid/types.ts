// What goes in and comes out when parts are united.

/** Triangles anywhere in space; corners need not be shared. */
export interface Triangles {
  /** Three numbers a corner, in millimetres, z up. */
  readonly positions: Float64Array;
  /** Three corners a triangle, counter-clockwise from outside. */
  readonly triangles: Uint32Array;
}

export interface Part extends Triangles {
  /** For people; not unique. */
  readonly name: string;
  /** Of the file. What one node has may be closed together where no part of it is by itself. */
  readonly node: number;
}

/** Why a part bounds no solid. */
export interface Fault {
  readonly name: string;
  readonly kind: 'open' | 'crossing' | 'flat' | 'refused';
  /** A clause for people. */
  readonly text: string;
}

/** One watertight surface, its corners shared. */
export interface Solid {
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
  /** Cubic millimetres. */
  readonly volume: number;
  /** Of the bounding box, lowest and highest corner, in millimetres. */
  readonly low: readonly number[];
  readonly high: readonly number[];
  /** Pieces that nothing joins. */
  readonly pieces: number;
}
