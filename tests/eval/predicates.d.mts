import type { Nodes } from './judged.mjs';

export function judge(predicate: object, rest: Nodes, now: Nodes, share?: number): { ok: boolean; why: string };
