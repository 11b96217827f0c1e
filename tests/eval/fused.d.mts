type Core = (method: string, parameters: unknown, buffers?: Uint8Array[]) => { result: unknown; buffers: Uint8Array[] };
export function measureFused(
  core: Core,
  name: string,
  glb: Uint8Array,
): Promise<{ readonly parts: number; readonly pieces: number; readonly by: string; readonly share: number }>;
export function bestPairs(areas: readonly ArrayLike<number>[]): number;
