// The geometric operators as displacement maps: p' = p + t + L·(p − o), so that an amount of 0 moves nothing, not even by
// a rounding error. ParSEL supplement table 2; the same table is in core/edit/operators.h.
import type { GeometricStatement, LocalTriple } from './types';

/** The map of one statement: L row by row (9), o (3), t (3). */
export const mapSize = 15;
/** The references of one statement: origin, direction (or axis), normal. */
export const referenceSize = 9;
export const originAt = 0;
export const directionAt = 3;
export const normalAt = 6;

/** Bit k is set when corner k belongs to the feature. */
export function featureMask(feature: LocalTriple): number {
  let mask = 0;
  for (let k = 0; k < 8; ++k) {
    if (feature.every((sign, i) => sign === 0 || sign === ((k >> i) & 1 ? 1 : -1))) mask |= 1 << k;
  }
  return mask;
}

/** Moves those of `count` points that `mask` selects; point i stands at points[start + 3·i], and counts as corner i mod 8. */
export function applyMap(map: Float64Array, points: Float64Array, start: number, count: number, mask: number): void {
  const l0 = map[0] as number;
  const l1 = map[1] as number;
  const l2 = map[2] as number;
  const l3 = map[3] as number;
  const l4 = map[4] as number;
  const l5 = map[5] as number;
  const l6 = map[6] as number;
  const l7 = map[7] as number;
  const l8 = map[8] as number;
  const ox = map[9] as number;
  const oy = map[10] as number;
  const oz = map[11] as number;
  const tx = map[12] as number;
  const ty = map[13] as number;
  const tz = map[14] as number;
  for (let i = 0, at = start; i < count; ++i, at += 3) {
    if (((mask >> (i & 7)) & 1) === 0) continue;
    const px = points[at] as number;
    const py = points[at + 1] as number;
    const pz = points[at + 2] as number;
    const x = px - ox;
    const y = py - oy;
    const z = pz - oz;
    points[at] = px + tx + l0 * x + l1 * y + l2 * z;
    points[at + 1] = py + ty + l3 * x + l4 * y + l5 * z;
    points[at + 2] = pz + tz + l6 * x + l7 * y + l8 * z;
  }
}

/**
 * A closure that writes a statement's map from its amount, slots[slot], and its references, refs[at … at + 8]. A reference
 * without a direction is the zero vector; the map then moves nothing.
 */
export function compileMap(
  statement: GeometricStatement,
  map: Float64Array,
  slots: Float64Array,
  slot: number,
  refs: Float64Array,
  at: number,
): () => void {
  const origin = at + originAt;
  const direction = at + directionAt;
  const normal = at + normalAt;
  switch (statement.op) {
    case 'translate':
      return () => {
        const a = slots[slot] as number;
        map.fill(0);
        for (let i = 0; i < 3; ++i) map[12 + i] = a * (refs[direction + i] as number);
      };
    case 'rotate':
      return () => writeRotation(map, slots, slot, refs, origin, direction);
    case 'scale_1d':
      return () => writeOuter(map, slots, slot, refs, origin, direction, direction);
    case 'scale_2d':
      return () => writeFlattening(map, slots, slot, refs, origin, normal);
    case 'scale_3d':
      return () => {
        const a = slots[slot] as number;
        begin(map, refs, origin);
        for (let i = 0; i < 3; ++i) map[4 * i] = a;
      };
    case 'shear':
      return () => writeOuter(map, slots, slot, refs, origin, direction, normal);
  }
}

function begin(map: Float64Array, refs: Float64Array, origin: number): void {
  map.fill(0);
  for (let i = 0; i < 3; ++i) map[9 + i] = refs[origin + i] as number;
}

/** L = a · d nᵀ: scale_1d with d = n, and shear. */
function writeOuter(
  map: Float64Array,
  slots: Float64Array,
  slot: number,
  refs: Float64Array,
  origin: number,
  direction: number,
  normal: number,
): void {
  const a = slots[slot] as number;
  begin(map, refs, origin);
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) map[3 * i + j] = a * (refs[direction + i] as number) * (refs[normal + j] as number);
  }
}

/** L = a · (I − n nᵀ). */
function writeFlattening(
  map: Float64Array,
  slots: Float64Array,
  slot: number,
  refs: Float64Array,
  origin: number,
  normal: number,
): void {
  const a = slots[slot] as number;
  begin(map, refs, origin);
  if (refs[normal] === 0 && refs[normal + 1] === 0 && refs[normal + 2] === 0) return;
  for (let i = 0; i < 3; ++i) {
    for (let j = 0; j < 3; ++j) {
      map[3 * i + j] = a * ((i === j ? 1 : 0) - (refs[normal + i] as number) * (refs[normal + j] as number));
    }
  }
}

/** L = R(n, a) − I = sin(a)·[n]× + (1 − cos(a))·(n nᵀ − I), Rodrigues. */
function writeRotation(
  map: Float64Array,
  slots: Float64Array,
  slot: number,
  refs: Float64Array,
  origin: number,
  axis: number,
): void {
  const a = slots[slot] as number;
  begin(map, refs, origin);
  const x = refs[axis] as number;
  const y = refs[axis + 1] as number;
  const z = refs[axis + 2] as number;
  if (x === 0 && y === 0 && z === 0) return;
  const s = Math.sin(a);
  const c = 1 - Math.cos(a);
  map[0] = c * (x * x - 1);
  map[1] = c * x * y - s * z;
  map[2] = c * x * z + s * y;
  map[3] = c * x * y + s * z;
  map[4] = c * (y * y - 1);
  map[5] = c * y * z - s * x;
  map[6] = c * x * z - s * y;
  map[7] = c * y * z + s * x;
  map[8] = c * (z * z - 1);
}
