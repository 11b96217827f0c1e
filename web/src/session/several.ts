// Several parts at once: which parts are like one another, and which parts stand for a selection in an edit.
import { isGroup, isReflection, type Shape } from '../program/types';
import { oncePerShape } from './once_per_shape';

/** Real parts among some, and the instances of virtual ones; in the shape's order. */
export function realParts(shape: Shape, ids: Iterable<string>): string[] {
  const wanted = new Set(ids);
  for (const { id, members } of shape.parts) if (wanted.has(id)) for (const member of members) wanted.add(member);
  return shape.parts.filter(({ id, virtual }) => !virtual && wanted.has(id)).map(({ id }) => id);
}

interface Likeness {
  /** Real parts that each stands for: itself, or its instances. */
  readonly real: ReadonlyMap<string, readonly string[]>;
  /** Parts that are alike, by what makes them so: one label, one relation. */
  readonly kinds: ReadonlyMap<unknown, readonly string[]>;
  readonly kindsOf: ReadonlyMap<string, readonly unknown[]>;
}

const likeness = oncePerShape((shape): Likeness => {
  const real = new Map(shape.parts.map(({ id, virtual, members }) => [id, virtual ? members : [id]] as const));
  const kinds = new Map<unknown, string[]>();
  for (const { id, label, virtual } of shape.parts) {
    const same = kinds.get(label);
    if (same !== undefined && !virtual) same.push(id);
    else if (!virtual) kinds.set(label, [id]);
  }
  for (const relation of shape.relations)
    if (isReflection(relation) || isGroup(relation))
      kinds.set(
        relation,
        relation.parts.flatMap((id) => real.get(id) ?? []),
      );
  const kindsOf = new Map<string, unknown[]>();
  for (const [kind, ids] of kinds)
    for (const id of ids) {
      const own = kindsOf.get(id);
      if (own === undefined) kindsOf.set(id, [kind]);
      else own.push(kind);
    }
  return { real, kinds, kindsOf };
});

/**
 * Parts that are what this one is, itself among them: those of its label, its mirror images, the instances of its row or
 * ring, and all that are so of these. Real parts, in the shape's order.
 */
export function alike(shape: Shape, part: string): string[] {
  const { real, kinds, kindsOf } = likeness(shape);
  const found = new Set(real.get(part) ?? []);
  const seen = new Set<unknown>();
  for (const id of found) {
    for (const kind of kindsOf.get(id) ?? []) {
      if (seen.has(kind)) continue;
      seen.add(kind);
      for (const other of kinds.get(kind) ?? []) found.add(other); // which this loop comes to as well
    }
  }
  return realParts(shape, found);
}

/** The parts of a selection as an edit names them, in its order: a row or ring that is selected whole is one part. */
export function standIns(shape: Shape, ids: readonly string[]): string[] {
  const real = new Set(realParts(shape, ids));
  const groups = shape.parts.filter(({ members }) => members.length > 0 && members.every((id) => real.has(id)));
  const groupOf = new Map(groups.flatMap(({ id, members }) => members.map((member) => [member, id] as const)));
  return [...new Set(ids.map((id) => groupOf.get(id) ?? id))];
}
