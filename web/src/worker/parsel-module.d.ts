// The Emscripten loaders and the modules that they load, built by CMake (wasm/bindings.cpp).
declare module 'parsel-module' {
  export interface ParselModule {
    invoke(
      method: string,
      parameters: string,
      buffers: Uint8Array[],
      progress: ((step: string, done: number, total: number) => void) | null,
    ): { json: string; buffers: Uint8Array[] };
    methods(): string[];
  }
  export interface ParselModuleOptions {
    /** Instantiates the module ourselves, from an already compiled WebAssembly.Module. */
    instantiateWasm?(
      imports: WebAssembly.Imports,
      receive: (instance: WebAssembly.Instance) => void,
    ): WebAssembly.Exports;
    onAbort?(reason: unknown): void;
    print?(text: string): void;
    printErr?(text: string): void;
  }
  export type CreateModule = (options: ParselModuleOptions) => Promise<ParselModule>;
}

declare module 'parsel-module/*.mjs' {
  const createModule: import('parsel-module').CreateModule;
  export default createModule;
}

declare module 'parsel-module/*.wasm?url' {
  const url: string;
  export default url;
}

// Built by CMake (wasm/poisson/poisson.cpp).
declare module 'parsel-module/poisson.mjs' {
  export interface PoissonModule {
    _malloc(bytes: number): number;
    _free(at: number): void;
    _poisson_reconstruct(values: number, count: number, depth: number, weight: number): number;
    _poisson_positions(): number;
    _poisson_triangle_count(): number;
    _poisson_triangles(): number;
    readonly HEAPF32: Float32Array;
    readonly HEAPU32: Uint32Array;
  }
  export interface PoissonModuleOptions {
    locateFile?(name: string): string;
    instantiateWasm?(
      imports: WebAssembly.Imports,
      receive: (instance: WebAssembly.Instance) => void,
    ): WebAssembly.Exports;
  }
  export default function createModule(options: PoissonModuleOptions): Promise<PoissonModule>;
}

declare module 'parsel-module/poisson.wasm?url' {
  const url: string;
  export default url;
}
