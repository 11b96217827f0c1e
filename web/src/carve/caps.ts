// What closes the holes that a cut leaves in closed solids. The edges that only one triangle of the lower side has any more
// bound its lid; the lid of the upper side is the same, seen from behind. It is triangulated by Manifold (Lalish), which
// keeps every corner, also those in the middle of a straight edge, so that both sides are closed again and can be cut again.
import type { CutSide } from './cut';
import { type Between, pieces, type Triangles } from './geometry';

export type Point2 = readonly [number, number];
/** Of polygons that run counter-clockwise, and holes that run clockwise: triangles, by the number of a corner among all. */
export type Triangulate = (polygons: [number, number][][]) => readonly (readonly number[])[];

type Corner = number | Between;

/** Three corners each; counter-clockwise as seen from above where they close the lower side. */
export interface Lid {
  readonly triangles: readonly (readonly [Corner, Corner, Corner])[];
  /** The solid was inside out: its lower lid is seen from below. */
  readonly isTurned: boolean;
}

export interface Caps {
  readonly lids: readonly Lid[];
  /** Whether the plane also goes through something that bounds no solid, whose cut stays open. */
  readonly isOpen: boolean;
}

interface Section {
  /** By the numbers of their corners. */
  readonly loops: number[][];
  /** Positive where the lower lid looks up. */
  readonly area: number;
}

/**
 * @param triangles of the part before the cut
 * @param place of each corner: one number for corners that are at one place
 * @param below its lower side
 * @param isOn whether a corner lies on the plane; those between others do
 * @param flat where a corner on the plane is in it, seen from above by who sees triangles from outside counter-clockwise
 */
export function capsOf(
  triangles: Triangles,
  place: Uint32Array,
  below: CutSide,
  isOn: (corner: number) => boolean,
  flat: (corner: Corner) => Point2,
  triangulate: Triangulate,
): Caps {
  const { of, count } = pieces(triangles, place);
  const closed = closedPieces(triangles, place, of, count);
  const ids = new Map<string, number>();
  const corners: Corner[] = [];
  const idOf = (corner: Corner): number => {
    const ends = typeof corner === 'number' ? [corner] : [corner.from, corner.to];
    const key = ends.map((end) => place[end] ?? 0).sort((a, b) => a - b);
    const known = ids.get(key.join());
    if (known !== undefined) return known;
    ids.set(key.join(), ids.size);
    corners.push(corner);
    return ids.size - 1;
  };
  /** By piece: how often an edge on the plane runs one way more than the other, under the numbers of its ends. */
  const net = new Map<number, Map<string, number>>();
  for (let t = 0; t < below.triangles.length; t += 3) {
    const own = [0, 1, 2].map((k) => below.corners[below.triangles[t + k] ?? 0] ?? 0);
    for (const [k, from] of own.entries()) {
      const to = own[(k + 1) % 3] ?? 0;
      if (![from, to].every((corner) => typeof corner !== 'number' || isOn(corner))) continue;
      const [a, b] = [idOf(from), idOf(to)];
      if (a === b) continue;
      const piece = of[below.source[t / 3] ?? 0] ?? 0;
      const edges = net.get(piece) ?? new Map<string, number>();
      const key = `${Math.min(a, b)} ${Math.max(a, b)}`;
      edges.set(key, (edges.get(key) ?? 0) + (a < b ? 1 : -1));
      net.set(piece, edges);
    }
  }
  const points = corners.map(flat);
  const sections: Section[] = [];
  let isOpen = false;
  for (const [piece, edges] of net) {
    const loops = closed[piece] === 1 ? loopsOf(edges, points) : null;
    if (loops === null) isOpen ||= [...edges.values()].some((value) => value !== 0);
    else if (loops.length > 0)
      sections.push({ loops, area: loops.reduce((sum, loop) => sum + areaOf(loop, points), 0) });
  }
  const lids = grouped(sections, points).map((group) => {
    const isTurned = group.reduce((sum, { area }) => sum + area, 0) < 0;
    const loops = group.flatMap((section) => section.loops);
    const made = triangulate(
      loops.map((loop) =>
        loop.map((id) => {
          const [x, y] = points[id] ?? [0, 0];
          return isTurned ? [y, x] : [x, y];
        }),
      ),
    );
    const all = loops.flat();
    const corner = (i: number | undefined): Corner => corners[all[i ?? 0] ?? 0] ?? 0;
    const found = made.map(([a, b, c]) => [corner(a), corner(b), corner(c)] as const);
    return { triangles: found, isTurned };
  });
  return { lids, isOpen };
}

/** Of each piece, 1 where every edge runs one way as often as the other: it has an inside. */
export function closedPieces(triangles: Triangles, place: Uint32Array, of: Uint32Array, count: number): Uint8Array {
  const net = new Map<number, number>();
  const corners = place.length;
  const closed = new Uint8Array(count).fill(1);
  const each = (visit: (key: number, sign: number, t: number) => void) => {
    for (let i = 0; i < triangles.length; i++) {
      const a = place[triangles[i] ?? 0] ?? 0;
      const b = place[triangles[i % 3 === 2 ? i - 2 : i + 1] ?? 0] ?? 0;
      if (a !== b) visit(Math.min(a, b) * corners + Math.max(a, b), a < b ? 1 : -1, (i - (i % 3)) / 3);
    }
  };
  each((key, sign) => net.set(key, (net.get(key) ?? 0) + sign));
  each((key, _, t) => {
    if (net.get(key) !== 0) closed[of[t] ?? 0] = 0;
  });
  return closed;
}

/**
 * Loops of the edges against those that are left open, so that what they bound is on their left. At a corner where several
 * meet, the next is the first clockwise from where one came, and loops touch but do not cross. Null where they do not close.
 */
function loopsOf(net: ReadonlyMap<string, number>, points: readonly Point2[]): number[][] | null {
  const leaving = new Map<number, number[]>();
  const balance = new Map<number, number>();
  const add = (map: Map<number, number>, key: number, value: number) => map.set(key, (map.get(key) ?? 0) + value);
  for (const [key, value] of net) {
    const [low = 0, high = 0] = key.split(' ').map(Number);
    const [from, to] = value > 0 ? [high, low] : [low, high];
    for (let i = 0; i < Math.abs(value); i++) {
      leaving.set(from, [...(leaving.get(from) ?? []), to]);
      add(balance, from, 1);
      add(balance, to, -1);
    }
  }
  if ([...balance.values()].some((value) => value !== 0)) return null;
  const loops: number[][] = [];
  for (const [first, own] of leaving) {
    while (own.length > 0) {
      const loop: number[] = [];
      let [came, at] = [-1, first];
      do {
        loop.push(at);
        const ways = leaving.get(at) ?? [];
        const next = ways.length < 2 || came < 0 ? 0 : firstClockwise(ways, at, came, points);
        const [to = first] = ways.splice(next, 1);
        [came, at] = [at, to];
      } while (at !== first);
      if (loop.length > 2) loops.push(loop);
    }
  }
  return loops;
}

function firstClockwise(ways: readonly number[], at: number, came: number, points: readonly Point2[]): number {
  const [x, y] = points[at] ?? [0, 0];
  const angle = (to: number) => {
    const [px, py] = points[to] ?? [0, 0];
    return diamond(px - x, py - y);
  };
  const back = angle(came);
  const turns = ways.map((to) => (back - angle(to) + 4) % 4 || 4);
  return turns.indexOf(Math.min(...turns));
}

/** Grows with the angle, from 0 to 4, by sums and one division: the same in every browser. */
function diamond(x: number, y: number): number {
  const share = y / (Math.abs(x) + Math.abs(y) || 1);
  return x >= 0 ? (share + 4) % 4 : 2 - share;
}

function areaOf(loop: readonly number[], points: readonly Point2[]): number {
  const [ox, oy] = points[loop[0] ?? 0] ?? [0, 0];
  return loop.reduce((sum, id, i) => {
    const [ax, ay] = points[id] ?? [0, 0];
    const [bx, by] = points[loop[(i + 1) % loop.length] ?? 0] ?? [0, 0];
    return sum + ((ax - ox) * (by - oy) - (bx - ox) * (ay - oy)) / 2;
  }, 0);
}

/** Sections of hollows with that of the solid around them; every other by itself. Those without area have no lid. */
function grouped(sections: readonly Section[], points: readonly Point2[]): Section[][] {
  const groups = sections.filter(({ area }) => area > 0).map((section) => [section]);
  const outer = [...groups].sort(([a], [b]) => (a?.area ?? 0) - (b?.area ?? 0));
  for (const section of sections) {
    if (!(section.area < 0)) continue;
    const at = points[section.loops[0]?.[0] ?? 0] ?? [0, 0];
    const around = outer.find(
      ([solid]) => solid !== undefined && -section.area < solid.area && holds(solid, at, points),
    );
    if (around === undefined) groups.push([section]);
    else around.push(section);
  }
  return groups;
}

/** By the parity of crossings to the right. */
function holds({ loops }: Section, [x, y]: Point2, points: readonly Point2[]): boolean {
  let inside = false;
  for (const loop of loops)
    for (const [i, id] of loop.entries()) {
      const [ax, ay] = points[id] ?? [0, 0];
      const [bx, by] = points[loop[(i + 1) % loop.length] ?? 0] ?? [0, 0];
      if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
    }
  return inside;
}
