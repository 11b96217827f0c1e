// Several primitives of one material as one, in the frame of the first. Where closed ones lie face to face, as the two sides
// of a cut do, these faces are inside and go.
import type { Accessor, Document, Primitive, TypedArray } from '@gltf-transform/core';
import { closedPieces } from './caps';
import { pieces, places, triangleList, trianglesOf } from './geometry';
import { apply, cofactors, determinant, type Matrix, relative } from './matrix';
import { CarveError } from './steps';

export interface Joinable {
  readonly primitive: Primitive;
  readonly node: { getName(): string; getWorldMatrix(): Matrix };
}

/** Throws a CarveError when they are of several materials, or their corners do not carry the same. */
export function joined(document: Document, parts: readonly Joinable[]): Primitive {
  const [first, ...others] = parts;
  if (first === undefined) throw new CarveError('There is nothing to join. Select several parts.');
  const material = first.primitive.getMaterial();
  const semantics = first.primitive.listSemantics();
  for (const { primitive } of others) {
    if (primitive.getMaterial() !== material)
      throw new CarveError('These parts are of several materials, and a part has one. Join those of one material.');
    const own = primitive.listSemantics();
    if (own.length !== semantics.length || !semantics.every((semantic) => own.includes(semantic)))
      throw new CarveError(
        'The corners of these parts do not carry the same: normals, texture or colours. Join parts that are alike.',
      );
  }
  const to = first.node.getWorldMatrix();
  const frames = parts.map(({ node, primitive }) => {
    const matrix = relative(to, node.getWorldMatrix());
    const count = primitive.getAttribute('POSITION')?.getCount() ?? 0;
    return { primitive, matrix, count, turned: determinant(matrix) < 0 };
  });
  const made = first.primitive.clone().setMode(triangleList);
  for (const semantic of semantics) made.setAttribute(semantic, merged(frames, semantic));
  const lists: Uint32Array<ArrayBuffer>[] = [];
  let total = 0;
  for (const { primitive, count, turned } of frames) {
    const own = trianglesOf(primitive).map((corner) => corner + total);
    for (let i = 0; turned && i < own.length; i += 3) own.subarray(i + 1, i + 3).reverse();
    lists.push(own);
    total += count;
  }
  const position = made.getAttribute('POSITION');
  const indices = position === null ? lists.flatMap((list) => [...list]) : withoutInner(lists, places(position));
  const array = total < 65535 ? Uint16Array.from(indices) : Uint32Array.from(indices);
  return made.setIndices(document.createAccessor().setType('SCALAR').setArray(array));
}

/** The triangles of all, without those of closed ones that lie back to back. */
function withoutInner(lists: readonly Uint32Array<ArrayBuffer>[], place: Uint32Array): number[] {
  const at = (list: Uint32Array, i: number) => place[list[i] ?? 0] ?? 0;
  /** By places in order, of triangles that face one way and the other: the lists that have them. */
  const facing = new Map<string, [number[], number[]]>();
  const keyOf = (list: Uint32Array, i: number): readonly [key: string, sense: 0 | 1] => {
    const [a, b, c] = [at(list, i), at(list, i + 1), at(list, i + 2)];
    const isEven = (a < b && b < c) || (b < c && c < a) || (c < a && a < b);
    return [[a, b, c].sort((x, y) => x - y).join(), isEven ? 0 : 1];
  };
  for (const [l, list] of lists.entries()) {
    const { of, count } = pieces(list, place);
    const closed = closedPieces(list, place, of, count);
    for (let t = 0; t < of.length; t++) {
      if (closed[of[t] ?? 0] !== 1) continue;
      const [key, sense] = keyOf(list, 3 * t);
      const both = facing.get(key) ?? [[], []];
      both[sense].push(l);
      facing.set(key, both);
    }
  }
  const left: number[] = [];
  for (const [l, list] of lists.entries())
    for (let i = 0; i < list.length; i += 3) {
      const [key, sense] = keyOf(list, i);
      const [own, other] = [facing.get(key)?.[sense] ?? [], facing.get(key)?.[sense === 0 ? 1 : 0] ?? []];
      const isInner = own.length === 1 && other.length === 1 && own[0] === l && other[0] !== l;
      if (!isInner) left.push(list[i] ?? 0, list[i + 1] ?? 0, list[i + 2] ?? 0);
    }
  return left;
}

interface Frame {
  readonly primitive: Primitive;
  readonly matrix: Matrix;
  readonly count: number;
  readonly turned: boolean;
}

const isTurned = (semantic: string) => ['POSITION', 'NORMAL', 'TANGENT'].includes(semantic);

function merged(frames: readonly Frame[], semantic: string): Accessor {
  const sources = frames.map(({ primitive }) => primitive.getAttribute(semantic)).filter((one) => one !== null);
  const [first] = sources;
  if (first === undefined) throw new CarveError('This part has no corners. Export the model again.');
  const total = frames.reduce((sum, { count }) => sum + count, 0);
  const kindOf = (accessor: Accessor) =>
    `${accessor.getComponentType()} ${accessor.getType()} ${accessor.getNormalized()}`;
  if (!isTurned(semantic) && sources.every((source) => kindOf(source) === kindOf(first))) {
    const arrays = sources.map((source) => source.getArray()).filter((array) => array !== null);
    const kind = (first.getArray() as TypedArray).constructor as new (length: number) => TypedArray;
    const all = new kind(total * first.getElementSize());
    let at = 0;
    for (const array of arrays) {
      all.set(array, at);
      at += array.length;
    }
    return first.clone().setArray(all);
  }
  const size = Math.max(...sources.map((source) => source.getElementSize()));
  const all = new Float32Array(total * size).fill(1); // the opacity of colours without one
  const element: number[] = [];
  let at = 0;
  for (const [i, source] of sources.entries()) {
    const frame = frames[i];
    for (let k = 0; k < source.getCount(); k++, at += size) {
      source.getElement(k, element);
      all.set(frame === undefined || !isTurned(semantic) ? element : turnedBy(frame, semantic, element), at);
    }
  }
  const type = sources.find((source) => source.getElementSize() === size)?.getType() ?? first.getType();
  return first.clone().setType(type).setNormalized(false).setArray(all);
}

/** A place, a normal or a tangent in the frame of the first part. */
function turnedBy({ matrix, turned }: Frame, semantic: string, element: readonly number[]): number[] {
  if (semantic === 'POSITION') return apply(matrix, element);
  const [x = 0, y = 0, z = 0, w = 1] = element;
  const c = cofactors(matrix);
  // Cofactors turn what stands across; a mirror image of it looks the other way, as its triangles do.
  const sign = turned ? -1 : 1;
  const along =
    semantic === 'NORMAL'
      ? [0, 1, 2].map((row) => sign * ((c[row] ?? 0) * x + (c[3 + row] ?? 0) * y + (c[6 + row] ?? 0) * z))
      : [0, 1, 2].map((row) => (matrix[row] ?? 0) * x + (matrix[4 + row] ?? 0) * y + (matrix[8 + row] ?? 0) * z);
  const length = Math.hypot(...along) || 1;
  const unit = along.map((value) => value / length);
  return semantic === 'NORMAL' ? unit : [...unit, turned ? -w : w];
}
