// A worker's end: owns one WebAssembly module and answers one call at a time; whatever breaks the module itself is reported as
// `crashed`.
import type { CreateModule, ParselModule } from 'parsel-module';
import type { Request, Response } from './protocol';
import { holdWatchedLock } from './watch';

/**
 * Call first thing in a worker.
 * @param createModule the loader that came with the module
 * @param warmUp a method that takes nothing, called before anybody waits for one: first calls may be several times slower
 */
export function serve(createModule: CreateModule, warmUp?: string): void {
  holdWatchedLock();
  let core: ParselModule | undefined;

  const post = (response: Response, transfer: Transferable[] = []) => self.postMessage(response, { transfer });
  const crashed = (error: unknown) =>
    post({ kind: 'crashed', text: error instanceof Error ? error.message : String(error) });

  async function start(module: WebAssembly.Module): Promise<void> {
    const begin = performance.now();
    core = await new Promise<ParselModule>((resolve, reject) => {
      createModule({
        instantiateWasm(imports, receive) {
          WebAssembly.instantiate(module, imports).then(receive, reject); // the loader would swallow a failure
          return {};
        },
        onAbort: reject,
        print: () => {},
        printErr: () => {},
      }).then(resolve, reject);
    });
    if (warmUp !== undefined) core.invoke(warmUp, '{}', [], null);
    post({ kind: 'ready', startMilliseconds: performance.now() - begin });
  }

  function call(request: Request & { kind: 'call' }): void {
    if (core === undefined) throw new Error('called before start');
    const { id, method, parameters, buffers } = request;
    const reply = core.invoke(method, JSON.stringify(parameters), buffers, (step, done, total) =>
      post({ kind: 'progress', id, step, done, total }),
    );
    post(
      { kind: 'reply', id, ...reply },
      reply.buffers.map((buffer) => buffer.buffer),
    );
  }

  self.onmessage = async ({ data }: MessageEvent<Request>) => {
    try {
      if (data.kind === 'start') await start(data.module);
      else call(data);
    } catch (error) {
      crashed(error); // an abort, a trap, or memory that cannot grow: never an Error value of the core
    }
  };
}
