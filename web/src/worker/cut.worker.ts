// Lives as long as the model of a CAD program that cuts. See solid/cut_model.ts; the page's end is session/cuts.ts.
import manifoldUrl from 'manifold-3d/manifold.wasm?url';
import type { CadProgram } from '../solid/cad';
import type { State } from '../solid/cut';
import { type Box, CutModel, type LocalCut } from '../solid/cut_model';
import { loadManifold } from '../solid/manifold';
import { partsOf } from '../solid/parts';
import { holdWatchedLock } from './watch';

holdWatchedLock();

export interface CutOpen {
  readonly program: CadProgram;
  /** The file that the program makes. */
  readonly glb: Uint8Array;
  readonly boxes: readonly Box[];
}

export interface CutRequest extends State {
  /** 24 numbers a box, in millimetres, z up. */
  readonly corners: Float64Array;
}

export type CutReply = { readonly cuts: readonly LocalCut[] } | { readonly error: string };

let opening: Promise<CutModel> | null = null;

async function answer(data: CutOpen | CutRequest): Promise<CutReply | null> {
  if ('glb' in data) {
    opening = partsOf(data.glb, new Map()).then((parts) => new CutModel(data.program, data.boxes, parts));
    return null;
  }
  const [model, manifold] = await Promise.all([opening, loadManifold(manifoldUrl)]);
  return { cuts: model?.cut(data.corners, data, manifold) ?? [] };
}

self.onmessage = async ({ data }: MessageEvent<CutOpen | CutRequest>) => {
  let reply: CutReply | null;
  try {
    reply = await answer(data);
  } catch (error) {
    reply = { error: error instanceof Error ? error.message : String(error) };
  }
  if (reply === null) return;
  const transfer =
    'cuts' in reply
      ? reply.cuts.flatMap(({ positions, normals, triangles }) => [positions.buffer, normals.buffer, triangles.buffer])
      : [];
  self.postMessage(reply, { transfer });
};
