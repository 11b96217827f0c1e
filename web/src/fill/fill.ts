// Gaps that an edit has opened, filled (ParSEL, supplement §3.4): Poisson-disk samples around each gap, without what faced
// across it; screened Poisson reconstruction, which closes over what is missing; of its surface that which spans the gap,
// decimated by quadrics. Each new triangle belongs to the part that is nearer, and what its corners have besides places is
// taken from the nearest sample of that part.
//
// Unlike the paper, which builds everything anew, all that there was stays as it is: materials suffer, says the paper, and so
// do edges. A gap is left where the reconstruction does not reach from one part to the other.
import { MeshoptSimplifier } from 'meshoptimizer';
import { disjointSets } from '../solid/weld';
import { boundsOf, type Contact, type Parts, relative } from './gap';
import { PointGrid } from './points';
import { type Box, diskSamples, type Sample } from './samples';
import type { EditedPart, FilledGap, Patch, Place, Reconstruct, Unfilled } from './types';

/** Samples to the width of a gap. */
const fineness = 8;
/** Around a gap, in radii of samples, and in widths. */
const around = { radii: 10, widths: 2 } as const;
const mostSamples = 150_000;
const depths = { least: 5, most: 10 } as const;
/** Room around samples in the reconstruction's cube. */
const room = 1.1;
/** In radii of samples: farther from all of them is new surface. */
const supported = 1.6;
/** Of decimation, in radii. */
const coarseness = 0.1;

type Point = readonly [number, number, number];

/** @param contact whose width is a gap */
export function fillGap(parts: Parts, contact: Contact, reconstruct: Reconstruct): FilledGap {
  const { parts: pair, width } = contact;
  const leave = (left: Unfilled): FilledGap => ({ parts: pair, width, patches: [], left });
  const across = width + contact.distance;
  const box = grown(boundsOf(contact.points.flatMap((list) => list.flatMap(({ at }) => at))), 0);
  const longest = Math.max(...box.high.map((x, k) => x - (box.low[k] as number)));
  let radius = Math.max(across / fineness, (longest * room) / 2 ** depths.most);
  let sampled = samplesAround(parts, contact, box, across, radius);
  for (; sampled.kept.length > mostSamples; sampled = samplesAround(parts, contact, box, across, radius)) radius *= 1.5;
  const { kept, facing } = sampled;
  if (facing.some((list) => list.length === 0)) return leave('nothing of one faces the other');
  const rebuilt = rebuild(kept, radius, reconstruct);
  const spanning = span(rebuilt, kept, facing, radius, across);
  if (spanning.length === 0) return leave('what was built anew does not reach across');
  return { parts: pair, width, patches: patches(pair, rebuilt.positions, spanning, kept, facing, radius), left: '' };
}

interface Sampled {
  /** What the surface is rebuilt from. */
  readonly kept: readonly Sample[];
  /** What faces across the gap, of either part. */
  readonly facing: readonly [readonly Sample[], readonly Sample[]];
}

function samplesAround(parts: Parts, contact: Contact, box: Box, across: number, radius: number): Sampled {
  const reach = around.widths * across + around.radii * radius;
  const near = new PointGrid(reach);
  for (const list of contact.points) for (const { at } of list) near.add(...at);
  // A neck between round parts has to be about as wide as it is long.
  const within =
    contact.distance + Math.max(relative.narrowest * parts.scale, Math.min(across, relative.touching * parts.scale));
  const kept: Sample[] = [];
  const facing = contact.parts.map((own, i) => {
    const found: Sample[] = [];
    const { edited } = parts.list[own] as EditedPart;
    for (const sample of diskSamples(own, edited, grown(box, reach), radius, (...at) => near.near(...at))) {
      const faced = parts.faced(sample, contact.parts[1 - i] as number, within);
      (faced ? found : kept).push(sample);
    }
    return found;
  }) as unknown as Sampled['facing'];
  return { kept, facing };
}

const grown = ({ low, high }: Box, by: number): Box => ({
  low: low.map((x) => x - by),
  high: high.map((x) => x + by),
});

interface Rebuilt {
  readonly positions: Float64Array;
  readonly triangles: Uint32Array;
}

function rebuild(samples: readonly Sample[], radius: number, reconstruct: Reconstruct): Rebuilt {
  const { low, high } = boundsOf(samples.flatMap(({ at }) => at));
  const side = room * Math.max(...high.map((x, k) => x - (low[k] as number)));
  const origin = low.map((x, k) => (x + (high[k] as number) - side) / 2);
  const depth = Math.min(depths.most, Math.max(depths.least, Math.ceil(Math.log2(side / radius))));
  const values = new Float32Array(6 * samples.length);
  for (const [i, { at, normal }] of samples.entries()) {
    values.set(
      at.map((x, k) => (x - (origin[k] as number)) / side),
      6 * i,
    );
    values.set(normal, 6 * i + 3);
  }
  const { positions, triangles } = reconstruct(values, depth);
  return { positions: Float64Array.from(positions, (x, i) => x * side + (origin[i % 3] as number)), triangles };
}

/** The triangles of each piece of new surface that reaches from one part to the other. */
function span(
  { positions, triangles }: Rebuilt,
  kept: readonly Sample[],
  facing: Sampled['facing'],
  radius: number,
  across: number,
): Uint32Array {
  const count = positions.length / 3;
  const at = (i: number) => positions.subarray(3 * i, 3 * i + 3) as unknown as [number, number, number];
  const support = new PointGrid(supported * radius);
  for (const sample of kept) support.add(...sample.at);
  const reach = 2 * across + 4 * radius;
  const grids = facing.map((list) => {
    const grid = new PointGrid(reach);
    for (const sample of list) grid.add(...sample.at);
    return grid;
  });
  /** The sample that holds a corner, or -1 of new surface. */
  const holder = Int32Array.from({ length: count }, (_, i) => support.nearest(...at(i)));
  const between = Array.from({ length: count }, (_, i) => {
    const [a, b] = grids.map((grid) => grid.nearest(...at(i))) as [number, number];
    if (a < 0 || b < 0) return false;
    const [p, q] = [facing[0][a]?.at as Point, facing[1][b]?.at as Point];
    const direct = Math.hypot(...p.map((x, k) => x - (q[k] as number)));
    const [da, db] = grids.map((grid, k) => grid.distance(k === 0 ? a : b, ...at(i))) as [number, number];
    return da + db <= 1.5 * direct + 4 * radius;
  });
  const fresh: number[] = [];
  for (let t = 0; t < triangles.length; t += 3) {
    const own = [...triangles.subarray(t, t + 3)];
    if (own.some((i) => holder[i] === -1) && own.every((i) => between[i])) fresh.push(...own);
  }
  // Pieces that hang together, and the parts that hold them.
  const { find, join } = disjointSets(count);
  for (let t = 0; t < fresh.length; t += 3) {
    for (let k = 1; k < 3; k++) join(fresh[t + k] as number, fresh[t] as number);
  }
  const held = new Map<number, Set<number>>();
  for (const i of fresh) {
    const sample = kept[holder[i] as number];
    if (sample === undefined) continue;
    const piece = find(i);
    held.set(piece, (held.get(piece) ?? new Set()).add(sample.part));
  }
  const spanning: number[] = [];
  for (let t = 0; t < fresh.length; t += 3) {
    if (held.get(find(fresh[t] as number))?.size === 2) spanning.push(...fresh.slice(t, t + 3));
  }
  return Uint32Array.from(spanning);
}

function patches(
  pair: readonly [number, number],
  positions: Float64Array,
  spanning: Uint32Array,
  kept: readonly Sample[],
  facing: Sampled['facing'],
  radius: number,
): Patch[] {
  const { low } = boundsOf(positions);
  const near = Float32Array.from(positions, (x, i) => x - (low[i % 3] as number));
  const [decimated] = MeshoptSimplifier.simplify(spanning, near, 3, 0, coarseness * radius, [
    'LockBorder',
    'ErrorAbsolute',
  ]);
  const at = (i: number) => positions.subarray(3 * i, 3 * i + 3) as unknown as [number, number, number];
  // Wide cells: what is nearest is asked for far from samples, too.
  const own = pair.map((part, i) => [...kept.filter((sample) => sample.part === part), ...(facing[i] ?? [])]);
  const nearest = own.map((list) => nearestOf(list, radius));
  const triangles: [number[], number[]] = [[], []];
  for (let t = 0; t < decimated.length; t += 3) {
    const corners = [...decimated.subarray(t, t + 3)];
    const centre = [0, 1, 2].map(
      (k) => corners.reduce((sum, i) => sum + (at(i)[k] as number), 0) / 3,
    ) as unknown as Point;
    const [a, b] = nearest.map((find) => find(centre).distance) as [number, number];
    triangles[a <= b ? 0 : 1].push(...corners);
  }
  return pair.flatMap((part, i): Patch[] => {
    const list = triangles[i as 0 | 1];
    if (list.length === 0) return [];
    const ids = new Map<number, number>();
    const places: Place[] = [];
    const points: number[] = [];
    const renumbered = list.map((corner) => {
      const known = ids.get(corner);
      if (known !== undefined) return known;
      ids.set(corner, ids.size);
      points.push(...at(corner));
      const { sample } = (nearest[i] as ReturnType<typeof nearestOf>)(at(corner));
      places.push({ part, triangle: sample.triangle, weights: sample.weights });
      return ids.size - 1;
    });
    return [{ part, positions: Float64Array.from(points), triangles: Uint32Array.from(renumbered), places }];
  });
}

/** The nearest of a list however far, by grids that grow wider. */
function nearestOf(list: readonly Sample[], radius: number) {
  const grids: PointGrid[] = [];
  const grid = (level: number) => {
    const known = grids[level];
    if (known !== undefined) return known;
    const made = new PointGrid(radius * 4 ** level * 2);
    for (const { at } of list) made.add(...at);
    grids[level] = made;
    return made;
  };
  return (at: Point) => {
    for (let level = 0; ; level++) {
      const id = grid(level).nearest(...at);
      if (id >= 0) return { sample: list[id] as Sample, distance: grid(level).distance(id, ...at) };
    }
  };
}
