// Corners that are one point become one, and triangles that cancel out go: what is left has an inside, or is open.
import type { Triangles } from './types';
import { cross, dot, type ReadonlyVec } from './vectors';

/** Triangles whose corners are shared. */
export interface Welded extends Triangles {
  /** Directed edges that no edge runs against. */
  readonly open: number;
}

/**
 * Merges corners at the same place; where that leaves edges open, corners nearer than `tolerance` as well, which is what
 * rounding in files pulls apart.
 * @param tolerance millimetres
 */
export function weld({ positions, triangles }: Triangles, tolerance: number): Welded {
  const exact = merged(positions, triangles, (x) => x + 0); // -0 and 0 are one
  if (exact.open === 0) return exact;
  const near = merged(positions, triangles, (x) => Math.round(x / tolerance));
  return near.open < exact.open ? near : exact;
}

/** Of several meshes one after the other, nothing merged. */
export function joined(meshes: readonly Triangles[]): Triangles {
  const positions = new Float64Array(meshes.reduce((sum, mesh) => sum + mesh.positions.length, 0));
  const triangles = new Uint32Array(meshes.reduce((sum, mesh) => sum + mesh.triangles.length, 0));
  let [point, corner] = [0, 0];
  for (const mesh of meshes) {
    positions.set(mesh.positions, 3 * point);
    for (const [i, at] of mesh.triangles.entries()) triangles[corner + i] = at + point;
    point += mesh.positions.length / 3;
    corner += mesh.triangles.length;
  }
  return { positions, triangles };
}

function merged(positions: Float64Array, triangles: Uint32Array, cell: (x: number) => number): Welded {
  const ids = new Map<string, number>();
  const kept: number[] = [];
  const idOf = new Uint32Array(positions.length / 3);
  for (let i = 0; i < idOf.length; i++) {
    const [x = 0, y = 0, z = 0] = positions.subarray(3 * i, 3 * i + 3);
    const key = `${cell(x)},${cell(y)},${cell(z)}`;
    const known = ids.get(key);
    idOf[i] = known ?? ids.size;
    if (known !== undefined) continue;
    ids.set(key, ids.size);
    kept.push(x, y, z);
  }
  const left = uncancelled(triangles.map((corner) => idOf[corner] as number));
  return { positions: Float64Array.from(kept), triangles: left, open: openEdges(left) };
}

/** Without triangles that have no area, that lie back to back, or that stand there twice. */
function uncancelled(triangles: Uint32Array): Uint32Array {
  /** By their corners in order: how often it faces one way more than the other. */
  const net = new Map<string, number>();
  const keyOf = (i: number): readonly [key: string, sense: number] => {
    const [a = 0, b = 0, c = 0] = triangles.subarray(i, i + 3);
    if (a === b || b === c || c === a) return ['', 0];
    const [low, middle, high] = [a, b, c].sort((x, y) => x - y);
    const even = (a < b && b < c) || (b < c && c < a) || (c < a && a < b);
    return [`${low},${middle},${high}`, even ? 1 : -1];
  };
  for (let i = 0; i < triangles.length; i += 3) {
    const [key, sense] = keyOf(i);
    if (sense !== 0) net.set(key, (net.get(key) ?? 0) + sense);
  }
  const left: number[] = [];
  for (let i = 0; i < triangles.length; i += 3) {
    const [key, sense] = keyOf(i);
    if (sense * (net.get(key) ?? 0) <= 0) continue;
    net.set(key, 0); // once
    left.push(...triangles.subarray(i, i + 3));
  }
  return Uint32Array.from(left);
}

const edgeKey = (from: number, to: number) => from * 0x8000000 + to; // exact below 2^26 corners

/** How often each edge is run along one way more than the other, over all triangles; 0 of a surface that is closed. */
export function openEdges(triangles: Uint32Array): number {
  const net = new Map<number, number>();
  for (let i = 0; i < triangles.length; i += 3) {
    for (let k = 0; k < 3; k++) {
      const [a, b] = [triangles[i + k] as number, triangles[i + ((k + 1) % 3)] as number];
      const key = edgeKey(Math.min(a, b), Math.max(a, b));
      net.set(key, (net.get(key) ?? 0) + (a < b ? 1 : -1));
    }
  }
  let open = 0;
  for (const count of net.values()) open += Math.abs(count);
  return open;
}

/** The closed surfaces of a welded mesh: triangles that hang together along edges of two. */
export function shells({ positions, triangles }: Welded): Triangles[] {
  const count = triangles.length / 3;
  const atEdge = new Map<number, number[]>();
  for (let t = 0; t < count; t++) {
    for (let k = 0; k < 3; k++) {
      const [a, b] = [triangles[3 * t + k] as number, triangles[3 * t + ((k + 1) % 3)] as number];
      const key = edgeKey(Math.min(a, b), Math.max(a, b));
      const there = atEdge.get(key);
      if (there === undefined) atEdge.set(key, [t]);
      else there.push(t);
    }
  }
  const groups = (most: number): Uint32Array[] => {
    const { find, join } = disjointSets(count);
    for (const there of atEdge.values()) {
      if (there.length > most) continue;
      for (const t of there) join(t, there[0] as number);
    }
    const found = new Map<number, number[]>();
    for (let t = 0; t < count; t++) {
      const own = found.get(find(t));
      const corners = triangles.subarray(3 * t, 3 * t + 3);
      if (own === undefined) found.set(find(t), [...corners]);
      else own.push(...corners);
    }
    return [...found.values()].map((list) => Uint32Array.from(list));
  };
  // Two solids that meet along an edge have four triangles there: each is a surface by itself.
  const apart = groups(2);
  const found = apart.every((own) => openEdges(own) === 0) ? apart : groups(Number.POSITIVE_INFINITY);
  return found.map((own) => compact(positions, own));
}

/** With the corners that are used alone. */
function compact(positions: Float64Array, triangles: Uint32Array): Triangles {
  const ids = new Map<number, number>();
  const kept: number[] = [];
  const own = triangles.map((corner) => {
    const known = ids.get(corner);
    if (known !== undefined) return known;
    ids.set(corner, ids.size);
    kept.push(...positions.subarray(3 * corner, 3 * corner + 3));
    return ids.size - 1;
  });
  return { positions: Float64Array.from(kept), triangles: own };
}

/** Signed, in cubic millimetres: negative where triangles face inwards. */
export function volumeOf({ positions, triangles }: Triangles): number {
  const at = (i: number) => positions.subarray(3 * (triangles[i] as number), 3 * (triangles[i] as number) + 3);
  const [ox = 0, oy = 0, oz = 0] = positions; // near by, so that nothing cancels
  let sum = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const [x = 0, y = 0, z = 0] = at(i + k);
      return [x - ox, y - oy, z - oz] as const;
    }) as [ReadonlyVec, ReadonlyVec, ReadonlyVec];
    sum += dot(a, cross(b, c));
  }
  return sum / 6;
}

export function boundsOf(positions: ArrayLike<number>): { low: number[]; high: number[] } {
  const low = [0, 0, 0].fill(Number.POSITIVE_INFINITY);
  const high = [0, 0, 0].fill(Number.NEGATIVE_INFINITY);
  for (let i = 0; i < positions.length; i++) {
    const value = positions[i] as number;
    low[i % 3] = Math.min(low[i % 3] as number, value);
    high[i % 3] = Math.max(high[i % 3] as number, value);
  }
  return { low, high };
}

/** The same triangles, seen from behind. */
export function turnedOver(triangles: Uint32Array): Uint32Array {
  const turned = triangles.slice();
  for (let i = 0; i < turned.length; i += 3) {
    turned[i + 1] = triangles[i + 2] as number;
    turned[i + 2] = triangles[i + 1] as number;
  }
  return turned;
}

/** Sets of the numbers 0 … count − 1, each alone at first (Tarjan 1975, with path halving). */
export function disjointSets(count: number) {
  const root = Uint32Array.from({ length: count }, (_, i) => i);
  /** The number that stands for the set of i. */
  const find = (i: number): number => {
    let at = i;
    while (root[at] !== at) {
      root[at] = root[root[at] as number] as number;
      at = root[at] as number;
    }
    return at;
  };
  /** Unites the two sets; that of `into` gives the number that stands for both. */
  const join = (i: number, into: number): void => {
    root[find(i)] = find(into);
  };
  return { find, join };
}
