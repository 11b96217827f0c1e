// Lives for one file. See decompress.ts; the page's end is session/decompress.ts.
import dracoUrl from 'draco3dgltf/draco_decoder_gltf.wasm?url';
import type { ModelFiles } from '../scene/load';
import { type Decompressed, decompress } from './decompress';
import { holdWatchedLock } from './watch';

holdWatchedLock();

type DecompressReply = Decompressed | { readonly error: string };

self.onmessage = async ({ data }: MessageEvent<ModelFiles>) => {
  try {
    const reply: DecompressReply = await decompress(data, async () => (await fetch(dracoUrl)).arrayBuffer());
    self.postMessage(reply, { transfer: [reply.glb.buffer] });
  } catch (error) {
    self.postMessage({ error: error instanceof Error ? error.message : String(error) } satisfies DecompressReply);
  }
};
