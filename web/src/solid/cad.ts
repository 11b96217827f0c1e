// The parts of a CAD program as meshes, for what cuts others: as the core draws them (core/cad/cad_mesh.cpp), in the frame of
// OpenSCAD, z up, in millimetres.
import type { Triangles } from './types';

/** `parsel/cad` v1, as far as it is needed here: its frame is glTF's, its unit the program's. */
export interface CadProgram {
  readonly unit: string;
  readonly parts: readonly CadPart[];
  /** Absent: the union of all parts. */
  readonly tree?: CadTree;
}
export type CadTree = string | readonly ['union' | 'difference' | 'intersection', ...CadTree[]];

export interface CadPart {
  readonly id: string;
  readonly kind: 'box' | 'cylinder' | 'cone' | 'sphere' | 'opaque';
  /** "y", with a sign where its ends differ: "y+". */
  readonly axis?: string;
  readonly centre: readonly number[];
  readonly size: readonly number[];
  /** Of a cone. */
  readonly top?: number;
  readonly sides?: number;
  /** Quarter turns. */
  readonly phase?: number;
  readonly role: 'add' | 'cut' | 'meet';
}

const roundSides = 48;
const sphereRings = 24;

/** Millimetres of one unit of the program. */
export const millimetresOf = ({ unit }: CadProgram): number => ({ m: 1000, cm: 10, in: 25.4 })[unit] ?? 1;

/**
 * A part with other numbers.
 * @param values by names such as "seat.cx", "seat.sy", "neck.top"; what is not among them stays
 */
export function withValues(part: CadPart, values: Readonly<Record<string, number>>): CadPart {
  const triple = (letter: string, given: readonly number[]) =>
    ['x', 'y', 'z'].map((axis, i) => values[`${part.id}.${letter}${axis}`] ?? given[i] ?? 0);
  const size = triple('s', part.size);
  const share = values[`${part.id}.r_top`]; // a cone's top in the paper's vocabulary: radius by base diameter
  const base = size[(axisOf(part) + 1) % 3] ?? 0;
  const top = values[`${part.id}.top`] ?? (share === undefined ? part.top : 2 * share * base);
  return { ...part, centre: triple('c', part.centre), size, ...(top === undefined ? {} : { top }) };
}

/** @param unit millimetres of one unit */
export function meshOf(part: CadPart, unit: number): Triangles {
  const made =
    part.kind === 'sphere' ? sphere() : part.kind === 'cylinder' || part.kind === 'cone' ? round(part) : box();
  const positions = new Float64Array(made.positions.length);
  for (let i = 0; i < positions.length; i += 3) {
    const [x = 0, y = 0, z = 0] = [0, 1, 2].map(
      (k) => unit * ((part.centre[k] ?? 0) + (made.positions[i + k] as number) * (part.size[k] ?? 0)),
    );
    positions.set([x, -z, y], i);
  }
  return { positions, triangles: made.triangles };
}

/** 0 x, 1 y, 2 z. */
const axisOf = ({ axis = 'y' }: CadPart) => 'xyz'.indexOf(axis.charAt(0));

/** Corners within ±1/2 along each axis. */
interface Unit {
  readonly positions: readonly number[];
  readonly triangles: Uint32Array;
}

function box(): Unit {
  const positions = [0, 1, 2, 3, 4, 5, 6, 7].flatMap((k) => [0, 1, 2].map((axis) => (k & (1 << axis) ? 0.5 : -0.5)));
  const faces = [
    [0, 2, 3, 1],
    [4, 5, 7, 6],
    [0, 1, 5, 4],
    [2, 6, 7, 3],
    [0, 4, 6, 2],
    [1, 3, 7, 5],
  ];
  return { positions, triangles: fans(faces) };
}

/** cos of `step` / `quarter` quarter turns, exact at whole ones. */
function cosine(step: number, quarter: number): number {
  if (step % quarter === 0) return [1, 0, -1, 0][Math.abs(step / quarter) % 4] as number;
  return Math.cos(((Math.PI / 2) * step) / quarter);
}

function round(part: CadPart): Unit {
  const a = axisOf(part);
  const [u, v] = [(a + 1) % 3, (a + 2) % 3];
  const sides = part.sides ?? roundSides;
  const towards = part.axis?.endsWith('-') ? -1 : 1;
  const narrow = part.kind === 'cone' ? (part.top ?? 0) / (part.size[u] ?? 1) : 1;
  const positions: number[] = [];
  for (const [end, share] of [
    [-1, 1],
    [1, narrow],
  ] as const) {
    for (let k = 0; k < sides; k++) {
      const step = 4 * k + (part.phase ?? 0) * sides;
      const corner = [0, 0, 0];
      corner[u] = (cosine(step, sides) * share) / 2;
      corner[v] = (cosine(step + 3 * sides, sides) * share) / 2;
      corner[a] = (end * towards) / 2;
      positions.push(...corner);
    }
  }
  const ring = Array.from({ length: sides }, (_, k) => k);
  const top = (k: number) => sides + (k % sides);
  const faces = [ring.toReversed(), ring.map(top)];
  for (const k of ring) faces.push([k, (k + 1) % sides, top(k + 1), top(k)]);
  return { positions, triangles: fans(towards > 0 ? faces : faces.map((face) => face.toReversed())) };
}

function sphere(): Unit {
  const half = sphereRings / 2;
  const positions: number[] = [];
  for (let ring = 0; ring <= sphereRings; ring++) {
    const r = cosine(ring - half, half);
    for (let k = 0; k < roundSides; k++) {
      const across = [cosine(4 * k, roundSides), cosine(4 * k + 3 * roundSides, roundSides)];
      positions.push(((across[0] ?? 0) * r) / 2, cosine(ring, half) / 2, ((across[1] ?? 0) * r) / 2);
    }
  }
  const faces: number[][] = [];
  for (let ring = 0; ring < sphereRings; ring++) {
    for (let k = 0; k < roundSides; k++) {
      const [a, b] = [ring * roundSides + k, ring * roundSides + ((k + 1) % roundSides)];
      faces.push([a, b, b + roundSides, a + roundSides]);
    }
  }
  return { positions, triangles: fans(faces) };
}

const fans = (faces: readonly (readonly number[])[]): Uint32Array =>
  Uint32Array.from(
    faces.flatMap((face) => face.slice(2).flatMap((corner, i) => [face[0] as number, face[i + 1] as number, corner])),
  );
