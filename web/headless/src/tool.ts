// The command line of the core as WebAssembly (core/cli, wasm/CMakeLists.txt): the same commands, options, messages and
// exit codes as the native one, on the real file system.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

interface Tool {
  callMain(args: string[]): number | undefined;
}
type MakeTool = (options: {
  thisProgram: string;
  noInitialRun: boolean;
  wasmMemory: WebAssembly.Memory;
  instantiateWasm(imports: WebAssembly.Imports, receive: (instance: WebAssembly.Instance) => void): object;
  quit(status: number, thrown: unknown): void;
}) => Promise<Tool>;

const page = 65536; // bytes
const least = 256; // pages, what the module begins with
/** The most memory that the module can be given, in MiB. */
export const mostMemory = 4096;

let compiled: Promise<WebAssembly.Module> | undefined;

/**
 * Runs a command in an instance of its own, so that none knows of another.
 * @param args the command and its arguments, without "parsel"
 * @param memory most memory of the instance, MiB
 * @returns its exit code. @throws what WebAssembly throws when it crashes
 */
export async function runTool(args: readonly string[], memory = mostMemory): Promise<number> {
  const make = createRequire(import.meta.url)('./parsel-tool.cjs') as MakeTool;
  compiled ??= WebAssembly.compile(readFileSync(new URL('./parsel-tool.wasm', import.meta.url)));
  const code = await compiled;
  let status: number | undefined;
  let fails: (error: unknown) => void;
  const failed = new Promise<never>((_, reject) => {
    fails = reject;
  });
  const tool = await Promise.race([
    failed,
    make({
      thisProgram: 'parsel',
      noInitialRun: true,
      wasmMemory: new WebAssembly.Memory({ initial: least, maximum: Math.max(least, (memory * 2 ** 20) / page) }),
      instantiateWasm(imports, receive) {
        WebAssembly.instantiate(code, imports).then(receive).catch(fails);
        return {};
      },
      quit(given, thrown) {
        status = given;
        throw thrown;
      },
    }),
  ]);
  const returned = tool.callMain([...args]);
  return status ?? returned ?? 0;
}
