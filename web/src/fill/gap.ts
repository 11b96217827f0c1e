// Gaps between surfaces: parts that touched at rest and do not any more, and what of them faced each other.
import { type Box, diskSamples, placeAt, type Sample } from './samples';
import { normalsOf, SurfaceTree } from './surface';
import type { EditedPart, Place } from './types';

/** Of the model's half-diagonal: nearer than `touching` two parts touch, and a gap is at least `narrowest` wide. */
export const relative = { touching: 0.01, narrowest: 0.002 } as const;
/** Below it faces look at each other: the cosine between their normals. */
const opposite = -0.5;
/** Of a contact, to find out where it is. */
const contactSamples = 3000;

export interface Contact {
  readonly parts: readonly [number, number];
  /** At rest, of the nearest of them. */
  readonly distance: number;
  /** Where the parts faced each other, after the edit, of either. */
  readonly points: readonly [readonly Sample[], readonly Sample[]];
  /** By how much they are farther apart now; below 0 where they came nearer. */
  readonly width: number;
}

/** Parts with what is made of them once, whichever contacts they are in. */
export class Parts {
  private readonly trees = new Map<string, SurfaceTree>();
  private readonly normals = new Map<number, Float64Array>();

  constructor(
    readonly list: readonly EditedPart[],
    /** Half the diagonal of the model at rest. */
    readonly scale: number,
  ) {}

  tree(part: number, state: 'rest' | 'edited'): SurfaceTree {
    const key = `${part} ${state}`;
    const known = this.trees.get(key) ?? new SurfaceTree((this.list[part] as EditedPart)[state]);
    this.trees.set(key, known);
    return known;
  }

  /** Whether a place of a part faced another part at rest, no farther from it than `distance`. */
  faced(place: Place, other: number, distance: number): boolean {
    const { rest } = this.list[place.part] as EditedPart;
    const hit = this.tree(other, 'rest').nearest(...placeAt(rest, 3 * place.triangle, place.weights), distance);
    if (hit === null) return false;
    const [own, theirs] = [this.restNormals(place.part), this.restNormals(other)];
    let cosine = 0;
    for (let k = 0; k < 3; k++)
      cosine += (own[3 * place.triangle + k] as number) * (theirs[3 * hit.triangle + k] as number);
    return cosine < opposite;
  }

  private restNormals(part: number): Float64Array {
    const known = this.normals.get(part) ?? normalsOf((this.list[part] as EditedPart).rest);
    this.normals.set(part, known);
    return known;
  }
}

/** Null where the parts did not touch at rest, or no face of one looked at the other. */
export function contactOf(parts: Parts, [a, b]: readonly [number, number]): Contact | null {
  const touching = relative.touching * parts.scale;
  const close = [a, b].map((own) => nearSamples(parts, own, own === a ? b : a, touching));
  const all = close.flat();
  const distance = Math.min(...all.map((sample) => sample.distance));
  if (!Number.isFinite(distance)) return null;
  const within = distance + touching / 2;
  const points = [a, b].map((own, i) =>
    (close[i] as readonly Near[]).filter(
      (sample) => sample.distance <= within && parts.faced(sample, own === a ? b : a, within),
    ),
  ) as unknown as readonly [readonly Sample[], readonly Sample[]];
  if (points.some((list) => list.length === 0)) return null;
  let now = Number.POSITIVE_INFINITY;
  for (const [i, other] of [b, a].entries()) {
    for (const { at } of points[i] as readonly Sample[]) {
      now = Math.min(now, parts.tree(other, 'edited').nearest(...at, now)?.distance ?? now);
    }
  }
  return { parts: [a, b], distance, points, width: now - distance };
}

type Near = Sample & { readonly distance: number };

/** Samples of the edited part where it was near another at rest. */
function nearSamples(parts: Parts, own: number, other: number, touching: number): Near[] {
  const { rest, edited } = parts.list[own] as EditedPart;
  const { low, high } = boundsOf((parts.list[other] as EditedPart).rest.positions);
  const box = { low: low.map((x) => x - touching), high: high.map((x) => x + touching) };
  const area = boxArea(box, boundsOf(rest.positions));
  const radius = Math.max(Math.sqrt(area / contactSamples), touching / 8);
  const found: Near[] = [];
  for (const sample of diskSamples(own, rest, box, radius, () => true)) {
    const hit = parts.tree(other, 'rest').nearest(...sample.at, touching);
    if (hit === null) continue;
    found.push({ ...sample, at: placeAt(edited, 3 * sample.triangle, sample.weights), distance: hit.distance });
  }
  return found;
}

export function boundsOf(positions: ArrayLike<number>): { low: number[]; high: number[] } {
  const low = [0, 0, 0].fill(Number.POSITIVE_INFINITY);
  const high = [0, 0, 0].fill(Number.NEGATIVE_INFINITY);
  for (let i = 0; i < positions.length; i++) {
    low[i % 3] = Math.min(low[i % 3] as number, positions[i] as number);
    high[i % 3] = Math.max(high[i % 3] as number, positions[i] as number);
  }
  return { low, high };
}

/** Of the surface of what two boxes share: about how much of a surface lies in it. */
function boxArea(a: Box, b: Box): number {
  const [x = 0, y = 0, z = 0] = [0, 1, 2].map((k) =>
    Math.max(0, Math.min(a.high[k] as number, b.high[k] as number) - Math.max(a.low[k] as number, b.low[k] as number)),
  );
  return 2 * (x * y + y * z + z * x);
}
