// How programs name parts.
import type { CageShape } from './types';

/** Indices of a shape's parts by id and by "node:<glTF node index>" (the first part of that node). */
export function partIndex(shape: Pick<CageShape, 'parts'>): ReadonlyMap<string, number> {
  const found = new Map<string, number>();
  for (const [i, part] of shape.parts.entries()) {
    const node = `node:${part.node}`;
    if (part.node >= 0 && !found.has(node)) found.set(node, i);
  }
  // Last, so that an id wins over a node number that reads the same.
  for (const [i, part] of shape.parts.entries()) found.set(part.id, i);
  return found;
}
