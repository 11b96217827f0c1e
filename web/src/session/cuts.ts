// What differences and intersections leave of the parts of a CAD program, worked out in a worker of its own for one state
// after the other: always for the latest that is asked for, whatever came in between.

import type { Shape } from '../program/types';
import type { ModelFiles } from '../scene/load';
import type { CadProgram } from '../solid/cad';
import type { State } from '../solid/cut';
import type { Box, LocalCut } from '../solid/cut_model';
import { stepsOf } from '../solid/steps';
import { t } from '../texts/texts';
import type { CutOpen, CutReply, CutRequest } from '../worker/cut.worker';
import { watched } from '../worker/watch';
import type { Document, OpenModel } from './document';
import { absentIds, baseOf, parametersAt, type Setting, shapeIds } from './family_state';

export interface PartCut extends LocalCut {
  /** Index in the shape. */
  readonly part: number;
}

/** Millimetres, z up, front towards -y: OpenSCAD's frame. */
function placed({ frame }: Shape, corners: ArrayLike<number>, from: number, to: Float64Array, at: number): void {
  const {
    centre,
    scale,
    axes = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ],
  } = frame;
  for (let k = 0; k < 24; k += 3) {
    const [x = 0, y = 0, z = 0] = [0, 1, 2].map((i) => {
      const turned = [0, 1, 2].reduce((sum, j) => sum + (axes[j]?.[i] ?? 0) * (corners[from + k + j] as number), 0);
      return 1000 * ((centre[i] as number) + scale * turned);
    });
    to.set([x, -z, y], at + k);
  }
}

export class Cutter {
  /** Told of what is left of each part that is cut, in the local coordinates of its hexahedron. */
  onCuts: ((cuts: readonly PartCut[]) => void) | null = null;
  /** Told, in a clause, why nothing can be cut. */
  onFailure: ((reason: string) => void) | null = null;
  readonly #shape: Shape;
  readonly #parts: readonly number[];
  readonly #worker: ReturnType<typeof watched>;
  #isBusy = false;
  #next: CutRequest | null = null;
  #latest: readonly PartCut[] | null = null;

  constructor(
    { files, shape }: OpenModel,
    program: CadProgram,
    ids: ReadonlyMap<string, string>,
    create: (name: string) => Worker,
  ) {
    this.#shape = shape;
    const known = [...ids].map(([id, own]) => [id, shape.parts.findIndex((part) => part.id === own)] as const);
    this.#parts = known.map(([, part]) => part);
    const boxes = known.map(([id, part]): Box => {
      const rest = new Float64Array(24);
      placed(shape, shape.parts[part]?.corners.flat() ?? [], 0, rest, 0);
      return { id, node: shape.parts[part]?.node ?? -1, rest };
    });
    this.#worker = watched(create);
    this.#worker.onmessage = ({ data }: MessageEvent<CutReply>) => this.#receive(data);
    this.#worker.onerror = ({ message }) => this.onFailure?.(message || t`what cuts did not start`);
    this.#worker.ondeath = () => this.onFailure?.(t`the browser ended what cuts`);
    this.#worker.postMessage({ program, glb: files.main, boxes } satisfies CutOpen);
  }

  /** @param corners of all parts, part × 24, in the shape's frame */
  ask(corners: ArrayLike<number>, state: State): void {
    const own = new Float64Array(24 * this.#parts.length);
    for (const [box, part] of this.#parts.entries()) placed(this.#shape, corners, 24 * part, own, 24 * box);
    this.#next = { ...state, corners: own };
    this.#send();
  }

  /** Whether what was told last is of the latest state. */
  get isDone(): boolean {
    return !this.#isBusy && this.#next === null && this.#latest !== null;
  }

  get latest(): readonly PartCut[] | null {
    return this.#latest;
  }

  dispose(): void {
    this.onCuts = this.onFailure = null;
    this.#worker.terminate();
  }

  #send(): void {
    if (this.#isBusy || this.#next === null) return;
    this.#isBusy = true;
    this.#worker.postMessage(this.#next);
    this.#next = null;
  }

  #receive(reply: CutReply): void {
    this.#isBusy = false;
    if ('error' in reply) this.onFailure?.(reply.error);
    else {
      this.#latest = reply.cuts.map((cut) => ({ ...cut, part: this.#parts[cut.box] ?? -1 }));
      this.onCuts?.(this.#latest);
    }
    this.#send();
  }
}

/** Whether parts of a model's program are cut by others. */
export function isCut({ cad }: ModelFiles): boolean {
  return cad !== undefined && stepsOf((cad.program as CadProgram).tree).size > 0;
}

let current: { readonly shape: Shape; readonly cutter: Cutter } | null = null;

/** What cuts a model; null where nothing is to be cut. One at a time: that of another model ends. */
export function cutterOf(model: OpenModel): Cutter | null {
  const { files, shape } = model;
  if (files.cad === undefined || !isCut(files)) return null;
  if (current?.shape === shape) return current.cutter;
  current?.cutter.dispose();
  const create = (name: string) =>
    new Worker(new URL('../worker/cut.worker.ts', import.meta.url), { type: 'module', name });
  const cutter = new Cutter(model, files.cad.program as CadProgram, shapeIds(files.cad, shape), create);
  current = { shape, cutter };
  return cutter;
}

/** Where the parts of a document's program stand that no hexahedron follows: those that cut. */
export function cutState(document: Document, setting: Setting | null): State {
  const { family } = document;
  if (family === undefined) return { values: {}, absent: new Set() };
  return { values: parametersAt(family, setting ?? baseOf(family)), absent: absentIds(document) };
}

/** Waits for the parts of a model that is about to be shown, as they are at rest. Rejects with the reason when cancelled. */
export async function firstCuts(model: OpenModel, signal: AbortSignal): Promise<string | null> {
  const cutter = cutterOf(model);
  if (cutter === null) return null;
  const { shape } = model;
  try {
    return await new Promise((resolve, reject) => {
      cutter.onCuts = () => resolve(null);
      cutter.onFailure = (reason) => resolve(t`The parts are drawn uncut: ${reason}.`);
      signal.addEventListener('abort', () => reject(signal.reason), { once: true });
      cutter.ask(
        shape.parts.flatMap(({ corners }) => corners.flat()),
        { values: {}, absent: new Set() },
      );
    });
  } finally {
    cutter.onCuts = cutter.onFailure = null;
  }
}
