// What saved work may hold beyond layers and parts: the unit of lengths, presets, groups of cards.

import * as v from 'valibot';
import { limits } from '../program/schema';
import { type Document, type LayerEntry, lengthUnits, nameLimit, type Side, sides } from '../session/document';
import { t } from '../texts/texts';

const index = v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(limits.layers - 1));
const name = v.pipe(v.string(), v.minLength(1), v.maxLength(nameLimit));
const presetSchema = v.strictObject({
  name,
  /** Index of a layer, and where its slider stands. */
  values: v.pipe(v.array(v.strictTuple([index, v.pipe(v.number(), v.finite())])), v.maxLength(limits.layers)),
});
const groupSchema = v.strictTuple([index, name]);
const seenSchema = v.strictTuple([index, v.picklist(sides)]);

export const extrasEntries = {
  unit: v.exactOptional(v.picklist(lengthUnits)),
  presets: v.exactOptional(v.pipe(v.array(presetSchema), v.maxLength(limits.layers))),
  /** Index of a layer, and the name of the group that its card is in. */
  groups: v.exactOptional(v.pipe(v.array(groupSchema), v.maxLength(limits.layers))),
  /** Whether sides are said from where a person looks. */
  sides: v.exactOptional(v.literal('seen')),
  /** Index of a layer, and the side that faced whoever asked for it. */
  seen: v.exactOptional(v.pipe(v.array(seenSchema), v.maxLength(limits.layers))),
};
const extrasSchema = v.object(extrasEntries);
export type Extras = v.InferOutput<typeof extrasSchema>;

export function extrasOf({ unit, presets = [], sides: said, layers }: Document): Extras {
  const seen = layers.flatMap((entry, i) => (entry.seen === undefined ? [] : [[i, entry.seen] as [number, Side]]));
  const groups = layers.flatMap(({ group }, i) => (group === undefined ? [] : [[i, group] as [number, string]]));
  const kept = presets.map((preset) => ({
    name: preset.name,
    values: layers.flatMap(({ key }, i) => {
      const value = preset.values.get(key);
      return value === undefined ? [] : [[i, value] as [number, number]];
    }),
  }));
  return {
    ...(unit === undefined ? {} : { unit }),
    ...(kept.length > 0 ? { presets: kept } : {}),
    ...(groups.length > 0 ? { groups } : {}),
    ...(said === undefined ? {} : { sides: said }),
    ...(seen.length > 0 ? { seen } : {}),
  };
}

/** The document with what was saved beside it. What names a layer that is not there is left out. */
export function withExtras(
  document: Document,
  { unit, presets = [], groups = [], sides: said, seen = [] }: Extras,
): Document {
  const groupOf = new Map(groups);
  const seenOf = new Map(seen);
  const layers = document.layers.map((entry, i): LayerEntry => {
    const [group, side] = [groupOf.get(i), seenOf.get(i)];
    return {
      ...entry,
      ...(group === undefined ? {} : { group }),
      ...(side === undefined ? {} : { seen: side }),
    };
  });
  const read = presets.map((preset) => ({
    name: preset.name,
    values: new Map(
      preset.values.flatMap(([i, value]) => {
        const key = layers[i]?.key;
        return key === undefined ? [] : [[key, value] as const];
      }),
    ),
  }));
  return {
    ...document,
    layers,
    ...(unit === undefined ? {} : { unit }),
    ...(read.length > 0 ? { presets: read } : {}),
    ...(said === undefined ? {} : { sides: said }),
  };
}

/**
 * What is whole of the extras of damaged work, and what is not, in words.
 * @param kept of every layer that is left, the index that it had
 */
export function salvageExtras(json: Readonly<Record<string, unknown>>, kept: readonly number[]): [Extras, string[]] {
  const read = v.safeParse(extrasSchema, json);
  if (!read.success) return [{}, [t`presets, groups, the unit and whose sides are meant`]];
  const { presets, groups, seen, ...rest } = read.output;
  const moved = <T>(list: readonly [number, T][]): [number, T][] =>
    list.flatMap(([i, value]) => (kept.includes(i) ? [[kept.indexOf(i), value] as [number, T]] : []));
  const extras: Extras = {
    ...rest,
    ...(presets ? { presets: presets.map((preset) => ({ ...preset, values: moved(preset.values) })) } : {}),
    ...(groups ? { groups: moved(groups) } : {}),
    ...(seen ? { seen: moved(seen) } : {}),
  };
  return [extras, []];
}
