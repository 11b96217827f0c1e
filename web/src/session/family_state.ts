// The family of a CAD program as a part of the work, and the arithmetic of its sliders: settings, stops, mixtures. All
// lengths are in the program's own unit.
import type { Layer, Program, Shape } from '../program/types';
import type { CadSource } from '../scene/load';
import { type Document, type LayerEntry, withFreshParameters } from './document';
import type { Choice, FamilySource } from './family_found';

/** One value a slider. */
export type Setting = readonly number[];

export const baseOf = ({ found }: FamilySource): Setting => found.family.sliders.map(({ value }) => value);

/** Where a variation stands. */
export function settingOf({ found }: FamilySource, variation: number): Setting {
  const { setting } = found.family.variations[variation] ?? { setting: {} as Record<string, number> };
  return found.family.sliders.map(({ variable, value }) => setting[variable] ?? value);
}

/**
 * A mixture of variations: the base takes what is missing to a sum of 1, above that weights count relative to their sum
 * (core/family/fill.h).
 */
export function mixed(family: FamilySource, weights: readonly number[]): Setting {
  const sum = weights.reduce((a, b) => a + b, 0);
  const rest = Math.max(0, 1 - sum);
  const settings = weights.map((_, i) => settingOf(family, i));
  return baseOf(family).map((value, k) => {
    let total = rest * value;
    for (const [i, weight] of weights.entries()) total += weight * (settings[i]?.[k] ?? value);
    return total / Math.max(1, sum);
  });
}

/** A value of a slider's layer as a length, and back. */
export const lengthAt = ({ found }: FamilySource, k: number, x: number): number =>
  (found.family.sliders[k]?.value ?? 0) + x * found.scale;
export const valueAt = ({ found }: FamilySource, k: number, length: number): number =>
  (length - (found.family.sliders[k]?.value ?? 0)) / found.scale;

export interface Stops {
  readonly low: number;
  readonly high: number;
  /** What is in the way there, a clause; null: nothing but the slider's own end. */
  readonly lowText: string | null;
  readonly highText: string | null;
}

/**
 * How far a slider may go with the others where they are (core/family/order.h). What is already beyond a stop, as after a
 * mixture, may stay there.
 * @param isAbsent by id of a part of the program
 */
export function stopsOf(
  { found }: FamilySource,
  setting: Setting,
  k: number,
  isAbsent: (id: string) => boolean,
): Stops {
  let [low, high] = [Number.NEGATIVE_INFINITY, Number.POSITIVE_INFINITY];
  let lowText: string | null = null;
  let highText: string | null = null;
  const now = setting[k] ?? 0;
  for (const { form, constant, text, parts } of found.bounds) {
    const slope = form[k] ?? 0;
    if (Math.abs(slope) < 1e-12 || !parts.some(([a, b]) => !isAbsent(a) && !isAbsent(b))) continue;
    const rest = form.reduce((sum, factor, i) => (i === k ? sum : sum + factor * (setting[i] ?? 0)), constant);
    const at = -rest / slope;
    if (slope > 0 && at > low) [low, lowText] = [at, text];
    if (slope < 0 && at < high) [high, highText] = [at, text];
  }
  return { low: Math.min(low, now), high: Math.max(high, now), lowText, highText };
}

/** Every parameter of the program at a setting. */
export function parametersAt({ found }: FamilySource, setting: Setting): Record<string, number> {
  const values = { ...found.values };
  for (const [k, slider] of found.family.sliders.entries()) {
    const change = (setting[k] ?? slider.value) - slider.value;
    for (const [name, factor] of Object.entries(slider['coefficients'] as Record<string, string>)) {
      values[name] = (values[name] ?? 0) + change * fraction(factor);
    }
  }
  return values;
}

/** "-1/2" */
function fraction(text: string): number {
  const [numerator, denominator = '1'] = text.split('/');
  return Number(numerator) / Number(denominator);
}

/** Ids of the shape by ids of the program: node i of the file is the i-th part that adds material. */
export function shapeIds(cad: CadSource, shape: Shape): ReadonlyMap<string, string> {
  const byNode = new Map(shape.parts.filter(({ virtual }) => !virtual).map(({ node, id }) => [node, id]));
  const drawn = cad.parts.filter(({ role }) => role === 'add');
  return new Map(drawn.flatMap(({ id }, node) => (byNode.has(node) ? [[id, byNode.get(node) as string]] : [])));
}

/** The layers of a family's program, in the words of the shape. */
export function familyLayers({ found }: FamilySource, shape: Shape, taken: ReadonlySet<string>): Layer[] {
  const byNode = new Map(shape.parts.filter(({ virtual }) => !virtual).map(({ node, id }) => [`node:${node}`, id]));
  const { layers } = found.program as unknown as Program;
  return withFreshParameters(layers, taken).map((layer) => ({
    ...layer,
    statements: layer.statements.map((statement) =>
      'part' in statement ? { ...statement, part: byNode.get(statement.part) ?? statement.part } : statement,
    ),
  }));
}

/** What is kept of a family beside its layers: the first `sliders` of the program are its. */
export interface SavedFamily {
  readonly sliders: number;
  readonly choices: readonly (readonly [string, Choice])[];
  /** Absent: those that come with the program. */
  readonly variations?: unknown;
}

/**
 * A document with a family's sliders, before its edits. Layers of saved work that are these sliders are taken for them.
 * @param saved sliders among the document's first layers, 0 for none
 */
export function withFamily(
  document: Document,
  source: FamilySource | null,
  saved: number,
  newEntry: (layer: Layer) => LayerEntry,
): Document {
  const shape = document.model?.shape;
  if (source === null || shape === undefined) return document;
  const { sliders } = source.found.family;
  const weights = source.found.family.variations.map(() => 0);
  const first = document.layers.slice(0, sliders.length);
  const isHere = saved === sliders.length && first.every(({ layer }, k) => layer.request === sliders[k]?.name);
  if (isHere) return { ...document, family: { ...source, weights, keys: first.map(({ key }) => key) } };
  const taken = new Set(document.layers.map(({ layer }) => layer.parameter.name));
  const entries = familyLayers(source, shape, taken).map((layer) => newEntry(layer));
  return {
    ...document,
    layers: [...entries, ...document.layers],
    family: { ...source, weights, keys: entries.map(({ key }) => key) },
  };
}

/** Parts that the variation on the stage lacks, by id of the shape: optional ones that are hidden. */
export function absentParts({ family, model, hidden }: Document): ReadonlySet<string> {
  const cad = model?.files.cad;
  if (family === undefined || cad === undefined || model === null) return new Set();
  const ids = shapeIds(cad, model.shape);
  const optional = family.found.family.optional.flatMap(({ parts }) => parts.map((id) => ids.get(id) ?? ''));
  return new Set(optional.filter((id) => hidden.has(id)));
}

/** The same by id of the program, with parts that only cut: they go with what they are absent with. */
export function absentIds(document: Document): ReadonlySet<string> {
  const { family, model } = document;
  const cad = model?.files.cad;
  if (family === undefined || cad === undefined || model === null) return new Set();
  const ids = shapeIds(cad, model.shape);
  const hidden = absentParts(document);
  const gone = family.found.family.optional.filter(({ parts }) => parts.some((id) => hidden.has(ids.get(id) ?? '')));
  return new Set(gone.flatMap(({ parts }) => parts));
}

/** The layers that are no sliders of the family. */
export const editsOf = ({ layers, family }: Document): readonly LayerEntry[] =>
  family === undefined ? layers : layers.filter(({ key }) => !family.keys.includes(key));

/** What is kept of a family in links and files; absent where there is none. */
export function savedFamily({ family, model }: Document): SavedFamily | undefined {
  if (family === undefined) return undefined;
  const isOwn = family.variations === (model?.files.cad?.variations ?? null);
  return {
    sliders: family.keys.length,
    choices: Object.entries(family.choices),
    ...(isOwn ? {} : { variations: family.variations }),
  };
}
