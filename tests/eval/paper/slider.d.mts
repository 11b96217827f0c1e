import type { Nodes } from '../judged.mjs';

export const judgedAt: number;
export function sliderAt(
  shape: { readonly parts: readonly object[]; readonly relations: readonly object[] },
  rest: Nodes,
  seed: readonly { readonly op: string; readonly part?: string; readonly relation?: string }[],
  max: number,
  at: (slider: number) => Promise<Nodes>,
): Promise<number>;
