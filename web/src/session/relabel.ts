// The work on a model whose shape was abstracted anew: the parts are the same, their ids and the relations may be others.
import type { DirectionReference, Layer, PointReference, Shape, Statement } from '../program/types';
import { type Document, type LayerEntry, type OpenModel, partKey } from './document';
import { misfit } from './evaluation';

/** The document on another shape of the same file. What has no counterpart keeps its id, so that nothing is lost. */
export function carryOver(document: Document, model: OpenModel): Document {
  const before = document.model?.shape;
  if (before === undefined) return { ...document, model };
  const part = renaming(before, model.shape, partKeys);
  return {
    ...document,
    model,
    layers: document.layers.map((entry) => carryEntry(entry, before, model.shape)),
    hidden: new Set([...document.hidden].map(part)),
    names: new Map([...document.names].map(([id, name]) => [part(id), name])),
  };
}

/** A layer that rested because it did not fit comes from the shape that it did fit, so that it can come back. */
function carryEntry({ key, layer, enabled, value, home }: LayerEntry, before: Shape, after: Shape): LayerEntry {
  const from = home ?? { shape: before, layer };
  const part = renaming(from.shape, after, partKeys);
  const relation = renaming(from.shape, after, relationKeys);
  const known = new Set(after.relations.map(({ id }) => id));
  const carried: Layer = {
    ...from.layer,
    request: layer.request,
    statements: from.layer.statements.map((statement) => carryStatement(statement, part, relation, known)),
    relations: from.layer.relations
      .map((report) => ({ ...report, id: relation(report.id) }))
      .filter(({ id }) => known.has(id)),
  };
  const rests = misfit(after, carried) !== null;
  return { key, layer: carried, enabled, value, ...(rests ? { home: from } : {}) };
}

type Rename = (id: string) => string;

function carryStatement(statement: Statement, part: Rename, relation: Rename, known: ReadonlySet<string>): Statement {
  const carried: Record<string, unknown> = { ...statement };
  if ('part' in statement) carried.part = part(statement.part);
  if ('relation' in statement) carried.relation = relation(statement.relation);
  for (const field of ['origin', 'direction', 'axis', 'normal'] as const) {
    const reference = carried[field] as PointReference | DirectionReference | undefined;
    if (reference && 'part' in reference) carried[field] = { ...reference, part: part(reference.part) };
  }
  if (statement.why) {
    const relations = statement.why.relations.map(relation).filter((id) => known.has(id));
    carried.why = { ...statement.why, relations };
  }
  return carried as unknown as Statement;
}

/** Old ids to new ones by keys that do not depend on labels. */
function renaming(before: Shape, after: Shape, keysOf: (shape: Shape) => ReadonlyMap<string, string>): Rename {
  const idOf = new Map([...keysOf(after)].map(([id, key]) => [key, id]));
  const taken = new Set(idOf.values());
  const renamed = new Map<string, string>();
  for (const [id, key] of keysOf(before)) {
    // An id without counterpart must not come to mean another part.
    renamed.set(id, idOf.get(key) ?? (taken.has(id) ? `${id} before` : id));
  }
  return (id) => renamed.get(id) ?? id;
}

function partKeys({ parts }: Shape): Map<string, string> {
  const keys = new Map(parts.filter((part) => !part.virtual).map((part) => [part.id, partKey(part)]));
  for (const { id, virtual, members } of parts) {
    if (virtual)
      keys.set(
        id,
        `group ${members
          .map((member) => keys.get(member))
          .sort()
          .join(' ')}`,
      );
  }
  return keys;
}

function relationKeys(shape: Shape): Map<string, string> {
  const part = partKeys(shape);
  return new Map(
    shape.relations.map(({ id, kind, parts }) => {
      const isJoint = kind === 'point' || kind === 'line' || kind === 'face' || kind === 'volume';
      const what = isJoint ? 'attachment' : kind;
      return [
        id,
        `${what} ${parts
          .map((member) => part.get(member))
          .sort()
          .join(' ')}`,
      ];
    }),
  );
}
