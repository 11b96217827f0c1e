import type { Nodes } from './judged.mjs';

export function keptRelations(
  shape: { readonly parts: readonly object[]; readonly relations: readonly object[] },
  rest: Nodes,
  now: Nodes,
  givenUp?: readonly string[],
): { readonly kept: number; readonly of: number; readonly lost: readonly string[] };
