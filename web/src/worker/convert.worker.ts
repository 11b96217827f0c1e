// Lives for one file, to be read or to be written. See formats/convert.ts and write.ts; the page's end is session/convert.ts.
import { type Converted, convert } from '../formats/convert';
import type { Format, Source } from '../formats/model';
import { type Written, type WrittenFormat, written } from '../formats/write';
import type { Answer } from './once';
import { holdWatchedLock } from './watch';

holdWatchedLock();

export interface ConvertRequest {
  readonly source: Source;
  readonly format: Format;
  /** Bytes that the file may unfold to. */
  readonly limit: number;
}

export interface WriteRequest {
  readonly glb: Uint8Array;
  readonly to: WrittenFormat;
  /** Of the files, without extension. */
  readonly name: string;
  /** What is going on, as the page says it. */
  readonly step: string;
}

const send = (reply: Answer<Converted | Written>, transfer: Transferable[] = []) =>
  self.postMessage(reply, { transfer });

self.onmessage = async ({ data }: MessageEvent<ConvertRequest | WriteRequest>) => {
  try {
    if ('source' in data) {
      const reply = await convert(data.source, data.format, data.limit);
      send(reply, [reply.glb.buffer]);
    } else {
      const { glb, to, name, step } = data;
      const reply = await written(glb, to, name, (done, total) => send({ progress: { step, done, total } }));
      send(reply, [reply.bytes.buffer]);
    }
  } catch (error) {
    send({ error: error instanceof Error ? error.message : String(error) });
  }
};
