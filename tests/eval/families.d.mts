import type { Recording } from '../../web/tools/prompts.mjs';

type Core = (method: string, parameters: unknown, buffers?: Uint8Array[]) => { result: unknown; buffers: Uint8Array[] };
export interface Score {
  readonly precision: number;
  readonly recall: number;
  readonly wrong: readonly string[];
  readonly missed: readonly string[];
  readonly found: number;
  readonly wanted: number;
  readonly holding: number;
}
export function readWanted(): Record<string, { readonly wanted: readonly string[] }>;
export function implied(ids: readonly string[], holding: readonly string[]): Set<string>;
export function score(found: readonly string[], wanted: readonly string[], holding: readonly string[]): Score;
export function measureFamilies(
  core: Core,
  recordings: ReadonlyMap<string, Recording>,
  votes?: number,
): {
  readonly id: string;
  readonly kinds: readonly { readonly name: string; readonly votes: number; readonly refused: readonly unknown[] }[];
  readonly score: Score;
}[];
