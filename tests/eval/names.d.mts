import type { Recording } from '../../web/tools/prompts.mjs';

type Core = (method: string, parameters: unknown, buffers?: Uint8Array[]) => { result: unknown; buffers: Uint8Array[] };
export function measureGalleryNames(
  core: Core,
  recordings: ReadonlyMap<string, Recording>,
): { readonly id: string; readonly parts: number; readonly same: number; readonly together: number }[];
