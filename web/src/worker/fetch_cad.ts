// The module for CAD programs, which tells how much of it has come in.
import cadUrl from 'parsel-module/parsel_cad.wasm?url';
import { CoreClient } from './client';
import type { FetchOptions } from './on_demand';
import type { Progress } from './protocol';
import { watched } from './watch';

/** The module in a worker of its own. Rejects when it cannot be had, with the signal's reason when cancelled. */
export async function fetchCad({ signal, onProgress }: Required<FetchOptions>): Promise<CoreClient> {
  const step = 'fetching what reads CAD programs';
  onProgress({ step, done: 0, total: 0 });
  const response = await fetch(cadUrl, { signal });
  if (!response.ok) throw new Error(`the server answers ${response.status}`);
  const module = await WebAssembly.compileStreaming(counted(response, step, onProgress));
  return new CoreClient(module, () =>
    watched((name) => new Worker(new URL('./cad.worker.ts', import.meta.url), { type: 'module', name })),
  );
}

/** The response of a module, which tells how much of it is there. How much it will be is known unless it comes compressed. */
export function counted(response: Response, step: string, onProgress: (progress: Progress) => void): Response {
  if (response.body === null) return response;
  const total = response.headers.has('content-encoding') ? null : response.headers.get('content-length');
  const megabytes = (bytes: number) => (bytes / 1e6).toFixed(1);
  let bytes = 0;
  const count = new TransformStream<Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>>({
    transform(chunk, controller) {
      bytes += chunk.length;
      const of = total === null ? '' : ` of ${megabytes(Number(total))}`;
      onProgress({ step: `${step}, ${megabytes(bytes)}${of} MB`, done: 0, total: 0 });
      controller.enqueue(chunk);
    },
  });
  return new Response(response.body.pipeThrough(count), { headers: { 'content-type': 'application/wasm' } });
}
