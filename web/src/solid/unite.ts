// The solid that all parts of a model make together: each part's closed surfaces become solids, and Manifold (Lalish, the
// robust booleans of Smith and Dodgson 2007) unites them. A part that bounds no solid is named, and nothing is made.
import type { Manifold, ManifoldToplevel } from 'manifold-3d/manifold';
import { aligned } from './align';
import { crossings } from './crossing';
import type { Fault, Part, Solid, Triangles } from './types';
import { cross, dot, type ReadonlyVec } from './vectors';
import { boundsOf, joined, shells, turnedOver, volumeOf, weld } from './weld';

/** Of the model's diagonal: what rounding in a file may pull apart, and how deep an edge has to be through a face. */
const relative = { weld: 1e-6, crossing: 2e-6 } as const;
/** Of the cube of a part's diagonal: less is no solid. */
const flatness = 1e-9;

export interface United {
  /** Null where there is a fault that may not be left out, or nothing else. */
  readonly solid: Solid | null;
  readonly faults: readonly Fault[];
  /** Names of parts that were inside out and are not any more. */
  readonly turned: readonly string[];
}

type OnProgress = (done: number, total: number) => void;

/**
 * @param leaveOut whether parts that bound no solid are left out; else they are the answer
 * @param onProgress steps of the parts and of their union
 */
export function unite(
  parts: readonly Part[],
  { Manifold, Mesh }: ManifoldToplevel,
  leaveOut: boolean,
  onProgress: OnProgress,
): United {
  const { low, high } = boundsOf(joined(parts).positions);
  const centre = low.map((x, i) => (x + (high[i] as number)) / 2);
  const diagonal = Math.hypot(...low.map((x, i) => (high[i] as number) - x));
  const total = 2 * parts.length;
  const flush = aligned(
    parts.map(({ positions }) => positions),
    diagonal * relative.weld,
  );
  const placed = parts.map((part, i) => ({ ...part, positions: flush[i] ?? part.positions }));
  const faults: Fault[] = [];
  const turned: string[] = [];
  const solids: Manifold[] = [];
  /** About the centre of the model: what is handed over has seven digits. */
  const solidOf = ({ positions, triangles }: Triangles) => {
    const vertProperties = Float32Array.from(positions, (x, i) => x - (centre[i % 3] as number));
    return Manifold.ofMesh(new Mesh({ numProp: 3, vertProperties, triVerts: triangles }));
  };
  for (const [i, { name, pieces, fault }] of closed(placed, diagonal).entries()) {
    onProgress(i, total);
    if (fault !== null) faults.push(fault);
    else {
      const own = partSolid(name, pieces, diagonal, solidOf, (list) => Manifold.union(list));
      if ('kind' in own) faults.push(own);
      else {
        solids.push(own.solid);
        if (own.isTurned) turned.push(name);
      }
    }
  }
  if ((faults.length > 0 && !leaveOut) || solids.length === 0) return { solid: null, faults, turned };
  const whole = together(solids, Manifold, (done) =>
    onProgress(total / 2 + (done * parts.length) / solids.length, total),
  );
  return { solid: written(whole, centre), faults, turned };
}

interface Closed {
  readonly name: string;
  readonly pieces: readonly Triangles[];
  readonly fault: Fault | null;
}

/** The closed surfaces of each part; of parts of a node that are open, those that they make together. */
function* closedOf(parts: readonly Part[], diagonal: number): Generator<Closed> {
  const open = new Map<number, Part[]>();
  for (const part of parts) {
    const welded = weld(part, diagonal * relative.weld);
    if (welded.open > 0) open.set(part.node, [...(open.get(part.node) ?? []), part]);
    else if (welded.triangles.length === 0) yield { name: part.name, pieces: [], fault: flat(part.name) };
    else yield { name: part.name, pieces: shells(welded), fault: null };
  }
  for (const own of open.values()) {
    const welded = weld(joined(own), diagonal * relative.weld);
    const name = [...new Set(own.map((part) => part.name))].join(' and ');
    if (welded.open === 0 && welded.triangles.length > 0) yield { name, pieces: shells(welded), fault: null };
    else
      for (const part of own) {
        const edges = weld(part, diagonal * relative.weld).open;
        const text = `is open at ${edges} ${edges === 1 ? 'edge' : 'edges'}`;
        yield { name: part.name, pieces: [], fault: { name: part.name, kind: 'open', text } };
      }
  }
}
const closed = (parts: readonly Part[], diagonal: number) => [...closedOf(parts, diagonal)];

const flat = (name: string): Fault => ({ name, kind: 'flat', text: 'is a surface without thickness' });

/** What the surfaces of a part bound: those that face inwards, within another, are its hollows. */
function partSolid(
  name: string,
  pieces: readonly Triangles[],
  diagonal: number,
  solidOf: (mesh: Triangles) => Manifold,
  union: (solids: readonly Manifold[]) => Manifold,
): { readonly solid: Manifold; readonly isTurned: boolean } | Fault {
  const { low, high } = boundsOf(joined(pieces).positions);
  const least = flatness * Math.hypot(...low.map((x, i) => (high[i] as number) - x)) ** 3;
  const thick = pieces.filter((piece) => Math.abs(volumeOf(piece)) > least);
  if (thick.length === 0) return flat(name);
  for (const piece of thick) {
    if (crossings(piece, diagonal * relative.crossing) > 0)
      return { name, kind: 'crossing', text: 'runs through itself' };
  }
  const outer = thick.filter((piece) => volumeOf(piece) > 0);
  const inward = thick.filter((piece) => volumeOf(piece) < 0);
  const turn = (mesh: Triangles): Triangles => ({ ...mesh, triangles: turnedOver(mesh.triangles) });
  const hollows = inward.filter((piece) => outer.some((other) => isWithin(piece, other)));
  const insideOut = inward.filter((piece) => !hollows.includes(piece));
  const made = [...outer, ...insideOut.map(turn)].map(solidOf);
  const refused = made.map((solid) => solid.status()).find((status) => status !== 'NoError');
  if (refused !== undefined) return { name, kind: 'refused', text: `is no solid (${refused})` };
  const solid = hollows.reduce((left, hollow) => left.subtract(solidOf(turn(hollow))), union(made));
  return { solid, isTurned: insideOut.length > 0 };
}

/** Whether a corner of one surface is inside another: the winding number there (Jacobson et al. 2013) is about 1. */
function isWithin({ positions }: Triangles, around: Triangles): boolean {
  const [x = 0, y = 0, z = 0] = positions;
  const { triangles, positions: corners } = around;
  let angle = 0;
  for (let i = 0; i < triangles.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => {
      const at = 3 * (triangles[i + k] as number);
      return [(corners[at] as number) - x, (corners[at + 1] as number) - y, (corners[at + 2] as number) - z] as const;
    }) as [ReadonlyVec, ReadonlyVec, ReadonlyVec];
    const [la, lb, lc] = [a, b, c].map((v) => Math.hypot(...v)) as [number, number, number];
    // Van Oosterom and Strackee 1983: the solid angle of a triangle.
    const volume = dot(a, cross(b, c));
    angle += 2 * Math.atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * Math.PI) > 0.5;
}

/** Neighbours first: what lies side by side in a file lies side by side in space, and small solids are united fast. */
function together(
  solids: readonly Manifold[],
  { union }: { union(list: readonly Manifold[]): Manifold },
  onProgress: (done: number) => void,
): Manifold {
  const batch = 8;
  let done = 0;
  let level = solids;
  while (level.length > 1) {
    const next: Manifold[] = [];
    for (let i = 0; i < level.length; i += batch) {
      const one = union(level.slice(i, i + batch));
      one.numTri(); // Manifold is lazy: this makes it
      next.push(one);
      done += level === solids ? level.slice(i, i + batch).length : 0;
      onProgress(done);
    }
    level = next;
  }
  return level[0] as Manifold;
}

function written(whole: Manifold, centre: readonly number[]): Solid {
  const mesh = whole.getMesh();
  const idOf = Uint32Array.from({ length: mesh.numVert }, (_, i) => i);
  for (const [i, from] of (mesh.mergeFromVert ?? []).entries()) idOf[from] = mesh.mergeToVert[i] as number;
  const used = new Map<number, number>();
  const kept: number[] = [];
  const triangles = mesh.triVerts.map((vertex) => {
    const id = idOf[vertex] as number;
    const known = used.get(id);
    if (known !== undefined) return known;
    used.set(id, used.size);
    for (let k = 0; k < 3; k++)
      kept.push((mesh.vertProperties[id * mesh.numProp + k] as number) + (centre[k] as number));
    return used.size - 1;
  });
  const pieces = whole.decompose().filter((piece) => piece.volume() > 0).length;
  const positions = Float64Array.from(kept);
  return { positions, triangles: Uint32Array.from(triangles), volume: whole.volume(), ...boundsOf(positions), pieces };
}
