// The family of a CAD program, or of a model of boxes: what the core found, and what a person chose of it.
import type { CadSource } from '../scene/load';
import type { MethodResult } from '../worker/protocol';

export type FoundFamily = MethodResult<'find_family'>;
export type FamilySlider = FoundFamily['family']['sliders'][number];
export type Choice = 'forced' | 'off';
export type Choices = Readonly<Record<string, Choice>>;

/** One entry of `parsel/variations`, of which only the name matters here. */
export interface NamedVariation {
  readonly name: string;
}

/** `parsel/variations` v1 as the core takes it; null: none. */
export type Variations = { readonly variations: readonly NamedVariation[] } | null;

/** What the core found for a program, its variations and what was chosen. */
export interface FamilySource {
  /** The program, or what stands for one: box_family.ts. */
  readonly base: CadSource;
  /** Program and variations as the core was asked about them. */
  readonly asked: { readonly cad: unknown; readonly variations: Variations };
  readonly found: FoundFamily;
  /** A GLB of each variation. */
  readonly pictures: readonly Uint8Array[];
  readonly variations: Variations;
  readonly choices: Choices;
}

export interface FamilyState extends FamilySource {
  /** Of its sliders' layers, in their order. */
  readonly keys: readonly number[];
  /** How much of each variation is mixed in, 0 … 1. */
  readonly weights: readonly number[];
  /** Optional parts that are left out and were never drawn, so that nothing is hidden for them: those that only cut. By id of the program. */
  readonly without: readonly string[];
}
