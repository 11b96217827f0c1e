// Both sides of a part at a plane, closed where it is a closed solid.
import type { Node, Primitive } from '@gltf-transform/core';
import { type Caps, capsOf, type Point2, type Triangulate } from './caps';
import { type CutSide, cutTriangles, type Side } from './cut';
import { type Between, type Corner, type Facing, places, trianglesOf } from './geometry';
import { apply, determinant } from './matrix';
import type { Plane } from './steps';

/** Corners nearer than this are one place where that closes a part, relative to how far it reaches. */
const weldDistance = 1e-6;

export interface Sides {
  /** The side where the plane's normal points first. */
  readonly sides: readonly [Side, Side];
  /** Whether the cut stays open somewhere, since what it goes through bounds no solid. */
  readonly isOpen: boolean;
}

/** Null where the part is on one side. */
export function sidesOf(
  { node, primitive }: { readonly node: Node; readonly primitive: Primitive },
  plane: Plane,
  triangulate: Triangulate,
): Sides | null {
  const [nx, ny, nz, distance] = plane;
  const position = primitive.getAttribute('POSITION');
  if (position === null) return null;
  const world = node.getWorldMatrix();
  const count = position.getCount();
  const points = new Float64Array(3 * count);
  const from = new Float64Array(count);
  const element: number[] = [];
  let [reach, extent] = [0, 0];
  for (let i = 0; i < count; i++) {
    const [x, y, z] = apply(world, position.getElement(i, element));
    extent = Math.max(extent, ...element.map(Math.abs));
    points.set([x, y, z], 3 * i);
    from[i] = nx * x + ny * y + nz * z - distance;
    reach = Math.max(reach, Math.abs(x), Math.abs(y), Math.abs(z));
  }
  // As near as floats can say: it is on the plane.
  const near = Math.max(1e-12, 1e-6 * reach);
  for (let i = 0; i < count; i++) if (Math.abs(from[i] ?? 0) <= near) from[i] = 0;
  const triangles = trianglesOf(primitive);
  if (!triangles.some((corner) => (from[corner] ?? 0) > 0) || !triangles.some((corner) => (from[corner] ?? 0) < 0))
    return null;
  const isMirrored = determinant(world) < 0;
  const point = (t: number, k: number, axis: number) => points[3 * (triangles[3 * t + k] ?? 0) + axis] ?? 0;
  const isLid = (t: number) => {
    const edge = (k: number, axis: number) => point(t, k, axis) - point(t, 0, axis);
    const across = (b: number, c: number) => edge(1, b) * edge(2, c) - edge(1, c) * edge(2, b);
    const up = nx * across(1, 2) + ny * across(2, 0) + nz * across(0, 1);
    return isMirrored ? up < 0 : up > 0;
  };
  const before = (a: number, b: number) => {
    for (let axis = 0; axis < 3; axis++) {
      const [one, two] = [points[3 * a + axis] ?? 0, points[3 * b + axis] ?? 0];
      if (one !== two) return one < two;
    }
    return a < b;
  };
  const [above, below] = cutTriangles(triangles, from, isLid, before);
  const flat = projection(points, plane, isMirrored);
  const isOn = (corner: number) => from[corner] === 0;
  const caps = (cell: number) => capsOf(triangles, places(position, cell), below, isOn, flat, triangulate);
  const exact = caps(0);
  const found = exact.isOpen ? caps(weldDistance * extent) : exact;
  return { sides: closed(above, below, found, ownNormal(world, plane)), isOpen: found.isOpen };
}

/** Coordinates in the plane: those across the axis that it stands across most, as they are. */
function projection(
  points: Float64Array,
  [nx, ny, nz]: Plane,
  isMirrored: boolean,
): (corner: number | Between) => Point2 {
  const size = [nx, ny, nz].map(Math.abs);
  const axis = size.indexOf(Math.max(...size));
  const isSwapped = ([nx, ny, nz][axis] ?? 0) < 0 !== isMirrored;
  const [u, v] = isSwapped ? [(axis + 2) % 3, (axis + 1) % 3] : [(axis + 1) % 3, (axis + 2) % 3];
  const at = (corner: number | Between, k: number): number => {
    if (typeof corner === 'number') return points[3 * corner + k] ?? 0;
    const [a, b] = [points[3 * corner.from + k] ?? 0, points[3 * corner.to + k] ?? 0];
    return a + corner.share * (b - a);
  };
  return (corner) => [at(corner, u), at(corner, v)];
}

/** The plane's normal in a part's own frame, of length 1: normals are turned by the inverse transpose on their way out. */
function ownNormal(world: readonly number[], [nx, ny, nz]: Plane): readonly [number, number, number] {
  const along = (k: number) => (world[k] ?? 0) * nx + (world[k + 1] ?? 0) * ny + (world[k + 2] ?? 0) * nz;
  const [x, y, z] = [along(0), along(4), along(8)];
  const length = Math.sqrt(x * x + y * y + z * z) || 1;
  return [x / length, y / length, z / length];
}

/** Both sides with their lids, whose corners are their own: they look another way. */
function closed(
  above: CutSide,
  below: CutSide,
  { lids }: Caps,
  [x, y, z]: readonly [number, number, number],
): readonly [Side, Side] {
  const withLids = (side: CutSide, isUpper: boolean): Side => {
    const corners: Corner[] = [...side.corners];
    const triangles = [...side.triangles];
    for (const lid of lids) {
      const sign = isUpper === lid.isTurned ? 1 : -1;
      const normal: Facing['normal'] = [sign * x + 0, sign * y + 0, sign * z + 0];
      const numbers = new Map<number | Between, number>();
      const number = (at: number | Between) => {
        const known = numbers.get(at) ?? corners.length;
        if (known === corners.length) corners.push({ at, normal });
        numbers.set(at, known);
        return known;
      };
      for (const [a, b, c] of lid.triangles) triangles.push(...(isUpper ? [c, b, a] : [a, b, c]).map(number));
    }
    return { corners, triangles: Uint32Array.from(triangles) };
  };
  return [withLids(above, true), withLids(below, false)];
}
