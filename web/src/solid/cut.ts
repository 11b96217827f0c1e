// What differences and intersections of a CAD program leave of each part that adds material.
import type { Manifold, ManifoldToplevel } from 'manifold-3d/manifold';
import { aligned } from './align';
import { type CadProgram, type CadTree, meshOf, millimetresOf, withValues } from './cad';
import { stepsOf } from './steps';
import type { Triangles } from './types';
import { boundsOf, type Welded, weld } from './weld';

/** Between faces that meet more flatly than this the surface is drawn smooth; round parts have 48 sides. Degrees. */
const smoothBelow = 10;
/** What rounding pulls apart: of the diagonal, and in millimetres, as the core writes whole micrometres. */
const rounding = { relative: 1e-6, absolute: 1.1e-3 } as const;

/** Corners of their own for every triangle that is not smooth with its neighbours. */
export interface Drawn {
  /** Three numbers a corner: millimetres, z up. */
  readonly positions: Float64Array;
  /** Unit vectors. */
  readonly normals: Float64Array;
  readonly triangles: Uint32Array;
}

export interface State {
  /** Of the program's parameters: see withValues(). */
  readonly values: Readonly<Record<string, number>>;
  /** Ids of parts that are not there. */
  readonly absent: ReadonlySet<string>;
}

/** Of parts that are cut, by id: what is left of each, and its volume in cubic millimetres. */
export type Cuts = ReadonlyMap<string, { readonly drawn: Drawn; readonly volume: number }>;

/**
 * @param parts the parts that add material, by id, where and how they are now; those that are no closed surface stay whole
 */
export function cutParts(
  program: CadProgram,
  parts: ReadonlyMap<string, Triangles>,
  { values, absent }: State,
  { Manifold, Mesh }: ManifoldToplevel,
): Cuts {
  const meshes = solidsOf(program, parts, values, absent);
  const { low, high } = boundsOf([...meshes.values()].flatMap(({ positions }) => [...positions]));
  const centre = low.map((x, i) => (x + (high[i] as number)) / 2);
  const garbage: Manifold[] = [];
  const keep = (made: Manifold) => {
    garbage.push(made);
    return made;
  };
  const solidOf = (id: string): Manifold | null => {
    const mesh = meshes.get(id);
    if (mesh === undefined || mesh.open > 0) return null;
    const vertProperties = Float32Array.from(mesh.positions, (x, i) => x - (centre[i % 3] as number));
    const made = keep(Manifold.ofMesh(new Mesh({ numProp: 3, vertProperties, triVerts: mesh.triangles })));
    return made.status() === 'NoError' ? made : null;
  };
  /** Null: nothing is there. */
  const evaluated = new Map<CadTree, Manifold | null>();
  const evaluate = (node: CadTree): Manifold | null => {
    const known = evaluated.get(node);
    if (known !== undefined) return known;
    const made = build(node);
    evaluated.set(node, made);
    return made;
  };
  const together = (nodes: readonly CadTree[]): Manifold | null => {
    const solids = nodes.map(evaluate).filter((solid) => solid !== null);
    return solids.length === 0 ? null : keep(Manifold.union(solids));
  };
  const build = (node: CadTree): Manifold | null => {
    if (typeof node === 'string') return solidOf(node);
    const [op, ...children] = node;
    if (op === 'union') return together(children);
    const first = children[0] === undefined ? null : evaluate(children[0]);
    const others = children.slice(1);
    if (first === null) return null;
    if (op === 'difference') {
      const less = together(others);
      return less === null ? first : keep(first.subtract(less));
    }
    const each = others.map(evaluate).filter((solid) => solid !== null);
    return each.length < others.length ? null : keep(Manifold.intersection([first, ...each]));
  };

  const found = new Map<string, { readonly drawn: Drawn; readonly volume: number }>();
  try {
    for (const [id, steps] of stepsOf(program.tree)) {
      let left = solidOf(id);
      if (left === null) continue;
      for (const { op, by } of steps) {
        const other: Manifold | null = together(by);
        if (op === 'subtract') left = other === null ? left : keep(left.subtract(other));
        else left = other === null ? keep(left.subtract(left)) : keep(left.intersect(other));
      }
      found.set(id, { drawn: drawnOf(keep(left.calculateNormals(0, smoothBelow)), centre), volume: left.volume() });
    }
  } finally {
    for (const made of garbage) made.delete();
  }
  return found;
}

/** Every part that is there, welded, with faces that should lie in one plane in one plane. */
function solidsOf(
  program: CadProgram,
  parts: ReadonlyMap<string, Triangles>,
  values: State['values'],
  absent: State['absent'],
): ReadonlyMap<string, Welded> {
  const unit = millimetresOf(program);
  const there = new Map<string, Triangles>();
  for (const part of program.parts) {
    if (absent.has(part.id)) continue;
    const mesh = part.role === 'add' ? parts.get(part.id) : meshOf(withValues(part, values), unit);
    if (mesh !== undefined) there.set(part.id, mesh);
  }
  const all = [...there.values()].map(({ positions }) => positions);
  const { low, high } = boundsOf(all.flatMap((positions) => [...positions]));
  const diagonal = Math.hypot(...low.map((x, i) => (high[i] as number) - x));
  const tolerance = Math.max(rounding.absolute, rounding.relative * diagonal);
  const flush = aligned(all, tolerance);
  return new Map(
    [...there].map(([id, { triangles }], i) => [
      id,
      weld({ positions: flush[i] as Float64Array, triangles }, tolerance),
    ]),
  );
}

function drawnOf(solid: Manifold, centre: readonly number[]): Drawn {
  const { numProp, vertProperties, triVerts, numVert } = solid.getMesh(0);
  const positions = new Float64Array(3 * numVert);
  const normals = new Float64Array(3 * numVert);
  for (let i = 0; i < numVert; i++) {
    for (let k = 0; k < 3; k++) {
      positions[3 * i + k] = (vertProperties[numProp * i + k] as number) + (centre[k] as number);
      normals[3 * i + k] = vertProperties[numProp * i + 3 + k] as number;
    }
  }
  return { positions, normals, triangles: Uint32Array.from(triVerts) };
}
