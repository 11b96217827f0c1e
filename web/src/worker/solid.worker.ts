// Lives for one question. See solid/unite.ts; the page's end is session/solid.ts.
import manifoldUrl from 'manifold-3d/manifold.wasm?url';
import type { CadProgram } from '../solid/cad';
import type { State } from '../solid/cut';
import { cutFile } from '../solid/cut_file';
import { loadManifold } from '../solid/manifold';
import { partsOf } from '../solid/parts';
import { writeStl } from '../solid/stl';
import { writeThreeMf } from '../solid/threemf';
import type { Solid } from '../solid/types';
import { type United, unite } from '../solid/unite';
import type { Answer } from './once';
import { holdWatchedLock } from './watch';

holdWatchedLock();

export type PrintFormat = 'stl' | '3mf';

/** What a CAD program makes in one state. */
export interface CadFile {
  readonly glb: Uint8Array;
  /** Of the parts that add material, by their ids in the program. */
  readonly nodes: ReadonlyMap<string, number>;
  readonly state: State;
}

export type SolidRequest =
  | {
      readonly kind: 'unite';
      readonly glb: Uint8Array;
      /** Of parts, by `node/primitive`. */
      readonly names: ReadonlyMap<string, string>;
      readonly leaveOut: boolean;
    }
  | {
      readonly kind: 'cut';
      readonly program: CadProgram;
      readonly files: readonly CadFile[];
    }
  | {
      readonly kind: 'write';
      readonly solid: Solid;
      readonly format: PrintFormat;
      /** Of the millimetres. */
      readonly scale: number;
      readonly name: string;
    };

export interface Written {
  readonly bytes: Uint8Array<ArrayBuffer>;
}

/** The files in their order. */
export interface Cut {
  readonly files: readonly Uint8Array<ArrayBuffer>[];
}

const answer = (reply: Answer<United | Written | Cut>, transfer: Transferable[] = []) =>
  self.postMessage(reply, { transfer });

self.onmessage = async ({ data }: MessageEvent<SolidRequest>) => {
  try {
    if (data.kind === 'write') {
      const { solid, format, scale, name } = data;
      const bytes = format === 'stl' ? writeStl(solid, scale) : writeThreeMf(solid, scale, name);
      answer({ bytes }, [bytes.buffer]);
      return;
    }
    answer({ progress: { step: 'fetching what unites and cuts', done: 0, total: 1 } });
    const manifold = await loadManifold(manifoldUrl);
    if (data.kind === 'cut') {
      const files: Uint8Array<ArrayBuffer>[] = [];
      for (const { glb, nodes, state } of data.files) {
        files.push(await cutFile(glb, data.program, nodes, state, manifold));
      }
      answer(
        { files },
        files.map(({ buffer }) => buffer),
      );
      return;
    }
    const parts = await partsOf(data.glb, data.names);
    let said = 0;
    const united = unite(parts, manifold, data.leaveOut, (done, total) => {
      const now = performance.now();
      if (now - said < 100) return;
      said = now;
      answer({ progress: { step: done < total / 2 ? 'looking at parts' : 'uniting', done: Math.round(done), total } });
    });
    answer(united);
  } catch (error) {
    answer({ error: error instanceof Error ? error.message : String(error) });
  }
};
