// `parsel/session` v1: the work on a model without the model, for files and links. Untrusted when it is read.

import * as v from 'valibot';
import { directions } from '../carve/placing';
import type { Plane } from '../carve/steps';
import { shortened } from '../program/cut';
import { jsonLimits, parseJson } from '../program/json';
import { layerSchema, limits, programSchema } from '../program/schema';
import type { CameraPose } from '../scene/camera';
import { correctionKinds, type Document } from '../session/document';
import { savedFamily } from '../session/family_state';
import { t } from '../texts/texts';
import { extrasEntries, extrasOf, salvageExtras } from './extras';

const id = v.pipe(v.string(), v.minLength(1), v.maxBytes(limits.nameLength));
const finite = v.pipe(v.number(), v.finite(), v.minValue(-1e6), v.maxValue(1e6));

const modelSchema = v.strictObject({
  name: v.pipe(v.string(), v.maxBytes(limits.nameLength)),
  sha256: v.pipe(v.string(), v.regex(/^[0-9a-f]{64}$/)),
  /** Id of a model of the gallery. */
  gallery: v.exactOptional(v.pipe(v.string(), v.regex(/^\w{1,64}$/))),
  /** Address of the file, on the page's own site or on this machine. */
  url: v.exactOptional(v.pipe(v.string(), v.maxLength(2048))),
});

/** A part and its name. */
const renamed: v.GenericSchema<unknown, [string, string]> = v.strictTuple([id, id]);
const partKey = v.pipe(v.string(), v.regex(/^node:\d{1,9}\/\d{1,9}$/));
const label: v.GenericSchema<unknown, [string, string]> = v.strictTuple([partKey, id]);
const correction = v.strictObject({
  kind: v.picklist(correctionKinds),
  parts: v.pipe(
    v.strictTuple([partKey, partKey]),
    v.check(([a, b]) => a !== b),
  ),
});
const choice: v.GenericSchema<unknown, [string, 'forced' | 'off']> = v.strictTuple([
  v.pipe(v.string(), v.maxBytes(2 * limits.nameLength)),
  v.picklist(['forced', 'off']),
]);
const viewSchema: v.GenericSchema<unknown, CameraPose> = v.strictTuple([
  finite,
  finite,
  finite,
  finite,
  finite,
  finite,
]);

/** Of a CAD program: how many of the first layers are its sliders, and what makes its family another than it came with. */
const familySchema = v.strictObject({
  sliders: v.pipe(v.number(), v.integer(), v.minValue(0), v.maxValue(limits.layers)),
  choices: v.pipe(v.array(choice), v.maxLength(limits.statements)),
  variations: v.exactOptional(v.looseObject({ format: v.literal('parsel/variations') })),
  without: v.exactOptional(v.pipe(v.array(v.string()), v.maxLength(limits.statements))),
});

const splitSchema = v.strictObject({
  by: v.picklist(['auto', 'components', 'materials', 'regions']),
  fine: v.pipe(v.number(), v.minValue(0), v.maxValue(1)),
});

const partKeys = v.pipe(v.array(partKey), v.minLength(1), v.maxLength(limits.statements));
const planeSchema: v.GenericSchema<unknown, Plane> = v.strictTuple([finite, finite, finite, finite]);
const carveSchema = v.variant('kind', [
  v.strictObject({ kind: v.literal('join'), parts: partKeys }),
  v.strictObject({ kind: v.literal('divide'), part: partKey }),
  v.strictObject({ kind: v.literal('cut'), parts: partKeys, plane: planeSchema }),
  v.strictObject({
    kind: v.literal('place'),
    ...v.entriesFromList(['up', 'front'], v.picklist(directions)),
    metres: v.pipe(v.number(), v.minValue(1e-6), v.maxValue(1e6)),
  }),
]);
/** Steps depend on those before them: all of them, or none. What faces the front of a model is not above it. */
const carvedSchema = v.pipe(
  v.array(carveSchema),
  v.minLength(1),
  v.maxLength(limits.layers),
  v.everyItem((step) => step.kind !== 'place' || step.up.charAt(1) !== step.front.charAt(1)),
);

const savedSchema = v.strictObject({
  format: v.literal('parsel/session'),
  version: v.literal(1),
  model: modelSchema,
  /** All layers, also those that are off, with their values. */
  program: programSchema,
  /** Indices of the layers that are off. */
  off: v.pipe(v.array(v.pipe(v.number(), v.integer(), v.minValue(0))), v.maxLength(limits.layers)),
  hidden: v.pipe(v.array(id), v.maxLength(limits.statements)),
  names: v.pipe(v.array(renamed), v.maxLength(limits.statements)),
  /** Labels given in place of the file's own, by "node:<index>/<primitive>". */
  labels: v.exactOptional(v.pipe(v.array(label), v.maxLength(limits.statements))),
  /** Joints and mirror images put right by hand. */
  corrections: v.exactOptional(v.pipe(v.array(correction), v.maxLength(limits.statements))),
  family: v.exactOptional(familySchema),
  /** How the parts were told apart before all else; the hash is that of the result. */
  split: v.exactOptional(splitSchema),
  /** Parts that were then joined, split and cut by hand, step by step. */
  carved: v.exactOptional(carvedSchema),
  view: v.exactOptional(viewSchema),
  ...extrasEntries,
});
export type Saved = v.InferOutput<typeof savedSchema>;

/** Saved work as it was read, and what of it was damaged and left out, in words. */
export interface Work {
  readonly saved: Saved;
  readonly lost: readonly string[];
}

/** What was read, or a sentence on why it was refused. */
export type ReadResult = ({ readonly ok: true } & Work) | { readonly ok: false; readonly text: string };

export function save(document: Document, view?: CameraPose): Saved {
  const { model, layers, hidden, names } = document;
  if (model === null) throw new Error('there is no model to save the work on');
  const { shape, source, labels, corrections = [] } = model;
  const family = savedFamily(document);
  const { split, carved } = model.files;
  return {
    format: 'parsel/session',
    version: 1,
    model: {
      name: shape.name,
      sha256: shape.sha256,
      ...(source.kind === 'gallery' ? { gallery: source.id } : {}),
      ...(source.kind === 'url' ? { url: source.url } : {}),
    },
    program: {
      format: 'parsel/program',
      version: 1,
      shape: { name: shape.name, sha256: shape.sha256 },
      layers: layers.map(({ layer, value }) => ({ ...layer, parameter: { ...layer.parameter, value } })),
    },
    off: layers.flatMap(({ enabled }, i) => (enabled ? [] : [i])),
    hidden: [...hidden],
    names: [...names],
    ...(labels.size > 0 ? { labels: [...labels] } : {}),
    ...(corrections.length > 0
      ? { corrections: corrections.map(({ kind, parts: [a, b] }) => ({ kind, parts: [a, b] })) }
      : {}),
    ...(family === undefined ? {} : { family: family as unknown as v.InferOutput<typeof familySchema> }),
    ...(split === undefined ? {} : { split: { by: split.by, fine: split.fine } }),
    ...(carved === undefined ? {} : { carved: [...carved.steps] as NonNullable<Saved['carved']> }),
    ...extrasOf(document),
    ...(view === undefined ? {} : { view }),
  };
}

/** Reads untrusted JSON. What is damaged loses its bad elements, and nothing else. */
export function readSaved(json: unknown): ReadResult {
  const header = v.safeParse(v.looseObject({ format: v.string(), version: v.number() }), json);
  if (!header.success || header.output.format !== 'parsel/session') {
    return { ok: false, text: t`This is no saved ParSEL session.` };
  }
  if (header.output.version !== 1) {
    return { ok: false, text: t`This was saved by a newer ParSEL. Reload the page to update it, then try again.` };
  }
  const parsed = v.safeParse(savedSchema, json, { abortEarly: true });
  if (parsed.success) return { ok: true, saved: parsed.output, lost: [] };
  const work = salvage(header.output);
  if (work !== null) return { ok: true, ...work };
  const place = v.getDotPath(parsed.issues[0]) ?? t`the file`;
  return { ok: false, text: t`This session is damaged at ${shortened(place, 80)}. Ask for it again.` };
}

type Json = Readonly<Record<string, unknown>>;
const objectOf = (value: unknown): Json => (typeof value === 'object' && value !== null ? (value as Json) : {});

/** What is whole of a damaged session; null when it does not even say which model it is about. */
function salvage(json: Json): Work | null {
  const lost: string[] = [];
  const listOf = (value: unknown, what: string): readonly unknown[] => {
    if (value !== undefined && !Array.isArray(value)) lost.push(what);
    return Array.isArray(value) ? value : [];
  };
  /** The elements that a schema accepts, each with its index. */
  const whole = <T>(list: readonly unknown[], schema: v.GenericSchema<unknown, T>, most: number) =>
    list.slice(0, most).flatMap((item, index) => {
      const read = v.safeParse(schema, item);
      return read.success ? [{ index, item: read.output }] : [];
    });
  const some = <T>(list: readonly unknown[], schema: v.GenericSchema<unknown, T>, what: string): T[] => {
    const kept = whole(list, schema, limits.statements);
    if (kept.length < list.length) lost.push(what);
    return kept.map(({ item }) => item);
  };

  const model = v.safeParse(modelSchema, json['model']);
  if (!model.success) return null;
  const all = listOf(objectOf(json['program'])['layers'], t`the edits`);
  const layers = whole(all, layerSchema, limits.layers);
  const kept = new Set(layers.map(({ index }) => index));
  for (const [i, layer] of all.entries()) if (!kept.has(i)) lost.push(editName(i, layer));
  const off = new Set(some(listOf(json['off'], t`which edits are off`), v.number(), t`which edits are off`));
  const labels = json['labels'] === undefined ? [] : some(listOf(json['labels'], t`labels`), label, t`labels`);
  const corrected = t`joints and mirror images put right by hand`;
  const given = json['corrections'];
  const corrections = given === undefined ? [] : some(listOf(given, corrected), correction, corrected);
  const view = v.safeParse(viewSchema, json['view']);
  const split = v.safeParse(splitSchema, json['split']);
  if (!split.success && json['split'] !== undefined) lost.push(t`how the parts were told apart`);
  const carved = v.safeParse(carvedSchema, json['carved']);
  if (!carved.success && json['carved'] !== undefined) lost.push(t`what was done to the parts by hand`);
  if (!view.success && json['view'] !== undefined) lost.push(t`the view`);
  const family = v.safeParse(familySchema, json['family']);
  if (!family.success && json['family'] !== undefined) lost.push(t`the family`);
  const [extras, damaged] = salvageExtras(
    json,
    layers.map(({ index }) => index),
  );
  lost.push(...damaged);
  const { name, sha256 } = model.output;
  const saved: Saved = {
    format: 'parsel/session',
    version: 1,
    model: model.output,
    program: {
      format: 'parsel/program',
      version: 1,
      shape: { name, sha256 },
      layers: layers.map(({ item }) => item),
    },
    off: layers.flatMap(({ index }, i) => (off.has(index) ? [i] : [])),
    hidden: some(listOf(json['hidden'], t`what is hidden`), id, t`what is hidden`),
    names: some(listOf(json['names'], t`names`), renamed, t`names`),
    ...(labels.length > 0 ? { labels } : {}),
    ...(corrections.length > 0 ? { corrections } : {}),
    ...(family.success ? { family: family.output } : {}),
    ...(split.success ? { split: split.output } : {}),
    ...(carved.success ? { carved: carved.output } : {}),
    ...(view.success ? { view: view.output } : {}),
    ...extras,
  };
  return { saved, lost: [...new Set(lost)] };
}

/** "edit 2 (widen the chair)", as far as it says so. */
function editName(index: number, layer: unknown): string {
  const request = objectOf(layer)['request'];
  const name = typeof request === 'string' ? shortened(request, 60).trim() : '';
  return name === '' ? t`edit ${index + 1}` : t`edit ${index + 1} (“${name}”)`;
}

/** A sentence on what is missing; empty when nothing is. */
export function lostWords({ lost }: Work): string {
  const most = 3;
  if (lost.length === 0) return '';
  const named = lost.slice(0, most).join(', ');
  const rest = lost.length - most;
  const what = rest > 0 ? t`${named} and ${rest} more` : named;
  return t`Part of this work was damaged and is left out: ${what}.`;
}

/** Reads an untrusted file, or what a link holds. */
export function readSavedText(content: string | Uint8Array): ReadResult {
  // A character takes up to four bytes, so that what is longer than this is too long in any case.
  if (typeof content !== 'string' && content.length > 4 * jsonLimits.length) return damaged(t`it is too large`);
  const json = parseJson(typeof content === 'string' ? content : new TextDecoder().decode(content));
  return json.ok ? readSaved(json.value) : damaged(json.error.cause);
}

const damaged = (cause: string): ReadResult => ({
  ok: false,
  text: t`This session is damaged: ${cause}. Ask for it again.`,
});
