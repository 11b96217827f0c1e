// What a person does by hand to what is one part, as data: it is done to the file, kept with the work, and done again.
import type { Placing } from './placing';

/** A part by the index of its node and of its primitive: "node:3/0". */
export type PartKey = string;

/** Points x of the scene with normal · x = distance, in metres; the normal has length 1. */
export type Plane = readonly [normalX: number, normalY: number, normalZ: number, distance: number];

export type CarveStep =
  /** Makes one part of several of one material; it takes the place of the first. */
  | { readonly kind: 'join'; readonly parts: readonly PartKey[] }
  /** What hangs together becomes a part each, once corners at one place are one. */
  | { readonly kind: 'divide'; readonly part: PartKey }
  /** Cuts parts in two where the plane goes through them. */
  | { readonly kind: 'cut'; readonly parts: readonly PartKey[]; readonly plane: Plane }
  /** Stands the model up and gives it a size; takes the place of one before. */
  | ({ readonly kind: 'place' } & Placing);

/** Refused, in a sentence for people with what to do. */
export class CarveError extends Error {}

export const partKeyOf = (node: number, primitive: number): PartKey => `node:${node}/${primitive}`;

export function partOf(key: PartKey): { readonly node: number; readonly primitive: number } {
  const read = /^node:(\d+)\/(\d+)$/.exec(key);
  if (read === null) throw new CarveError('A part is named in a way that nobody knows. Ask for this work again.');
  return { node: Number(read[1]), primitive: Number(read[2]) };
}

export interface Carved {
  /** A GLB with everything in it. */
  readonly glb: Uint8Array<ArrayBuffer>;
  /** Extensions of the file that did not come through. */
  readonly lost: readonly string[];
  /** Parts that are another primitive of their node now. */
  readonly moved: readonly (readonly [from: PartKey, to: PartKey])[];
  /** Parts that are new. */
  readonly made: readonly PartKey[];
  /** Names of parts whose cut stays open, since they bound no solid. */
  readonly open: readonly string[];
}
