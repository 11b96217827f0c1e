// What is wrong with a slider that nobody has made part of the work yet, and which joints give way to it.

import { isAttachment, type Layer, type Shape } from '../program/types';
import type { MethodResult } from '../worker/protocol';
import type { OpenModel } from './document';
import type { ModelCore, Propagation } from './model_core';

/** Parts that are seen to come apart or to run into each other. */
export type Seen = MethodResult<'seen'>['faults'][number];

/** Why a slider is not clean. */
export type Fault =
  | { readonly kind: 'still' }
  /** Relations (ids) that break although nobody asked for it, and what is seen to go wrong. */
  | { readonly kind: 'broken'; readonly relations: readonly string[]; readonly seen: readonly Seen[] }
  | { readonly kind: 'same'; readonly as: string };

export interface Looked {
  /** The joints that give way are disabled in its report. */
  readonly found: Propagation;
  /** Null: it is clean. */
  readonly fault: Fault | null;
}

/** A range below this moves nothing. */
const leastRange = 1e-6;

/**
 * Looks at what was found for one edit. A joint along which a part slides or grows, so that it holds at other points than
 * before, gives way: what the edit leaves alone is to stay, and nothing is seen to come apart (core/prove/clearance.h).
 */
export async function lookedAt(core: ModelCore, model: OpenModel, found: Propagation): Promise<Looked> {
  const [layer] = found.program.layers;
  if (layer === undefined || layer.parameter.max - layer.parameter.min < leastRange)
    return { found, fault: { kind: 'still' } };
  const seen = await core.seen(model, found.program, 0);
  const broken = layer.relations.filter(({ status }) => status === 'broken').map(({ id }) => id);
  const sliding = new Set(broken.filter((id) => isSliding(model.shape, id, seen)));
  const relations = broken.filter((id) => !sliding.has(id));
  if (relations.length > 0 || seen.length > 0) return { found, fault: { kind: 'broken', relations, seen } };
  const loose: Layer = {
    ...layer,
    relations: layer.relations.map((report) => (sliding.has(report.id) ? { ...report, status: 'disabled' } : report)),
  };
  return {
    found: sliding.size === 0 ? found : { ...found, program: { ...found.program, layers: [loose] } },
    fault: null,
  };
}

/** Whether another one does the same; by what asked for it. */
export function sameAs(
  found: Propagation,
  others: readonly { readonly request: string; readonly found: Propagation }[],
): Fault | null {
  const own = doing(found);
  const same = others.find((other) => doing(other.found) === own);
  return same === undefined ? null : { kind: 'same', as: same.request };
}

/** Joints that give way, by id: those that are disabled in a layer's report. */
export function givingWay({ relations }: Shape, layer: Layer): readonly string[] {
  const joints = new Set(relations.filter(isAttachment).map(({ id }) => id));
  return layer.relations.filter(({ id, status }) => status === 'disabled' && joints.has(id)).map(({ id }) => id);
}

function isSliding({ relations }: Shape, id: string, seen: readonly Seen[]): boolean {
  const relation = relations.find((other) => other.id === id);
  if (relation === undefined || !isAttachment(relation)) return false;
  return !seen.some(({ parts, apart }) => apart && parts.every((part) => relation.parts.includes(part)));
}

const doing = ({ program }: Propagation) =>
  JSON.stringify(program.layers[0]?.statements.map(({ why: _, ...rest }) => rest));
