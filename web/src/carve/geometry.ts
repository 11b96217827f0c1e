// Triangles of a primitive with all that their corners carry, and how corners between two others are made.
import type { Accessor, Primitive, TypedArray } from '@gltf-transform/core';
import { CarveError } from './steps';

/** Three indices into the corners a triangle. */
export type Triangles = Uint32Array<ArrayBuffer>;

/** Modes of glTF. */
export const triangleList = 4;
const [triangleStrip, triangleFan] = [5, 6];

/** The triangles of a list, strip or fan; those without area in a strip stay away. */
export function trianglesOf(primitive: Primitive): Triangles {
  const count = primitive.getAttribute('POSITION')?.getCount() ?? 0;
  const list = primitive.getIndices()?.getArray() ?? Uint32Array.from({ length: count }, (_, i) => i);
  const mode = primitive.getMode();
  if (mode === triangleList) return Uint32Array.from(list.subarray(0, list.length - (list.length % 3)));
  const isFan = mode === triangleFan;
  if (!isFan && mode !== triangleStrip) throw new CarveError('Points and lines cannot be cut. Choose another part.');
  const found: number[] = [];
  for (let i = 2; i < list.length; i++) {
    const [a, b, c] = [list[isFan ? 0 : i - 2] ?? 0, list[i - 1] ?? 0, list[i] ?? 0];
    if (a === b || b === c || a === c) continue;
    if (isFan || i % 2 === 0) found.push(a, b, c);
    else found.push(b, a, c);
  }
  return Uint32Array.from(found);
}

/** A corner between two others: a share of the way from one to the other. */
export interface Between {
  readonly from: number;
  readonly to: number;
  readonly share: number;
}

/** A corner of what closes a cut: where another is, with all that that carries, but for which way it looks. */
export interface Facing {
  readonly at: number | Between;
  /** Of length 1, in the part's own frame. */
  readonly normal: readonly [number, number, number];
}

export type Corner = number | Between | Facing;

const isFacing = (corner: Corner): corner is Facing => typeof corner !== 'number' && 'normal' in corner;

/** Semantics whose elements have length 1 in their first three components. */
const isDirection = (semantic: string) => semantic === 'NORMAL' || semantic === 'TANGENT';

/**
 * An accessor of chosen corners, as they are stored, and of those between others, interpolated.
 * @param corners what element i is: a corner, a place between two, or one of these that looks another way
 */
export function chosen(source: Accessor, semantic: string, corners: readonly Corner[]): Accessor {
  const array = source.getArray();
  if (array === null) throw new CarveError('This part has no corners. Export the model again.');
  const size = source.getElementSize();
  const isMade = corners.some((corner) => typeof (isFacing(corner) ? corner.at : corner) !== 'number');
  // Places that were rounded to a grid of the file would leave the plane.
  const isExact = isMade && semantic === 'POSITION' && !(array instanceof Float32Array);
  const kind = array.constructor as new (length: number) => TypedArray;
  const made = source
    .clone()
    .setArray(isExact ? new Float32Array(size * corners.length) : new kind(size * corners.length));
  if (isExact) made.setNormalized(false);
  const target = made.getArray() as TypedArray;
  const [element, a, b]: [number[], number[], number[]] = [[], [], []];
  for (const [i, one] of corners.entries()) {
    const corner = isFacing(one) ? one.at : one;
    if (isFacing(one) && isDirection(semantic)) {
      made.setElement(i, looking(one, semantic, source, element));
    } else if (typeof corner === 'number' && !isExact) {
      for (let c = 0; c < size; c++) target[size * i + c] = array[size * corner + c] ?? 0;
    } else if (typeof corner === 'number') made.setElement(i, source.getElement(corner, element));
    else made.setElement(i, between(source, semantic, corner, element, a, b));
  }
  return made;
}

/** The normal, or a tangent across it. */
function looking({ at, normal }: Facing, semantic: string, source: Accessor, element: number[]): number[] {
  if (semantic === 'NORMAL') return [...normal];
  source.getElement(typeof at === 'number' ? at : at.from, element);
  const [x, y, z] = normal;
  // Across the normal and the axis that it is least along.
  const least = Math.min(Math.abs(x), Math.abs(y), Math.abs(z));
  const across = Math.abs(x) === least ? [0, z, -y] : Math.abs(y) === least ? [-z, 0, x] : [y, -x, 0];
  const length = Math.sqrt(across.reduce((sum, value) => sum + value * value, 0)) || 1;
  return [...across.map((value) => value / length), element[3] ?? 1];
}

function between(
  source: Accessor,
  semantic: string,
  { from, to, share }: Between,
  out: number[],
  a: number[],
  b: number[],
): number[] {
  source.getElement(from, a);
  source.getElement(to, b);
  for (let c = 0; c < a.length; c++) out[c] = (a[c] ?? 0) + share * ((b[c] ?? 0) - (a[c] ?? 0));
  if (isDirection(semantic)) {
    const length = Math.hypot(out[0] ?? 0, out[1] ?? 0, out[2] ?? 0) || 1;
    for (let c = 0; c < 3; c++) out[c] = (out[c] ?? 0) / length;
    if (semantic === 'TANGENT') out[3] = a[3] ?? 1; // which way round the texture goes has no middle
  }
  return out;
}

/**
 * The corners at which triangles have one place: of each corner, the first of them.
 * @param cell what is rounded to one multiple of it, in the file's own unit, is one place; 0: positions to the bit
 */
export function places(position: Accessor, cell = 0): Uint32Array {
  const first = new Map<string, number>();
  const of = new Uint32Array(position.getCount());
  const element: number[] = [];
  for (let i = 0; i < of.length; i++) {
    const key = position
      .getElement(i, element)
      .map((value) => (cell > 0 ? Math.round(value / cell) : value) + 0)
      .join(); // −0 is 0
    const known = first.get(key);
    if (known === undefined) first.set(key, i);
    of[i] = known ?? i;
  }
  return of;
}

/**
 * Numbers triangles by what hangs together across edges, in the order of their first triangles.
 * @param place by corner
 */
export function pieces(triangles: Triangles, place: Uint32Array): { readonly of: Uint32Array; readonly count: number } {
  const size = triangles.length / 3;
  const parent = Uint32Array.from({ length: size }, (_, i) => i);
  const root = (i: number): number => {
    let at = i;
    while (parent[at] !== at) {
      parent[at] = parent[parent[at] ?? 0] ?? 0;
      at = parent[at] ?? 0;
    }
    return at;
  };
  const beside = new Map<number, number>();
  const corners = place.length;
  for (let t = 0; t < size; t++)
    for (let k = 0; k < 3; k++) {
      const a = place[triangles[3 * t + k] ?? 0] ?? 0;
      const b = place[triangles[3 * t + ((k + 1) % 3)] ?? 0] ?? 0;
      if (a === b) continue;
      const edge = Math.min(a, b) * corners + Math.max(a, b);
      const other = beside.get(edge);
      if (other === undefined) beside.set(edge, t);
      else {
        const [one, two] = [root(other), root(t)];
        parent[Math.max(one, two)] = Math.min(one, two);
      }
    }
  const number = new Map<number, number>();
  const of = Uint32Array.from({ length: size }, (_, t) => {
    const top = root(t);
    const known = number.get(top) ?? number.size;
    number.set(top, known);
    return known;
  });
  return { of, count: number.size };
}
