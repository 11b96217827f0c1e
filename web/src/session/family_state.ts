// The family of a CAD program, or of a model of boxes, as a part of the work, and the arithmetic of its sliders: settings, stops, mixtures. All
// lengths are in the program's own unit.
import type { Layer, Program, Shape } from '../program/types';
import type { CadSource } from '../scene/load';
import { type Document, type LayerEntry, partKey, withFreshParameters } from './document';
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
  if (cad.of === 'hexahedra') {
    return new Map(shape.parts.flatMap((part) => (part.virtual ? [] : [[partKey(part), part.id]])));
  }
  const byNode = new Map(shape.parts.filter(({ virtual }) => !virtual).map(({ node, id }) => [node, id]));
  const drawn = cad.parts.filter(({ role }) => role === 'add');
  return new Map(drawn.flatMap(({ id }, node) => (byNode.has(node) ? [[id, byNode.get(node) as string]] : [])));
}

/** The layers of a family's program, in the words of the shape. */
export function familyLayers({ base, found }: FamilySource, shape: Shape, taken: ReadonlySet<string>): Layer[] {
  const ids = shapeIds(base, shape);
  const drawn = base.parts.filter(({ role }) => role === 'add');
  const byNode = new Map(drawn.map(({ id }, node) => [`node:${node}`, ids.get(id)]));
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
  readonly without?: readonly string[];
}

/**
 * A document with a family's sliders, before its edits. Layers of saved work that are these sliders are taken for them.
 * @param saved what was kept of it: its sliders are among the document's first layers
 */
export function withFamily(
  document: Document,
  source: FamilySource | null,
  saved: SavedFamily | undefined,
  newEntry: (layer: Layer) => LayerEntry,
): Document {
  const shape = document.model?.shape;
  if (source === null || shape === undefined) return document;
  const { sliders } = source.found.family;
  const weights = source.found.family.variations.map(() => 0);
  const first = document.layers.slice(0, sliders.length);
  const without = stillOptional(source, saved?.without ?? []);
  const own = familyLayers(source, shape, new Set());
  const isHere = saved?.sliders === sliders.length && first.every(({ layer }, k) => isSameSlider(layer, own[k]));
  if (isHere) return { ...document, family: { ...source, weights, without, keys: first.map(({ key }) => key) } };
  const taken = new Set(document.layers.map(({ layer }) => layer.parameter.name));
  const entries = familyLayers(source, shape, taken).map((layer) => newEntry(layer));
  return {
    ...document,
    layers: [...entries, ...document.layers],
    family: { ...source, weights, without, keys: entries.map(({ key }) => key) },
  };
}

/** Whether a layer is a slider of the family: by its name, or, where its parts go by other names now, by what it moves. */
function isSameSlider(layer: Layer, slider: Layer | undefined): boolean {
  if (slider === undefined) return false;
  const moved = ({ statements }: Layer) =>
    statements.map((statement) => ('feature' in statement ? `${statement.part} ${statement.feature.join(' ')}` : ''));
  return layer.request === slider.request || moved(layer).join('; ') === moved(slider).join('; ');
}

/** Parts that the variation on the stage lacks, by id of the shape: optional ones that are hidden. */
export function absentParts({ family, model, hidden }: Document): ReadonlySet<string> {
  if (family === undefined || model === null) return new Set();
  const ids = shapeIds(family.base, model.shape);
  const optional = family.found.family.optional.flatMap(({ parts }) => parts.map((id) => ids.get(id) ?? ''));
  return new Set(optional.filter((id) => hidden.has(id)));
}

/** Of parts that were left out, those that not all variations have. */
export const stillOptional = ({ found }: FamilySource, ids: readonly string[]): readonly string[] =>
  ids.filter((id) => found.family.optional.some(({ parts }) => parts.includes(id)));

/** Whether parts that are absent together are there, by id of the program. */
export function areThere({ family, model, hidden }: Document, parts: readonly string[]): boolean {
  if (family === undefined || model === null) return true;
  const ids = shapeIds(family.base, model.shape);
  return !parts.some((id) => family.without.includes(id) || hidden.has(ids.get(id) ?? ''));
}

/** A document with its optional parts there or not: hidden, or, where they only cut, left out. */
export function withOptional(document: Document, isThere: (parts: readonly string[]) => boolean): Document {
  const { family, model } = document;
  if (family === undefined || model === null) return document;
  const ids = shapeIds(family.base, model.shape);
  const hidden = new Set(document.hidden);
  const without: string[] = [];
  for (const { parts } of family.found.family.optional) {
    const there = isThere(parts);
    for (const part of parts) {
      const id = ids.get(part);
      if (id === undefined && !there) without.push(part);
      else if (id !== undefined && there) hidden.delete(id);
      else if (id !== undefined) hidden.add(id);
    }
  }
  return { ...document, hidden, family: { ...family, without } };
}

/** Parts that the variation on the stage lacks, by id of the program. */
export function absentIds(document: Document): ReadonlySet<string> {
  const gone = document.family?.found.family.optional.filter(({ parts }) => !areThere(document, parts)) ?? [];
  return new Set(gone.flatMap(({ parts }) => parts));
}

/** The layers that are no sliders of the family. */
export const editsOf = ({ layers, family }: Document): readonly LayerEntry[] =>
  family === undefined ? layers : layers.filter(({ key }) => !family.keys.includes(key));

/** What is kept of a family in links and files; absent where there is none. */
export function savedFamily({ family }: Document): SavedFamily | undefined {
  if (family === undefined) return undefined;
  const isOwn = family.variations === family.base.variations;
  return {
    sliders: family.keys.length,
    choices: Object.entries(family.choices),
    ...(isOwn ? {} : { variations: family.variations }),
    ...(family.without.length > 0 ? { without: family.without } : {}),
  };
}
