// The parts of a CAD program's model as they stand with their hexahedra, cut, and what is left of each in the local
// coordinates of its hexahedron: so it follows that until it has been cut anew.
import type { ManifoldToplevel } from 'manifold-3d/manifold';
import type { CadProgram } from './cad';
import { cutParts, type State } from './cut';
import { localNormal, localOf, mapped } from './local';
import { stepsOf } from './steps';
import type { Part, Triangles } from './types';

/** A part that adds material. */
export interface Box {
  /** In the program. */
  readonly id: string;
  /** Its node in the file. */
  readonly node: number;
  /** Of its hexahedron at rest: 24 numbers, in millimetres, z up. */
  readonly rest: Float64Array;
}

export interface LocalCut {
  /** Which of the boxes. */
  readonly box: number;
  /** Three numbers a corner. */
  readonly positions: Float32Array<ArrayBuffer>;
  readonly normals: Float32Array<ArrayBuffer>;
  readonly triangles: Uint32Array<ArrayBuffer>;
  /** Cubic millimetres. */
  readonly volume: number;
}

/** Cuts a model in one state after the other. */
export class CutModel {
  readonly #program: CadProgram;
  readonly #boxes: readonly Box[];
  readonly #local: readonly Triangles[];

  /** @param parts of the file, as partsOf() gives them */
  constructor(program: CadProgram, boxes: readonly Box[], parts: readonly Part[]) {
    this.#program = program;
    this.#boxes = boxes;
    this.#local = boxes.map(({ node, rest }) => {
      const { positions, triangles } = parts.find((part) => part.node === node) ?? none;
      return { positions: eachPoint(positions, (point) => localOf(rest, 0, point)), triangles };
    });
  }

  /** @param corners of the hexahedra, 24 numbers a box, in millimetres, z up */
  cut(corners: Float64Array, state: State, manifold: ManifoldToplevel): LocalCut[] {
    const cutAtAll = stepsOf(this.#program.tree);
    const parts = new Map<string, Triangles>();
    for (const [box, { id }] of this.#boxes.entries()) {
      if (!cutAtAll.has(id)) continue;
      const { positions, triangles } = this.#local[box] as Triangles;
      parts.set(id, { positions: eachPoint(positions, (local) => mapped(corners, 24 * box, local).point), triangles });
    }
    const cuts = cutParts(this.#program, parts, state, manifold);
    return this.#boxes.flatMap(({ id }, box) => {
      const cut = cuts.get(id);
      if (cut === undefined) return [];
      const { positions, normals, triangles } = cut.drawn;
      const local = eachPoint(positions, (point) => localOf(corners, 24 * box, point));
      const turned = eachPoint(normals, (normal, i) =>
        localNormal(corners, 24 * box, local.subarray(i, i + 3), normal),
      );
      return [
        {
          box,
          positions: Float32Array.from(local),
          normals: Float32Array.from(turned),
          triangles: Uint32Array.from(triangles),
          volume: cut.volume,
        },
      ];
    });
  }
}

const none: Triangles = { positions: new Float64Array(0), triangles: new Uint32Array(0) };

function eachPoint(points: Float64Array, to: (point: Float64Array, at: number) => readonly number[]): Float64Array {
  const made = new Float64Array(points.length);
  for (let i = 0; i < points.length; i += 3) made.set(to(points.subarray(i, i + 3), i), i);
  return made;
}
