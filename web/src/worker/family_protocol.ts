// What the page and the core say to each other about CAD programs and their families: wasm/cad_methods.cpp.
import * as v from 'valibot';

const cadSchema = v.looseObject({ format: v.literal('parsel/cad'), version: v.literal(1) });

/** A constraint of the base between features such as "seat.x-" or "leg_front_left.sy", and how it fares elsewhere. */
const constraintSchema = v.looseObject({
  id: v.string(),
  kind: v.picklist(['coplanar', 'coaxial', 'coincident', 'equal']),
  a: v.string(),
  b: v.string(),
  state: v.picklist(['common', 'near', 'accidental', 'forced', 'off']),
  kept: v.boolean(),
  /** Variations that have its parts, and those of them in which it holds. */
  of: v.number(),
  holds: v.number(),
  broken_by: v.optional(v.array(v.string())),
});
export type Constraint = v.InferOutput<typeof constraintSchema>;

/** Lengths in the model's own unit. */
const sliderSchema = v.looseObject({
  /** The parameter that it sets. */
  parameter: v.string(),
  /** "leg height", unique. */
  name: v.string(),
  variable: v.string(),
  /** "Leg": what it belongs to. */
  section: v.string(),
  /** In the base. */
  value: v.number(),
  /** The hull of the base and the variations. */
  min: v.number(),
  max: v.number(),
});

/** `parsel/family` v1, as far as the page reads it. */
const familySchema = v.looseObject({
  format: v.literal('parsel/family'),
  version: v.literal(1),
  counts: v.looseObject({ sliders: v.number(), dimensions: v.number(), common: v.number(), holding: v.number() }),
  constraints: v.array(constraintSchema),
  sliders: v.array(sliderSchema),
  /** Parts that are absent together, by id, and from which variations. */
  optional: v.array(v.looseObject({ parts: v.array(v.string()), absent_from: v.array(v.string()) })),
  /** `setting`: a value for each slider's variable. */
  variations: v.array(
    v.looseObject({ name: v.string(), setting: v.record(v.string(), v.number()), absent: v.array(v.string()) }),
  ),
  warnings: v.array(v.string()),
});

const familyParameters = {
  /** As open_cad gave it. */
  cad: v.unknown(),
  /** `parsel/variations` v1, or null: none. */
  variations: v.unknown(),
  /** By id of a constraint. */
  choices: v.record(v.string(), v.picklist(['forced', 'off'])),
};

export const familyMethods = {
  /** An OpenSCAD text, the one buffer, as parts with literal numbers; and as a GLB, one node a part that adds material. */
  open_cad: {
    parameters: v.strictObject({ name: v.string() }),
    result: v.strictObject({
      cad: cadSchema,
      /** Each with its line. */
      warnings: v.array(v.string()),
      /** `stem` is shared by parts that belong together: "leg". */
      parts: v.array(
        v.strictObject({
          id: v.string(),
          name: v.string(),
          stem: v.string(),
          role: v.picklist(['add', 'cut', 'meet']),
        }),
      ),
    }),
  },
  /**
   * What the variations of a program share, and the sliders that are left; one GLB a variation as buffers. Stateless.
   * A slider k at x of its layer's parameter stands at value + x · scale.
   */
  find_family: {
    parameters: v.strictObject(familyParameters),
    result: v.strictObject({
      family: familySchema,
      program: v.looseObject({ layers: v.array(v.unknown()) }),
      /** Of every parameter in the base. */
      values: v.record(v.string(), v.number()),
      /** form · setting + constant ≥ 0 while both parts of one of the pairs are there; `text` says what stops. */
      bounds: v.array(
        v.strictObject({
          form: v.array(v.number()),
          constant: v.number(),
          text: v.string(),
          parts: v.array(v.strictTuple([v.string(), v.string()])),
        }),
      ),
      scale: v.number(),
      /** Of one unit of the model. */
      metres: v.number(),
    }),
  },
  /** The family as an OpenSCAD program that begins at `setting`, and its Customizer's parameter sets. */
  family_text: {
    parameters: v.strictObject({
      ...familyParameters,
      setting: v.array(v.number()),
      /** One an optional group. */
      with: v.array(v.boolean()),
    }),
    result: v.strictObject({
      scad: v.string(),
      sets: v.looseObject({ parameterSets: v.record(v.string(), v.record(v.string(), v.string())) }),
    }),
  },
  /** What a language model is asked about a program: which kinds of it there are, or the numbers of one `kind`. */
  cad_prompt: {
    parameters: v.strictObject({
      cad: v.unknown(),
      task: v.picklist(['kinds', 'variation']),
      /** Empty for kinds. */
      kind: v.string(),
      /** How many kinds; 0: as many as usual. */
      count: v.number(),
    }),
    result: v.strictObject({
      prompt: v.strictObject({ task: v.string(), text: v.string(), hash: v.string(), version: v.string() }),
      words: v.string(),
      schema: v.looseObject({ type: v.optional(v.string()) }),
    }),
  },
  /** What the replies mean: the kinds, those first that most name; or the numbers of one, in which most agree. */
  read_cad_replies: {
    parameters: v.strictObject({
      cad: v.unknown(),
      task: v.picklist(['kinds', 'variation']),
      kind: v.string(),
      texts: v.array(v.string()),
    }),
    result: v.looseObject({
      kinds: v.optional(
        v.array(
          v.strictObject({ name: v.string(), words: v.string(), absent: v.array(v.string()), votes: v.number() }),
        ),
      ),
      /** What was named and cannot be drawn, with a clause why. */
      dropped: v.optional(v.array(v.strictObject({ name: v.string(), reason: v.string() }))),
      /** `parsel/variations` v1 of one. */
      variation: v.optional(
        v.looseObject({ variations: v.array(v.looseObject({ name: v.string(), absent: v.array(v.string()) })) }),
      ),
      /** Of the program's constraints between parts that the kind has: those that most and that all replies hold. */
      agreed: v.optional(v.number()),
      unanimous: v.optional(v.number()),
      constraints: v.optional(v.number()),
      refused: v.array(
        v.strictObject({
          vote: v.number(),
          error: v.strictObject({ stage: v.string(), place: v.string(), cause: v.string(), fix: v.string() }),
        }),
      ),
    }),
  },
  /** The gallery's CAD programs: the text and the variations of each as buffers. */
  cad_gallery: {
    parameters: v.strictObject({}),
    result: v.strictObject({ programs: v.array(v.strictObject({ id: v.string() })) }),
  },
} as const;
