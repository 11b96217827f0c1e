// Lives for one question. See fill/file.ts; the page's end is session/fill.ts.
import { MeshoptSimplifier } from 'meshoptimizer';
import createPoisson from 'parsel-module/poisson.mjs';
import poissonUrl from 'parsel-module/poisson.wasm?url';
import { type Filled, fillFile, type PartPlace } from '../fill/file';
import { loadPoisson } from '../fill/poisson';
import type { FilledGap } from '../fill/types';
import type { Answer } from './once';
import { holdWatchedLock } from './watch';

holdWatchedLock();

export interface FillRequest {
  readonly rest: Uint8Array;
  readonly edited: Uint8Array;
  readonly parts: readonly PartPlace[];
  /** Of numbers of parts that are attached. */
  readonly pairs: readonly (readonly [number, number])[];
}

export interface FillReply extends Pick<Filled, 'glb' | 'lost'> {
  readonly gaps: readonly Pick<FilledGap, 'parts' | 'width' | 'left'>[];
}

const answer = (reply: Answer<FillReply>, transfer: Transferable[] = []) => self.postMessage(reply, { transfer });

self.onmessage = async ({ data }: MessageEvent<FillRequest>) => {
  try {
    answer({ progress: { step: 'fetching what rebuilds surfaces', done: 0, total: 1 } });
    const reconstruct = await loadPoisson(createPoisson, { locateFile: () => poissonUrl });
    await MeshoptSimplifier.ready;
    const filled = await fillFile(data.rest, data.edited, data.parts, data.pairs, reconstruct, (done, total) =>
      answer({ progress: { step: 'looking at joints', done, total } }),
    );
    const gaps = filled.gaps.map(({ parts, width, left }) => ({ parts, width, left }));
    answer({ glb: filled.glb, lost: filled.lost, gaps }, [filled.glb.buffer]);
  } catch (error) {
    answer({ error: error instanceof Error ? error.message : String(error) });
  }
};
