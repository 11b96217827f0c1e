// Lives for one step. See carve/carve.ts; the page's end is session/carve.ts.
import manifoldUrl from 'manifold-3d/manifold.wasm?url';
import { type CarveFiles, carve } from '../carve/carve';
import type { Carved, CarveStep } from '../carve/steps';
import { loadManifold } from '../solid/manifold';
import type { Answer } from './once';
import { holdWatchedLock } from './watch';

holdWatchedLock();

export interface CarveRequest {
  readonly files: CarveFiles;
  readonly step: CarveStep;
}

self.onmessage = async ({ data }: MessageEvent<CarveRequest>) => {
  try {
    const reply: Answer<Carved> = await carve(data.files, data.step, async () => {
      const { triangulate } = await loadManifold(manifoldUrl);
      return triangulate;
    });
    self.postMessage(reply, { transfer: [reply.glb.buffer] });
  } catch (error) {
    self.postMessage({ error: error instanceof Error ? error.message : String(error) } satisfies Answer<Carved>);
  }
};
