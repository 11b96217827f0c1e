import type { Nodes } from './judged.mjs';

export interface Frame {
  readonly low: readonly number[];
  readonly size: number;
}
export function frameOf(models: readonly Nodes[]): Frame;
export function draw(nodes: Nodes, frame: Frame, side: number): Uint8Array;
export function png(pixels: Uint8Array, width: number, height: number): Buffer;
