// Which parts statements move.

import { partIndex } from './part_index';
import { isGroup, type Shape, type Statement } from './types';

/** Ids of the parts that statements other than keep_fixed move. One on a row or ring moves its parent and every instance. */
export function movedParts(shape: Shape, statements: readonly Statement[]): ReadonlySet<string> {
  const index = partIndex(shape);
  const groups = new Map(shape.relations.filter(isGroup).map((group) => [group.id, group]));
  const moved = new Set<string>();
  for (const statement of statements) {
    if (statement.op === 'keep_fixed') continue;
    const part = 'part' in statement ? shape.parts[index.get(statement.part) ?? -1] : undefined;
    if (part !== undefined) moved.add(part.id);
    const group = groups.get('relation' in statement ? statement.relation : part?.virtual ? (part.group ?? '') : '');
    for (const id of group === undefined ? [] : [group.parent, ...group.parts]) moved.add(id);
  }
  return moved;
}
