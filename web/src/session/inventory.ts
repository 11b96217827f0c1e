// What was found in a model, for people who have just opened it.

import { isAttachment, isGroup, isReflection, type Shape } from '../program/types';
import { plural, t } from '../texts/texts';

export interface Inventory {
  /** How many real parts, pairs of mirror images, and rows or rings there are. */
  readonly parts: number;
  readonly mirrors: number;
  readonly rows: number;
  /** Whether something stands on the floor. */
  readonly stands: boolean;
  /** Real parts that nothing joins, directly or by others, to what most parts hang together in. */
  readonly loose: readonly string[];
}

export function inventoryOf(shape: Shape): Inventory {
  const real = shape.parts.filter(({ virtual }) => !virtual).map(({ id }) => id);
  const { relations } = shape;
  return {
    parts: real.length,
    mirrors: relations.filter(isReflection).length,
    rows: relations.filter(isGroup).length,
    stands: relations.some(({ kind }) => kind === 'ground'),
    loose: looseParts(shape, real),
  };
}

/** What stands for instances hangs together with each of them. */
function looseParts(shape: Shape, real: readonly string[]): string[] {
  const neighbours = new Map<string, string[]>(shape.parts.map(({ id }) => [id, []]));
  const join = (a = '', b = '') => {
    neighbours.get(a)?.push(b);
    neighbours.get(b)?.push(a);
  };
  for (const relation of shape.relations) if (isAttachment(relation)) join(relation.parts[0], relation.parts[1]);
  for (const { id, members } of shape.parts) for (const member of members) join(id, member);
  const isReal = new Set(real);
  const seen = new Set<string>();
  let largest: ReadonlySet<string> = new Set();
  for (const start of real) {
    if (seen.has(start)) continue;
    const together = new Set([start]);
    for (const id of together) for (const other of neighbours.get(id) ?? []) together.add(other);
    for (const id of together) seen.add(id);
    const parts = new Set([...together].filter((id) => isReal.has(id)));
    if (parts.size > largest.size) largest = parts;
  }
  return real.filter((id) => !largest.has(id));
}

/** "17 parts, 9 mirror images, 1 row, stands on the floor"; what is loose is said apart. */
export function inventoryWords({ parts, mirrors, rows, stands }: Inventory): string {
  return [
    plural(parts, '{n} part', '{n} parts'),
    ...(mirrors > 0 ? [plural(mirrors, '{n} mirror image', '{n} mirror images')] : []),
    ...(rows > 0 ? [plural(rows, '{n} row', '{n} rows')] : []),
    ...(stands ? [t`stands on the floor`] : []),
  ].join(', ');
}
