// What can be done to the family of a CAD program: moving its sliders one by one or as a mixture, choosing what its
// variations share, keeping a variation. Each is one step of the history.

import { batch, type Signal, signal } from '@preact/signals';
import { parseJson } from '../program/json';
import { errorMessage } from '../program/types';
import type { CadSource, ModelFiles } from '../scene/load';
import { plural, t } from '../texts/texts';
import type { Document, LayerEntry } from './document';
import { activeLayers, type Evaluation } from './evaluation';
import type { Choice, Choices, FamilySource, FamilyState, NamedVariation, Variations } from './family_found';
import {
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
  valueAt,
} from './family_state';
import { FileError, type FoundFiles } from './files';
import type { History } from './history';
import type { Layers } from './layers';
import type { ModelCore } from './model_core';
import type { RunOptions, Tasks } from './tasks';

const none: Choices = {};

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

/** The family of a model that came of a program, with what saved work says of it; null for other models. */
export async function familyOf(
  core: ModelCore,
  { cad }: ModelFiles,
  saved: SavedFamily | undefined,
  options: RunOptions,
): Promise<FamilySource | null> {
  if (cad === undefined) return null;
  const find = async (variations: unknown, choices: Choices): Promise<FamilySource> => ({
    ...(await core.findFamily({ cad: cad.program, variations, choices }, options)),
    variations: variations as Variations,
    choices,
  });
  if (saved === undefined) return find(cad.variations, none);
  try {
    return await find(saved.variations ?? cad.variations, Object.fromEntries(saved.choices));
  } catch {
    options.signal.throwIfAborted();
    return find(cad.variations, none); // of another version, or made up
  }
}

export interface FamilyActions {
  /** Weights of a mixture that is being made. */
  readonly mixing: Signal<readonly number[] | null>;
  /** Where the sliders stand, ahead of the document while they are dragged. */
  settingNow(family: FamilyState): Setting;
  /** Whether the sliders stand at a setting, as far as they go: a variation may lack what one of them moves. */
  isAt(family: FamilyState, setting: Setting): boolean;
  /** Mixes a variation in by another weight, by as much as the sliders then move. Kept when `settle` says so. */
  mix(variation: number, weight: number, settle: boolean): void;
  /** Puts everything where a variation, or (null) the program itself, has it. */
  showVariation(variation: number | null): void;
  /** Chooses what is shared against the evidence; null: as the variations say. */
  choose(core: ModelCore, changes: ReadonlyMap<string, Choice | null>): Promise<void>;
  /** Makes a variation of what is shown. False, and a sentence, when that cannot be. */
  keepVariation(core: ModelCore, name: string): Promise<boolean>;
  /** Adds variations in one step; those of the same names give way. False, and a sentence, when that cannot be. */
  addVariations(core: ModelCore, added: readonly NamedVariation[]): Promise<boolean>;
  removeVariation(core: ModelCore, variation: number): Promise<void>;
}

export function createFamily(
  history: History<Document>,
  { slide, sliderValue }: Evaluation,
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

  const isAt = (family: FamilyState, setting: Setting) =>
    family.keys.every((key, k) => {
      const entry = entryOf(key);
      if (entry === undefined) return false;
      return Math.abs(sliderValue(entry) - clamp(entry, valueAt(family, k, setting[k] ?? 0))) < 1e-6;
    });

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
    const { family, model, hidden } = document.peek();
    if (family === undefined || model?.files.cad === undefined) return;
    const shown = variation === null ? null : family.found.family.variations[variation];
    const ids = shapeIds(model.files.cad, model.shape);
    const absent = new Set(hidden);
    for (const { parts } of family.found.family.optional) {
      for (const part of parts) {
        const id = ids.get(part);
        if (id === undefined) continue;
        if (shown?.absent.includes(part)) absent.add(id);
        else absent.delete(id);
      }
    }
    const setting = variation === null ? baseOf(family) : settingOf(family, variation);
    const weights = family.weights.map((_, i) => (i === variation ? 1 : 0));
    history.push(t`show “${shown?.name ?? model.shape.name}”`, {
      ...document.peek(),
      layers: layersAt(family, setting),
      hidden: absent,
      family: { ...family, weights },
    });
  }

  /** The family anew, with the sliders as near as they can be to where they stood. */
  async function find(core: ModelCore, variations: Variations, choices: Choices, label: string): Promise<boolean> {
    const { model, family: asked } = document.peek();
    const cad = model?.files.cad;
    if (model === null || cad === undefined || asked === undefined) return false;
    const answer = await run(t`Looking for what they share`, (options) =>
      core.findFamily({ cad: cad.program, variations, choices }, options),
    );
    const { family } = document.peek();
    if (answer === null || family !== asked || document.peek().model !== model) return false;
    const source: FamilySource = { ...answer, variations, choices };
    const edits = editsOf(document.peek());
    const values = parametersAt(family, settingNow(family));
    const taken = new Set(edits.map(({ layer }) => layer.parameter.name));
    const entries = familyLayers(source, model.shape, taken).map((layer, k) => {
      const { parameter = '', value = 0 } = source.found.family.sliders[k] ?? {};
      const entry = newEntry(layer);
      return { ...entry, value: clamp(entry, valueAt(source, k, values[parameter] ?? value)) };
    });
    const names = family.found.family.variations.map(({ name }) => name);
    const weights = source.found.family.variations.map(({ name }) => family.weights[names.indexOf(name)] ?? 0);
    history.push(label, {
      ...document.peek(),
      layers: [...entries, ...edits],
      family: { ...source, weights, keys: entries.map(({ key }) => key) },
    });
    const [before, after] = [family.keys.length, entries.length];
    const sliders = plural(after, '{n} slider', '{n} sliders');
    say(
      before === after
        ? t`${sliders}, as before: the rest of what they share implies it.`
        : t`${sliders}, ${before} before.`,
    );
    return true;
  }

  async function choose(core: ModelCore, changes: ReadonlyMap<string, Choice | null>): Promise<void> {
    const { family } = document.peek();
    if (family === undefined) return;
    const choices: Record<string, Choice> = { ...family.choices };
    for (const [id, choice] of changes)
      if (choice === null) delete choices[id];
      else choices[id] = choice;
    await find(core, family.variations, choices, t`choose what they share`);
  }

  async function keepVariation(core: ModelCore, name: string): Promise<boolean> {
    const { family, model, hidden } = document.peek();
    if (family === undefined || model?.files.cad === undefined) return false;
    const moved = activeLayers(document.peek()).some(({ key, value }) => !family.keys.includes(key) && value !== 0);
    if (moved) {
      say(t`A variation is made of the sliders of the family alone: put the edits beside it back to 0 first.`, 'error');
      return false;
    }
    const ids = shapeIds(model.files.cad, model.shape);
    const absent = model.files.cad.parts.flatMap(({ id }) => (hidden.has(ids.get(id) ?? '') ? [id] : []));
    const kept = {
      name,
      source: 'hand',
      values: parametersAt(family, settingNow(family)),
      absent,
    };
    return addVariations(core, [kept]);
  }

  async function addVariations(core: ModelCore, added: readonly NamedVariation[]): Promise<boolean> {
    const { family } = document.peek();
    const [first] = added;
    if (family === undefined || first === undefined) return false;
    const names = new Set(added.map(({ name }) => name));
    const others = (family.variations?.variations ?? []).filter(({ name }) => !names.has(name));
    const variations = { format: 'parsel/variations', version: 1, variations: [...others, ...added] };
    const label = added.length === 1 ? t`keep “${first.name}”` : t`keep ${added.length} kinds`;
    return find(core, variations, family.choices, label);
  }

  async function removeVariation(core: ModelCore, variation: number): Promise<void> {
    const { family } = document.peek();
    const list = family?.variations?.variations;
    if (family === undefined || list === undefined) return;
    const variations = { ...family.variations, variations: list.filter((_, i) => i !== variation) };
    await find(core, variations, family.choices, t`remove “${list[variation]?.name ?? ''}”`);
  }

  return { mixing, settingNow, isAt, mix, showVariation, choose, keepVariation, addVariations, removeVariation };
}
