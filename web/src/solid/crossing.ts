// Whether a closed surface runs through itself: an edge of one triangle through the inside of another that shares no edge
// with it. Touching is none: what meets at a point or lies on another is within rounding on either side.
import type { Triangles } from './types';

const leafSize = 4;

/** Triangles in a tree of boxes: those of a node are a run of `order`, its halves the two halves of that run. */
interface Tree {
  readonly order: Uint32Array;
  /** Six numbers a triangle: lowest and highest corner. */
  readonly boxes: Float64Array;
  readonly root: Node;
}
interface Node {
  readonly from: number;
  readonly to: number;
  readonly box: Float64Array;
  readonly halves: readonly [Node, Node] | null;
}

/**
 * Number of pairs of triangles that cross, counted up to `limit`.
 * @param tolerance millimetres by which an edge has to be through
 */
export function crossings(mesh: Triangles, tolerance: number, limit = 1): number {
  const { order, boxes, root } = plant(mesh);
  const cross = crosser(mesh, tolerance);
  let found = 0;
  const meet = (a: Node, b: Node): void => {
    if (found >= limit || !overlap(a.box, 0, b.box, 0)) return;
    if (a.halves === null && b.halves === null) {
      for (let i = a.from; i < a.to; i++) {
        const s = order[i] as number;
        for (let j = a === b ? i + 1 : b.from; j < b.to; j++) {
          const t = order[j] as number;
          if (found < limit && overlap(boxes, 6 * s, boxes, 6 * t) && cross(s, t)) found++;
        }
      }
    } else if (a === b && a.halves !== null) {
      const [first, second] = a.halves;
      meet(first, first);
      meet(first, second);
      meet(second, second);
    } else if (b.halves === null || (a.halves !== null && a.to - a.from > b.to - b.from)) {
      for (const half of a.halves ?? []) meet(half, b);
    } else for (const half of b.halves) meet(a, half);
  };
  meet(root, root);
  return found;
}

function overlap(a: Float64Array, i: number, b: Float64Array, j: number): boolean {
  for (let axis = 0; axis < 3; axis++) {
    if ((a[i + axis] as number) > (b[j + 3 + axis] as number)) return false;
    if ((b[j + axis] as number) > (a[i + 3 + axis] as number)) return false;
  }
  return true;
}

function plant({ positions, triangles }: Triangles): Tree {
  const count = triangles.length / 3;
  const boxes = new Float64Array(6 * count);
  const extend = (box: Float64Array, at: number, axis: number, low: number, high: number) => {
    if (low < (box[at + axis] as number)) box[at + axis] = low;
    if (high > (box[at + 3 + axis] as number)) box[at + 3 + axis] = high;
  };
  const empty = (box: Float64Array, at: number) => {
    box.fill(Number.POSITIVE_INFINITY, at, at + 3).fill(Number.NEGATIVE_INFINITY, at + 3, at + 6);
  };
  for (let t = 0; t < count; t++) {
    empty(boxes, 6 * t);
    for (let i = 0; i < 9; i++) {
      const value = positions[3 * (triangles[3 * t + Math.floor(i / 3)] as number) + (i % 3)] as number;
      extend(boxes, 6 * t, i % 3, value, value);
    }
  }
  const order = Uint32Array.from({ length: count }, (_, t) => t);
  const grow = (from: number, to: number): Node => {
    const box = new Float64Array(6);
    empty(box, 0);
    for (let i = from; i < to; i++) {
      const at = 6 * (order[i] as number);
      for (let axis = 0; axis < 3; axis++)
        extend(box, 0, axis, boxes[at + axis] as number, boxes[at + 3 + axis] as number);
    }
    if (to - from <= leafSize) return { from, to, box, halves: null };
    const lengths = [0, 1, 2].map((axis) => (box[3 + axis] as number) - (box[axis] as number));
    const axis = lengths.indexOf(Math.max(...lengths));
    const middle = (t: number) => (boxes[6 * t + axis] as number) + (boxes[6 * t + 3 + axis] as number);
    order.subarray(from, to).sort((s, t) => middle(s) - middle(t));
    const half = (from + to) >> 1;
    return { from, to, box, halves: [grow(from, half), grow(half, to)] };
  };
  return { order, boxes, root: grow(0, count) };
}

/** Tells of two triangles whether they cross; of those that share a corner, by the edges that do not touch it. */
function crosser({ positions, triangles }: Triangles, tolerance: number): (s: number, t: number) => boolean {
  /** Whether an edge of one triangle goes through the other. */
  const pierced = (s: number, t: number, shared: number): boolean => {
    const [a, b, c] = [3 * corner(t, 0), 3 * corner(t, 1), 3 * corner(t, 2)];
    const [ax, ay, az] = [x(a), x(a + 1), x(a + 2)];
    const [ux, uy, uz] = [x(b) - ax, x(b + 1) - ay, x(b + 2) - az];
    const [vx, vy, vz] = [x(c) - ax, x(c + 1) - ay, x(c + 2) - az];
    let [nx, ny, nz] = [uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx];
    const area = Math.sqrt(nx * nx + ny * ny + nz * nz);
    if (area === 0) return false;
    nx /= area;
    ny /= area;
    nz /= area;
    const height = (i: number) => nx * (x(i) - ax) + ny * (x(i + 1) - ay) + nz * (x(i + 2) - az);
    const heights = [height(3 * corner(s, 0)), height(3 * corner(s, 1)), height(3 * corner(s, 2))] as const;
    for (let k = 0; k < 3; k++) {
      const next = (k + 1) % 3;
      const [from, to] = [corner(s, k), corner(s, next)];
      const [above, below] = [heights[k] as number, heights[next] as number];
      if (from === shared || to === shared || above * below >= 0) continue;
      if (Math.abs(above) <= tolerance || Math.abs(below) <= tolerance) continue;
      const part = above / (above - below);
      const px = x(3 * from) + part * (x(3 * to) - x(3 * from)) - ax;
      const py = x(3 * from + 1) + part * (x(3 * to + 1) - x(3 * from + 1)) - ay;
      const pz = x(3 * from + 2) + part * (x(3 * to + 2) - x(3 * from + 2)) - az;
      // How far the point is inside of each side of the triangle.
      const inside = (ex: number, ey: number, ez: number, qx: number, qy: number, qz: number) =>
        nx * (ey * qz - ez * qy) + ny * (ez * qx - ex * qz) + nz * (ex * qy - ey * qx) >
        tolerance * Math.sqrt(ex * ex + ey * ey + ez * ez);
      if (!inside(ux, uy, uz, px, py, pz)) continue;
      if (!inside(vx - ux, vy - uy, vz - uz, px - ux, py - uy, pz - uz)) continue;
      if (inside(-vx, -vy, -vz, px - vx, py - vy, pz - vz)) return true;
    }
    return false;
  };
  const corner = (t: number, k: number) => triangles[3 * t + k] as number;
  const x = (i: number) => positions[i] as number;
  return (s, t) => {
    let shared = -1;
    for (let i = 0; i < 3; i++) {
      for (let j = 0; j < 3; j++) {
        if (corner(s, i) !== corner(t, j)) continue;
        if (shared >= 0) return false;
        shared = corner(s, i);
      }
    }
    return pierced(s, t, shared) || pierced(t, s, shared);
  };
}
