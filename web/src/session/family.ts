// What can be done to the family of a CAD program, or of a model of boxes: moving its sliders one by one or as a mixture, choosing what its
// variations share, keeping a variation. Each is one step of the history.

import { batch, type Signal, signal } from '@preact/signals';
import { parseJson } from '../program/json';
import { errorMessage, type Shape } from '../program/types';
import type { CadSource } from '../scene/load';
import { plural, t } from '../texts/texts';
import type { BoundsRead, boxesOf } from './box_family';
import { type Document, type LayerEntry, nameOf, type OpenModel } from './document';
import { activeLayers, type Evaluation } from './evaluation';
import type { Choice, Choices, FamilySource, FamilyState, NamedVariation, Variations } from './family_found';
import {
  absentIds,
  areThere,
  baseOf,
  editsOf,
  familyLayers,
  lengthAt,
  mixed,
  parametersAt,
  type SavedFamily,
  type Setting,
  settingOf,
  shapeIds,
  stillOptional,
  valueAt,
  withOptional,
} from './family_state';
import { FileError, type FoundFiles } from './files';
import type { History } from './history';
import type { Layers } from './layers';
import type { ModelCore } from './model_core';
import type { RunOptions, Tasks } from './tasks';

const none: Choices = {};

/** Which optional parts a variation has; null: the program itself, which has all. */
const hasIn = ({ found }: FamilySource, variation: number | null) => {
  const absent = variation === null ? [] : (found.family.variations[variation]?.absent ?? []);
  return (parts: readonly string[]) => !parts.some((id) => absent.includes(id));
};

/** A program among files, as what it makes; other files as they are. Rejects with what the core refuses, by its line. */
export async function withProgramRead(core: ModelCore, files: FoundFiles, options: RunOptions): Promise<FoundFiles> {
  if (files.program === undefined) return files;
  const { read, glb } = await core.readCad(files.name, files.main, options);
  const beside = files.program.variations;
  const cad: CadSource = {
    program: read.cad,
    variations: beside === null ? null : variationsIn(beside),
    parts: read.parts,
    remarks: read.warnings.slice(0, 3).map((text) => `${text.charAt(0).toUpperCase()}${text.slice(1)}.`),
  };
  return { name: files.name, main: glb, external: new Map(), cad };
}

function variationsIn(bytes: Uint8Array): unknown {
  const read = parseJson(new TextDecoder().decode(bytes));
  if (!read.ok) throw new FileError(t`The variations beside the program cannot be read: ${errorMessage(read.error)}`);
  return read.value;
}

/** Not among what is fetched first: few open a program, or keep a variation. */
const boxFamily = () => import('./box_family');

/** What parts are called that nobody has renamed. */
const nameIn = (shape: Shape) => (id: string) => shape.parts.find((part) => part.id === id)?.name ?? id;

/** What the variations of a program, or of the boxes of a shape, share. */
async function findFamily(
  core: ModelCore,
  base: CadSource,
  shape: Shape,
  variations: Variations,
  choices: Choices,
  options: Pick<RunOptions, 'signal'>,
): Promise<FamilySource> {
  const { askedOf, inFrame } = await boxFamily();
  const asked = askedOf(base, variations, shape.frame.scale);
  const { found, pictures } = await core.findFamily({ ...asked, choices }, options);
  return {
    base,
    asked,
    found: base.of === 'hexahedra' ? inFrame(found, shape.frame) : found,
    pictures,
    variations,
    choices,
  };
}

/**
 * The family of a model that came of a program, with what saved work says of it; of another model, that of the variations
 * that saved work has of it, else null.
 */
export async function familyOf(
  core: ModelCore,
  { files: { cad }, shape }: Pick<OpenModel, 'files' | 'shape'>,
  saved: SavedFamily | undefined,
  options: RunOptions,
): Promise<FamilySource | null> {
  const own =
    cad === undefined ? null : () => findFamily(core, cad, shape, cad.variations as Variations, none, options);
  if (saved === undefined) return own?.() ?? null;
  const ofBoxes = cad === undefined && saved.variations !== undefined;
  const boxes = ofBoxes ? (await boxFamily()).boxProgram(shape, nameIn(shape)) : null;
  const base = cad ?? (boxes?.ok ? boxes.base : null);
  if (base === null) return null;
  try {
    const variations = (saved.variations ?? base.variations) as Variations;
    return await findFamily(core, base, shape, variations, Object.fromEntries(saved.choices), options);
  } catch {
    options.signal.throwIfAborted();
    return own?.() ?? null; // of another version, or made up
  }
}

export interface FamilyActions {
  /** Weights of a mixture that is being made. */
  readonly mixing: Signal<readonly number[] | null>;
  /** Where the sliders stand, ahead of the document while they are dragged. */
  settingNow(family: FamilyState): Setting;
  /**
   * Whether what stands there is a variation, or (null) the program itself: its optional parts, and its setting of the
   * sliders as far as they go, since a variation may lack what one of them moves.
   */
  isShown(variation: number | null): boolean;
  /** Mixes a variation in by another weight, by as much as the sliders then move. Kept when `settle` says so. */
  mix(variation: number, weight: number, settle: boolean): void;
  /** Whether optional parts, which are absent together, are there. */
  setThere(parts: readonly string[], there: boolean): void;
  /** Puts everything where a variation, or (null) the program itself, has it. */
  showVariation(variation: number | null): void;
  /** Chooses what is shared against the evidence; null: as the variations say. */
  choose(core: ModelCore, changes: ReadonlyMap<string, Choice | null>): Promise<void>;
  /**
   * Makes a variation of what is shown, with what edits beside the family do where the parts are boxes along the axes, which
   * any model may have. False, and a sentence, when that cannot be.
   */
  keepVariation(core: ModelCore, name: string): Promise<boolean>;
  /** Adds variations in one step; those of the same names give way. False, and a sentence, when that cannot be. */
  addVariations(core: ModelCore, added: readonly NamedVariation[]): Promise<boolean>;
  removeVariation(core: ModelCore, variation: number): Promise<void>;
}

export function createFamily(
  history: History<Document>,
  { compiled, slide, sliderValue }: Evaluation,
  { newEntry }: Pick<Layers, 'newEntry'>,
  { run, say }: Tasks,
): FamilyActions {
  const document = history.present;
  const mixing = signal<readonly number[] | null>(null);
  const clamp = ({ layer }: LayerEntry, x: number) => Math.min(layer.parameter.max, Math.max(layer.parameter.min, x));
  const entryOf = (key: number) => document.peek().layers.find((entry) => entry.key === key);

  const read = (family: FamilyState, value: (entry: LayerEntry) => number): Setting =>
    family.keys.map((key, k) => {
      const entry = entryOf(key);
      return lengthAt(family, k, entry === undefined ? 0 : value(entry));
    });
  const settingNow = (family: FamilyState) => read(family, sliderValue);

  function isShown(variation: number | null): boolean {
    const { family } = document.value;
    if (family === undefined) return false;
    const setting = variation === null ? baseOf(family) : settingOf(family, variation);
    const isAt = family.keys.every((key, k) => {
      const entry = entryOf(key);
      if (entry === undefined) return false;
      return Math.abs(sliderValue(entry) - clamp(entry, valueAt(family, k, setting[k] ?? 0))) < 1e-6;
    });
    const has = hasIn(family, variation);
    return isAt && family.found.family.optional.every(({ parts }) => areThere(document.value, parts) === has(parts));
  }

  /** Layers with the family's sliders at a setting. */
  function layersAt(family: FamilyState, setting: Setting): readonly LayerEntry[] {
    return document.peek().layers.map((entry) => {
      const k = family.keys.indexOf(entry.key);
      return k < 0 ? entry : { ...entry, value: clamp(entry, valueAt(family, k, setting[k] ?? 0)) };
    });
  }

  function mix(variation: number, weight: number, settle: boolean): void {
    const { family } = document.peek();
    if (family === undefined) return;
    const weights = family.weights.map((one, i) => (i === variation ? weight : one));
    // What was moved by hand stays moved: only the difference of the two mixtures is added.
    const from = mixed(family, family.weights);
    const to = mixed(family, weights);
    const setting = read(family, ({ value }) => value).map((length, k) => length + (to[k] ?? 0) - (from[k] ?? 0));
    batch(() => {
      if (settle) {
        mixing.value = null;
        const label = t`mix in “${family.found.family.variations[variation]?.name ?? ''}”`;
        const next = { ...document.peek(), layers: layersAt(family, setting), family: { ...family, weights } };
        history.push(label, next, `mix ${variation}`);
      } else {
        mixing.value = weights;
        for (const [k, key] of family.keys.entries()) slide(key, valueAt(family, k, setting[k] ?? 0));
      }
    });
  }

  function showVariation(variation: number | null): void {
    const { family, model } = document.peek();
    if (family === undefined || model === null) return;
    const setting = variation === null ? baseOf(family) : settingOf(family, variation);
    const weights = family.weights.map((_, i) => (i === variation ? 1 : 0));
    const name = variation === null ? model.shape.name : family.found.family.variations[variation]?.name;
    const next = { ...document.peek(), layers: layersAt(family, setting), family: { ...family, weights } };
    history.push(t`show “${name ?? ''}”`, withOptional(next, hasIn(family, variation)));
  }

  function setThere(parts: readonly string[], there: boolean): void {
    const now = document.peek();
    const isThose = (group: readonly string[]) => group.some((id) => parts.includes(id));
    const next = withOptional(now, (group) => (isThose(group) ? there : areThere(now, group)));
    history.push(there ? t`show@step` : t`hide@step`, next);
  }

  /**
   * The family anew, with the sliders as near as they can be to where they stood, or where the variation `shown` has them,
   * which is what the edits beside them made: these go back to 0.
   */
  async function find(
    core: ModelCore,
    base: CadSource,
    variations: Variations,
    choices: Choices,
    label: string,
    shown?: string,
  ): Promise<boolean> {
    const { model, family: asked } = document.peek();
    if (model === null) return false;
    const source = await run(t`Looking for what they share`, (options) =>
      findFamily(core, base, model.shape, variations, choices, options),
    );
    const { family } = document.peek();
    if (source === null || family !== asked || document.peek().model !== model) return false;
    const found = source.found.family;
    const names = found.variations.map(({ name }) => name);
    const index = shown === undefined ? -1 : names.indexOf(shown);
    const edits = editsOf(document.peek()).map((entry) => (index < 0 ? entry : { ...entry, value: 0 }));
    const values = family === undefined ? {} : parametersAt(family, settingNow(family));
    const setting =
      index < 0 ? found.sliders.map(({ parameter, value }) => values[parameter] ?? value) : settingOf(source, index);
    const taken = new Set(edits.map(({ layer }) => layer.parameter.name));
    const entries = familyLayers(source, model.shape, taken).map((layer, k) => {
      const entry = newEntry(layer);
      return { ...entry, value: clamp(entry, valueAt(source, k, setting[k] ?? 0)) };
    });
    const before = family?.found.family.variations.map(({ name }) => name) ?? [];
    const weights = names.map((name, i) =>
      index < 0 ? (family?.weights[before.indexOf(name)] ?? 0) : Number(i === index),
    );
    history.push(label, {
      ...document.peek(),
      layers: [...entries, ...edits],
      family: {
        ...source,
        weights,
        without: stillOptional(source, family?.without ?? []),
        keys: entries.map(({ key }) => key),
      },
    });
    const sliders = plural(entries.length, '{n} slider', '{n} sliders');
    if (family === undefined) say(t`What “${shown ?? ''}” shares with the model leaves ${sliders}.`);
    else sayChange(family.keys.length, entries.length, sliders);
    return true;
  }

  function sayChange(before: number, after: number, sliders: string): void {
    say(
      before === after
        ? t`${sliders}, as before: the rest of what they share implies it.`
        : t`${sliders}, ${before} before.`,
    );
  }

  async function choose(core: ModelCore, changes: ReadonlyMap<string, Choice | null>): Promise<void> {
    const { family } = document.peek();
    if (family === undefined) return;
    const choices: Record<string, Choice> = { ...family.choices };
    for (const [id, choice] of changes)
      if (choice === null) delete choices[id];
      else choices[id] = choice;
    await find(core, family.base, family.variations, choices, t`choose what they share`);
  }

  async function keepVariation(core: ModelCore, name: string): Promise<boolean> {
    const { boxProgram, boxesOf } = await boxFamily();
    const { family, model, hidden } = document.peek();
    if (model === null) return false;
    const moved = activeLayers(document.peek()).some(({ key, value }) => !family?.keys.includes(key) && value !== 0);
    if (moved && family !== undefined && family.base.of !== 'hexahedra') {
      say(t`A variation is made of the sliders of the family alone: put the edits beside it back to 0 first.`, 'error');
      return false;
    }
    const first = family === undefined ? boxProgram(model.shape, (id) => nameOf(document.peek(), id)) : null;
    const base = family?.base ?? (first?.ok ? first.base : null);
    if (base === null) {
      if (first?.ok === false) say(first.text, 'error');
      return false;
    }
    const ids = shapeIds(base, model.shape);
    const left = absentIds(document.peek());
    const isAbsent = (id: string) => left.has(id) || hidden.has(ids.get(id) ?? '');
    const absent = base.parts.flatMap(({ id }) => (isAbsent(id) ? [id] : []));
    if (family !== undefined && !moved) {
      const values = parametersAt(family, settingNow(family));
      return addVariations(core, [{ name, source: 'hand', values, absent } as NamedVariation]);
    }
    const boxes = boxesNow(model, boxesOf);
    if (!boxes.ok) {
      say(boxes.text, 'error');
      return false;
    }
    const kept = { name, source: 'edit', bounds: Object.fromEntries(boxes.bounds), absent };
    const others = (family?.variations?.variations ?? []).filter((other) => other.name !== name);
    const variations = { format: 'parsel/variations', version: 1, variations: [...others, kept] };
    return find(core, base, variations, family?.choices ?? none, t`keep “${name}”`, name);
  }

  /** The boxes of the parts where all sliders stand; refused where there are others, or more, than at rest. */
  function boxesNow({ shape }: OpenModel, read: typeof boxesOf): BoundsRead {
    const named = (id: string) => nameOf(document.peek(), id);
    const state = compiled.peek();
    if (state.kind === 'refused') return { ok: false, text: state.text };
    if (state.kind === 'none') return read(shape, [], named);
    const { groups, corners } = state.evaluator;
    const changed = groups.find((group) => group !== null && group.count !== group.relation.parts.length);
    if (changed) {
      return {
        ok: false,
        text: t`A variation has as many parts as the model: put the number of “${named(changed.relation.parent)}” back first.`,
      };
    }
    return read(shape, corners, named);
  }

  async function addVariations(core: ModelCore, added: readonly NamedVariation[]): Promise<boolean> {
    const { family } = document.peek();
    const [first] = added;
    if (family === undefined || first === undefined) return false;
    const names = new Set(added.map(({ name }) => name));
    const others = (family.variations?.variations ?? []).filter(({ name }) => !names.has(name));
    const variations = { format: 'parsel/variations', version: 1, variations: [...others, ...added] };
    const label = added.length === 1 ? t`keep “${first.name}”` : t`keep ${added.length} kinds`;
    return find(core, family.base, variations, family.choices, label);
  }

  async function removeVariation(core: ModelCore, variation: number): Promise<void> {
    const { family } = document.peek();
    const list = family?.variations?.variations;
    if (family === undefined || list === undefined) return;
    const label = t`remove “${list[variation]?.name ?? ''}”`;
    if (list.length === 1 && family.base.of === 'hexahedra') {
      // There is nothing but the model then, and no family.
      const { family: _, ...rest } = document.peek();
      history.push(label, { ...rest, layers: editsOf(document.peek()) });
      return;
    }
    const variations = { ...family.variations, variations: list.filter((_, i) => i !== variation) };
    await find(core, family.base, variations, family.choices, label);
  }

  return {
    mixing,
    settingNow,
    isShown,
    mix,
    setThere,
    showVariation,
    choose,
    keepVariation,
    addVariations,
    removeVariation,
  };
}
