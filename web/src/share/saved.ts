// `parsel/session` v1: the work on a model without the model, for files and links. Untrusted when it is read.
import * as v from 'valibot';
import { shortened } from '../program/cut';
import { limits, programSchema } from '../program/schema';
import type { CameraPose } from '../scene/camera';
import type { Document } from '../session/document';

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

const savedSchema = v.strictObject({
  format: v.literal('parsel/session'),
  version: v.literal(1),
  model: modelSchema,
  /** All layers, also those that are off, with their values. */
  program: programSchema,
  /** Indices of the layers that are off. */
  off: v.pipe(v.array(v.pipe(v.number(), v.integer(), v.minValue(0))), v.maxLength(limits.layers)),
  hidden: v.pipe(v.array(id), v.maxLength(limits.statements)),
  names: v.pipe(v.array(v.strictTuple([id, id])), v.maxLength(limits.statements)),
  /** Labels given in place of the file's own, by "node:<index>/<primitive>". */
  labels: v.exactOptional(
    v.pipe(
      v.array(v.strictTuple([v.pipe(v.string(), v.regex(/^node:\d{1,9}\/\d{1,9}$/)), id])),
      v.maxLength(limits.statements),
    ),
  ),
  view: v.exactOptional(
    v.pipe(v.strictTuple([finite, finite, finite, finite, finite, finite]) as v.GenericSchema<unknown, CameraPose>),
  ),
});
export type Saved = v.InferOutput<typeof savedSchema>;

/** What was read, or a sentence on why it was refused. */
export type ReadResult = { readonly ok: true; readonly saved: Saved } | { readonly ok: false; readonly text: string };

export function save(document: Document, view?: CameraPose): Saved {
  const { model, layers, hidden, names } = document;
  if (model === null) throw new Error('there is no model to save the work on');
  const { shape, source, labels } = model;
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
    ...(view === undefined ? {} : { view }),
  };
}

/** Reads untrusted JSON. */
export function readSaved(json: unknown): ReadResult {
  const header = v.safeParse(v.looseObject({ format: v.string(), version: v.number() }), json);
  if (!header.success || header.output.format !== 'parsel/session') {
    return { ok: false, text: 'This is no saved ParSEL session.' };
  }
  if (header.output.version !== 1) {
    return { ok: false, text: 'This was saved by a newer ParSEL. Reload the page to update it, then try again.' };
  }
  const parsed = v.safeParse(savedSchema, json, { abortEarly: true });
  if (parsed.success) return { ok: true, saved: parsed.output };
  const place = v.getDotPath(parsed.issues[0]) ?? 'the file';
  return { ok: false, text: `This session is damaged at ${shortened(place, 80)}. Ask for it again.` };
}

export function readSavedText(text: string): ReadResult {
  try {
    return readSaved(JSON.parse(text));
  } catch {
    return { ok: false, text: 'This session is damaged: it is not complete. Ask for it again.' };
  }
}
