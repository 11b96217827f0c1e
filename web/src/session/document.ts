// What a person works on, as one immutable value: the model, the layers with their values, what is hidden and renamed.
import type { Hint } from '../program/operators';
import { byThemselves } from '../program/rest';
import type { Layer, LocalTriple, Program, Shape, Statement } from '../program/types';
import type { ModelFiles } from '../scene/load';
import type { FamilyState } from './family_found';
import { oncePerShape } from './once_per_shape';
import type { Trace } from './trace';

/** Where a model came from: what a link can name. */
export type ModelSource =
  | { readonly kind: 'gallery'; readonly id: string }
  | { readonly kind: 'url'; readonly url: string }
  | { readonly kind: 'file' };

export interface OpenModel {
  readonly files: ModelFiles;
  readonly source: ModelSource;
  readonly shape: Shape;
  /** Labels given here in place of the file's own, by partKey(). */
  readonly labels: Labels;
  /** Joints and mirror images put right by hand; absent: they are as they were found. */
  readonly corrections?: Corrections;
}

export type Labels = ReadonlyMap<string, string>;
export const noLabels: Labels = new Map();

/** What two parts are to each other, whatever was found in the file: core/shape/corrections.h. */
export const correctionKinds = ['joined', 'loose', 'apart', 'mirrored', 'unmirrored'] as const;
export interface Correction {
  readonly kind: (typeof correctionKinds)[number];
  /** By partKey(). */
  readonly parts: readonly [string, string];
}
export type Corrections = readonly Correction[];
export const noCorrections: Corrections = [];

/** Whether labels, joints and mirror images are those of the file: answers that were recorded are about these. */
export const isAsFound = ({ labels, corrections = noCorrections }: Pick<OpenModel, 'labels' | 'corrections'>) =>
  labels.size === 0 && corrections.length === 0;

/** The model with other corrections. */
export function withCorrections({ corrections: _, ...model }: OpenModel, corrections: Corrections): OpenModel {
  return corrections.length === 0 ? model : { ...model, corrections };
}

/** What names a real part whatever its label and id are. */
export const partKey = ({ node, primitive }: { node: number; primitive: number }) => `node:${node}/${primitive}`;

/** `parsel/edit` v1: what is propagated. Amounts of the seed are in x. */
export interface EditInput {
  readonly seed: readonly Statement[];
  readonly disabled: readonly string[];
  readonly hints: Readonly<Record<string, Hint>>;
}

/** Of a preset or a group, in characters. */
export const nameLimit = 80;

/** Units that lengths can be shown and typed in. */
export const lengthUnits = ['mm', 'cm', 'm', 'in'] as const;
export type LengthUnit = (typeof lengthUnits)[number];

/** Sides of the object, its own: its left is +X, its front +Z. */
export const sides = ['front', 'left', 'back', 'right'] as const;
export type Side = (typeof sides)[number];

/** Named positions of sliders. */
export interface Preset {
  readonly name: string;
  /** Values by key of their layer; layers that came later, or are gone, are not in it. */
  readonly values: ReadonlyMap<number, number>;
}

/** A layer of the program with what the page adds to it. */
export interface LayerEntry {
  /** Unique in a session. */
  readonly key: number;
  readonly layer: Layer;
  readonly enabled: boolean;
  readonly value: number;
  /** Name of the group of cards that it is shown in. */
  readonly group?: string;
  /** The side that faced whoever asked for it, where they said sides from there. */
  readonly seen?: Side;
  /** How propagation found it. Lasts as long as the page: neither links nor autosave keep it. */
  readonly trace?: Trace;
  /** What the layer was where it last fitted, while labels have taken that shape away. Lasts as long as the page. */
  readonly home?: { readonly shape: Shape; readonly layer: Layer };
}

export interface Document {
  readonly model: OpenModel | null;
  readonly layers: readonly LayerEntry[];
  /** Ids of hidden parts. */
  readonly hidden: ReadonlySet<string>;
  /** Names that were given to parts here, by id. */
  readonly names: ReadonlyMap<string, string>;
  /** Unit of all lengths; absent: whichever suits each. */
  readonly unit?: LengthUnit;
  readonly presets?: readonly Preset[];
  /** Sides are said from where a person looks; absent: they are the object's own. */
  readonly sides?: 'seen';
  /** Of a CAD program, or of kept variations: its family, whose sliders are layers like any others. */
  readonly family?: FamilyState;
}

export const emptyDocument: Document = { model: null, layers: [], hidden: new Set(), names: new Map() };

export const wholePart: LocalTriple = [0, 0, 0];

export function emptyProgram({ name, sha256 }: Shape): Program {
  return { format: 'parsel/program', version: 1, shape: { name, sha256 }, layers: [] };
}

/** The program of some layers, with their present values; what names others' parameters has them at 0. */
export function programOf(shape: Shape, layers: readonly LayerEntry[]): Program {
  return {
    ...emptyProgram(shape),
    layers: byThemselves(layers.map(({ layer, value }) => ({ ...layer, parameter: { ...layer.parameter, value } }))),
  };
}

/** A program whose layers say what was asked for. */
export function withRequest(program: Program, request: string): Program {
  if (request === '') return program;
  return { ...program, layers: program.layers.map((layer) => ({ ...layer, request })) };
}

/**
 * Layers whose parameters have names of their own, x1, x2, …, none of which `taken` has: parameter names are unique in a
 * program, and propagation calls every parameter the same.
 */
export function withFreshParameters(layers: readonly Layer[], taken: ReadonlySet<string>): Layer[] {
  const used = new Set(taken);
  const renamed = new Map<string, string>();
  for (const { parameter } of layers) {
    let name = parameter.name;
    for (let i = 1; used.has(name); i++) name = `x${i}`;
    used.add(name);
    renamed.set(parameter.name, name);
  }
  const rename = (amount: string) => amount.replace(/[a-z][a-z0-9_]*/g, (word) => renamed.get(word) ?? word);
  return layers.map((layer) => ({
    ...layer,
    parameter: { ...layer.parameter, name: renamed.get(layer.parameter.name) ?? layer.parameter.name },
    statements: layer.statements.map((statement) =>
      'amount' in statement ? { ...statement, amount: rename(statement.amount) } : statement,
    ),
  }));
}

/** What the parts are called, in the order of the shape. */
export const partNames = (document: Document): string[] =>
  (document.model?.shape.parts ?? []).map(({ id, name }) => document.names.get(id) ?? name);

const ownNames = oncePerShape(({ parts }) => new Map(parts.map(({ id, name }) => [id, name])));

export function nameOf({ names, model }: Document, id: string): string {
  return names.get(id) ?? (model === null ? undefined : ownNames(model.shape).get(id)) ?? id;
}
