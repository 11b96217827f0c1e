// A cut by a plane: triangles that it goes through become up to three, and both sides get the corners on it.
import type { Between, Corner, Triangles } from './geometry';

export interface Side {
  /** Corners as they were, and those that the plane makes. */
  readonly corners: readonly Corner[];
  /** Indices into these. */
  readonly triangles: Triangles;
}

export interface CutSide extends Side {
  readonly corners: readonly (number | Between)[];
  /** Of each triangle, which one it is of. */
  readonly source: readonly number[];
}

/**
 * @param triangles three corners each
 * @param distance of each corner from the plane, signed; 0: it is on it, and bounds both sides
 * @param isLid whether a triangle that lies in the plane looks to its upper side: then it closes what is below
 * @param before whether a corner comes before another wherever they stand in the file: corners that were doubled along a
 * seam are then cut at the same place to the bit
 * @returns the side of positive distances and the other; empty where there is none
 */
export function cutTriangles(
  triangles: Triangles,
  distance: ArrayLike<number>,
  isLid: (triangle: number) => boolean,
  before: (a: number, b: number) => boolean,
): readonly [above: CutSide, below: CutSide] {
  const above = new SideBuilder();
  const below = new SideBuilder();
  const at = (corner: number) => distance[corner] ?? 0;
  const between = (a: number, b: number): Between => {
    const [from, to] = before(a, b) ? [a, b] : [b, a];
    return { from, to, share: at(from) / (at(from) - at(to)) };
  };
  for (let t = 0; t < triangles.length; t += 3) {
    const corners = [triangles[t] ?? 0, triangles[t + 1] ?? 0, triangles[t + 2] ?? 0];
    const signs = corners.map((corner) => Math.sign(at(corner)));
    const side = signs.includes(1) ? above : signs.includes(-1) ? below : isLid(t / 3) ? below : above;
    if (!signs.includes(side === above ? -1 : 1)) {
      side.add(corners, t / 3);
      continue;
    }
    for (const [builder, sign] of [
      [above, 1],
      [below, -1],
    ] as const) {
      const polygon: (number | Between)[] = [];
      for (const [k, corner] of corners.entries()) {
        const next = corners[(k + 1) % 3] ?? 0;
        const [here, there] = [signs[k] ?? 0, signs[(k + 1) % 3] ?? 0];
        if (here !== -sign) polygon.push(corner);
        if (here * there < 0) polygon.push(between(corner, next));
      }
      builder.add(polygon, t / 3);
    }
  }
  return [above.done(), below.done()];
}

/** Numbers corners as they come; one between two others is made once. */
class SideBuilder {
  readonly #corners: (number | Between)[] = [];
  readonly #numbers = new Map<string | number, number>();
  readonly #triangles: number[] = [];
  readonly #source: number[] = [];

  /** A convex polygon within a triangle, as triangles. */
  add(polygon: readonly (number | Between)[], source: number): void {
    const [first, ...others] = polygon.map((corner) => this.#number(corner));
    for (let i = 1; i < others.length; i++) {
      this.#triangles.push(first ?? 0, others[i - 1] ?? 0, others[i] ?? 0);
      this.#source.push(source);
    }
  }

  done(): CutSide {
    return { corners: this.#corners, triangles: Uint32Array.from(this.#triangles), source: this.#source };
  }

  #number(corner: number | Between): number {
    const key = typeof corner === 'number' ? corner : `${corner.from} ${corner.to}`;
    const known = this.#numbers.get(key);
    if (known !== undefined) return known;
    this.#numbers.set(key, this.#corners.length);
    this.#corners.push(corner);
    return this.#corners.length - 1;
  }
}
