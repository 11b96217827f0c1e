// The gate for shapes from outside. The page's own shapes come from the core and need none; those that travel with a
// program (sliders.ts), or that `parsel inspect` has written, pass here. What evaluation does not need is left behind.
import * as v from 'valibot';
import { type Format, quote, readFormat } from './gate';
import { limits, vector } from './schema';
import {
  type CageRelation,
  type CageShape,
  type GroupRelation,
  isGroup,
  type ProgramError,
  type Result,
} from './types';

const format: Format = { stage: 'program/shape', what: 'shape', name: 'parsel/shape' };

/** Rotation axes are unit vectors up to this. */
const unitSlack = 1e-6;

const name = v.pipe(v.string(), v.minLength(1), v.maxBytes(limits.nameLength));
/** -1 for virtual parts, which have no mesh. */
const index = v.pipe(v.number(), v.integer(), v.minValue(-1));
const positive = v.pipe(v.number(), v.finite(), v.minValue(Number.MIN_VALUE));
const axis = v.picklist([0, 1, 2]);

const part = v.object({
  id: name,
  node: index,
  primitive: index,
  corners: v.strictTuple([vector, vector, vector, vector, vector, vector, vector, vector]),
  virtual: v.boolean(),
});

const members = v.pipe(v.array(name), v.minLength(2));
const named = { id: name, parts: v.array(name) };
const translation = v.object({
  ...named,
  kind: v.literal('translation'),
  parts: members,
  parent: name,
  start: vector,
  end: vector,
  axis,
  direction: v.picklist([-1, 1]),
});
const rotation = v.object({
  ...named,
  kind: v.literal('rotation'),
  parts: members,
  parent: name,
  centre: vector,
  axis: v.pipe(
    vector,
    v.check((n) => Math.abs(Math.hypot(...n) - 1) <= unitSlack, 'Invalid axis: Expected a length of 1'),
  ),
  parent_axis: axis,
  radius: v.pipe(v.number(), v.finite(), v.minValue(0)),
});
/** Reflections, attachments and whatever kinds there may be one day: programs name them, nothing more. */
const other = v.object({ ...named, kind: v.string() });
const relation: v.GenericSchema<unknown, CageRelation> = v.lazy((input) => {
  const kind = (input as { kind?: unknown } | null)?.kind;
  return kind === 'translation' ? translation : kind === 'rotation' ? rotation : other;
});

const shapeSchema: v.GenericSchema<unknown, CageShape> = v.object({
  format: v.exactOptional(v.literal('parsel/shape')),
  version: v.exactOptional(v.literal(1)),
  name: v.pipe(v.string(), v.maxBytes(limits.nameLength)),
  sha256: v.pipe(v.string(), v.regex(/^[0-9a-f]{0,64}$/)),
  frame: v.object({ centre: vector, scale: positive }),
  parts: v.array(part),
  relations: v.array(relation),
});

/**
 * Checks untrusted JSON: `parsel/shape` v1, or as much of it as cageShapeOf() leaves. Refused are unknown versions, numbers
 * that are not finite, ids that occur twice, and groups whose parent or members are no parts or belong to two groups. The
 * place of an error is a JSON pointer.
 */
export function checkShape(json: unknown): Result<CageShape> {
  const read = readFormat(json, shapeSchema, format);
  if (!read.ok) return read;
  const shape = cageShapeOf(read.value);
  const fault = faultOf(shape);
  return fault === null ? { ok: true, value: shape } : { ok: false, error: fault };
}

/** What evaluating programs and drawing need of a shape, and nothing else. */
export function cageShapeOf({ name, sha256, frame, parts, relations }: CageShape): CageShape {
  return {
    name,
    sha256,
    frame,
    parts: parts.map(({ id, node, primitive, corners, virtual }) => ({ id, node, primitive, corners, virtual })),
    relations: relations.map((one) =>
      isGroup(one) ? bareGroup(one) : { id: one.id, kind: one.kind, parts: one.parts },
    ),
  };
}

function bareGroup(group: GroupRelation): GroupRelation {
  const { id, parts, parent } = group;
  if (group.kind === 'translation') {
    const { kind, start, end, axis, direction } = group;
    return { id, kind, parts, parent, start, end, axis, direction };
  }
  const { kind, centre, axis, parent_axis, radius } = group;
  return { id, kind, parts, parent, centre, axis, parent_axis, radius };
}

function faultOf({ parts, relations }: CageShape): ProgramError | null {
  const refusal = (place: string, cause: string, fix: string): ProgramError => ({
    stage: format.stage,
    place,
    cause,
    fix,
  });
  const ids = new Set<string>();
  for (const [i, { id }] of parts.entries()) {
    if (ids.has(id))
      return refusal(`/parts/${i}/id`, `the part ${quote(id)} occurs twice`, 'give each part its own id');
    ids.add(id);
  }
  const relationIds = new Set<string>();
  const grouped = new Set<string>();
  for (const [i, one] of relations.entries()) {
    const place = `/relations/${i}`;
    if (relationIds.has(one.id)) {
      return refusal(`${place}/id`, `the relation ${quote(one.id)} occurs twice`, 'give each relation its own id');
    }
    relationIds.add(one.id);
    if (!isGroup(one)) continue;
    for (const id of [one.parent, ...one.parts]) {
      if (!ids.has(id)) return refusal(place, `the part ${quote(id)} is unknown`, 'name a part of this shape');
      if (grouped.has(id)) {
        return refusal(place, `the part ${quote(id)} is in two groups`, 'leave it in one');
      }
      grouped.add(id);
    }
  }
  return null;
}
