// Lives for one file. See formats/convert.ts; the page's end is session/convert.ts.
import { type Converted, convert } from '../formats/convert';
import type { Format, Source } from '../formats/model';
import { holdWatchedLock } from './watch';

holdWatchedLock();

export interface ConvertRequest {
  readonly source: Source;
  readonly format: Format;
  /** Bytes that the file may unfold to. */
  readonly limit: number;
}

type ConvertReply = Converted | { readonly error: string };

self.onmessage = async ({ data }: MessageEvent<ConvertRequest>) => {
  try {
    const reply: ConvertReply = await convert(data.source, data.format, data.limit);
    self.postMessage(reply, { transfer: [reply.glb.buffer] });
  } catch (error) {
    self.postMessage({ error: error instanceof Error ? error.message : String(error) } satisfies ConvertReply);
  }
};
