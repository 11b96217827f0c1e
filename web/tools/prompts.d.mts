import type { MethodResult, Prompt } from '../src/worker/protocol';

export interface OfferedRequest {
  readonly model: string;
  readonly request: string;
  readonly mentioned?: readonly string[];
  readonly suggest?: boolean;
  /** That proposes, or has proposed, the request. */
  readonly task?: string;
}
export interface OfferedProposals {
  readonly model: string;
  readonly task: string;
  readonly request?: string;
  readonly picture?: boolean;
}
type Core = (method: string, parameters: unknown, buffers?: Uint8Array[]) => { result: unknown; buffers: Uint8Array[] };
export type RenderedRequest = OfferedRequest & MethodResult<'prompts'>;
export interface Recording {
  readonly hash: string;
  readonly task: string;
  readonly model: string;
  readonly date: string;
  readonly replies: readonly { readonly vote: number; readonly text: string }[];
}
export function readRequests(): OfferedRequest[];
export function readRecordings(folder?: string): Map<string, Recording>;
export function readProposals(): OfferedProposals[];
export function renderRequests(core: Core, requests: readonly OfferedRequest[]): RenderedRequest[];
export function renderProposals(
  core: Core,
  proposals: readonly OfferedProposals[],
  recordings: ReadonlyMap<string, Recording>,
): RenderedRequest[];
export function renderKinds(core: Core, recordings: ReadonlyMap<string, Recording>): RenderedRequest[];
export function renderNames(core: Core): RenderedRequest[];
export function renderAll(core: Core, recordings?: ReadonlyMap<string, Recording>): RenderedRequest[];
export function compare(
  rendered: readonly RenderedRequest[],
  recordings: ReadonlyMap<string, Recording>,
): {
  offered: RenderedRequest[];
  open: RenderedRequest[];
  missing: { model: string; request: string; prompt: Prompt }[];
  stale: string[];
};
