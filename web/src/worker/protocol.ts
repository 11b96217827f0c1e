// What the page and the core say to each other. The core's side is wasm/methods.cpp and, of CAD programs, wasm/cad_methods.cpp;
// tests/web/protocol.test.ts fails when the two differ.
import * as v from 'valibot';
import { familyMethods } from './family_protocol';

/** Why something was refused: where it happened, where in the input, what is wrong and what to do about it. */
export const errorSchema = v.strictObject({ stage: v.string(), place: v.string(), cause: v.string(), fix: v.string() });
export type CoreErrorValue = v.InferOutput<typeof errorSchema>;

/** What the language model is asked, by its name in prompts/. Which there are, the core says with the prompts. */
const taskSchema = v.string();
export type Task = v.InferOutput<typeof taskSchema>;

/** One prompt of a request. `relation`: the relation that a validity task asks about. */
const promptSchema = v.strictObject({
  task: taskSchema,
  relation: v.nullable(v.string()),
  text: v.string(),
  /** SHA-256 of the text, in hex. */
  hash: v.string(),
  /** Of the template. */
  version: v.string(),
});
export type Prompt = v.InferOutput<typeof promptSchema>;

const repliesSchema = v.strictObject({
  task: taskSchema,
  relation: v.nullable(v.string()),
  texts: v.array(v.string()),
});
export type Replies = v.InferOutput<typeof repliesSchema>;

/**
 * What the replies of a request mean, counted. Every `of` is the number of replies that could be read. Tasks beyond
 * those of the paper may add members.
 */
const inferenceSchema = v.looseObject({
  seed: v.strictObject({
    /** decided: more than half agree; unclear: most say that the request is; none: no reply could be read. */
    outcome: v.picklist(['decided', 'split', 'unclear', 'none']),
    /** Most votes first, ties by first arrival. Statements as in the seed of `parsel/edit`. */
    readings: v.array(
      v.strictObject({ statements: v.array(v.looseObject({ op: v.string() })), words: v.string(), votes: v.number() }),
    ),
    of: v.number(),
    /** The model's own words, when one said that the request is unclear. */
    reason: v.nullable(v.string()),
  }),
  /** Those kept, by at least 60 % of the votes. */
  hints: v.array(v.strictObject({ part: v.string(), hint: v.string(), votes: v.number(), of: v.number() })),
  /** Every relation asked about; `votes` are those for the answer given. */
  relations: v.array(
    v.strictObject({ relation: v.string(), keep: v.boolean(), votes: v.number(), of: v.number(), words: v.string() }),
  ),
  /** What the tasks that propose requests say; what was dropped, with a clause why. */
  proposals: v.optional(
    v.strictObject({
      requests: v.array(
        v.strictObject({ request: v.string(), changes: v.array(v.string()), keeps: v.array(v.string()) }),
      ),
      dropped: v.array(v.strictObject({ request: v.string(), reason: v.string() })),
    }),
  ),
  /** What the parts are called, counted; `front`: the side of the model that is its front. */
  names: v.optional(
    v.strictObject({
      category: v.string(),
      category_votes: v.number(),
      front: v.picklist(['', '+z', '-z', '+x', '-x']),
      front_votes: v.number(),
      of: v.number(),
      /** By id of a part, or of the virtual part that stands for its instances; `label` is empty where nobody names it. */
      parts: v.array(v.strictObject({ part: v.string(), label: v.string(), votes: v.number() })),
    }),
  ),
  refused: v.array(
    v.strictObject({ task: taskSchema, relation: v.nullable(v.string()), vote: v.number(), error: errorSchema }),
  ),
  /** `parsel/edit` v1; null when the seed has no reading. */
  edit: v.nullable(v.looseObject({ format: v.literal('parsel/edit'), version: v.literal(1) })),
});
export type Inference = v.InferOutput<typeof inferenceSchema>;

/** How far an edit is to go, as it was said: in metres, radians or pieces; `times` as a factor. One of the three. */
const targetSchema = v.strictObject({
  /** null: the whole. */
  part: v.nullable(v.string()),
  what: v.picklist(['width', 'height', 'depth', 'size', 'distance', 'angle', 'count', 'spacing']),
  by: v.optional(v.number()),
  to: v.optional(v.number()),
  times: v.optional(v.number()),
  /** The slider's value as far as the seed alone tells. */
  x: v.number(),
});
export type Target = v.InferOutput<typeof targetSchema>;

/** A request read without a language model. */
const plainSchema = v.strictObject({
  ...inferenceSchema.entries,
  plain: v.strictObject({
    /** Every word was used, and all ways to take them come to one edit. */
    sure: v.boolean(),
    language: v.string(),
    /** Words that were not understood. */
    unused: v.array(v.string()),
    /** Why it is not sure, a clause without a full stop. */
    reason: v.nullable(v.string()),
    /** The whole edit of each of the seed's readings. */
    readings: v.array(
      v.strictObject({
        edit: v.looseObject({ format: v.literal('parsel/edit'), version: v.literal(1) }),
        words: v.string(),
        target: v.nullable(targetSchema),
      }),
    ),
  }),
});
export type PlainInference = v.InferOutput<typeof plainSchema>;

/** How parts are told apart. */
export const splitMethodSchema = v.picklist(['auto', 'components', 'materials', 'regions']);
export type SplitMethod = v.InferOutput<typeof splitMethodSchema>;

/** The methods of the module that the page begins with: the JSON parameters that each takes, and the JSON result that it gives. */
const coreMethods = {
  /** The version of the core. */
  version: { parameters: v.strictObject({}), result: v.strictObject({ version: v.string() }) },
  /** Runs the solver a few times, so that later calls are fast. */
  warm_up: { parameters: v.strictObject({}), result: v.strictObject({}) },
  /** Solves `equation` = 0 for `unknown`: closed-form expressions of the other parameters. */
  solve: {
    parameters: v.strictObject({ equation: v.string(), unknown: v.string() }),
    result: v.strictObject({ solutions: v.array(v.string()) }),
  },
  /**
   * Opens a model: buffers are the file and then its external buffers, in the order of their names in `external`. The
   * shape is `parsel/shape` v1. `labels` take the place of the file's own, by "node:<index>" or
   * "node:<index>/<primitive>"; `corrections` are joints and mirror images, whatever is found: core/shape/corrections.h.
   * Puts the core into a state: see CoreState in client.ts.
   */
  open: {
    parameters: v.strictObject({
      name: v.string(),
      external: v.array(v.string()),
      labels: v.optional(v.record(v.string(), v.string())),
      corrections: v.optional(v.array(v.strictObject({ kind: v.string(), parts: v.array(v.string()) }))),
    }),
    result: v.strictObject({ shape: v.looseObject({ format: v.literal('parsel/shape'), version: v.literal(1) }) }),
  },
  /**
   * The opened model with its parts told apart: one buffer, a GLB in which each is a node of its own. `fine`, from 0 to 1:
   * how small a part may be. `by`: what was done; `before` and `parts`: how many there were and are; `joined`: pieces that
   * were too small to be parts.
   */
  split: {
    parameters: v.strictObject({ by: splitMethodSchema, fine: v.number() }),
    result: v.strictObject({
      by: v.string(),
      before: v.number(),
      parts: v.number(),
      joined: v.number(),
      warnings: v.array(v.strictObject({ place: v.string(), text: v.string() })),
    }),
  },
  /** What each way would tell apart of the opened model, and whether those are more parts than a model may have. */
  split_ways: {
    parameters: v.strictObject({ fine: v.number() }),
    result: v.strictObject({
      before: v.number(),
      ways: v.array(v.strictObject({ by: splitMethodSchema, parts: v.number(), too_many: v.boolean() })),
    }),
  },
  /** Bytes of the core's memory. It never shrinks, so this is its peak as well. */
  memory: { parameters: v.strictObject({}), result: v.strictObject({ bytes: v.number() }) },
  /** `parsel/edit` v1 to a `parsel/program` v1 of one layer, and how it was found. */
  propagate: {
    parameters: v.strictObject({ edit: v.unknown() }),
    result: v.strictObject({ program: v.unknown(), trace: v.unknown() }),
  },
  /** What geometry and labels alone offer of the opened model: seed edits, each with a title. Not propagated. */
  offers: {
    parameters: v.strictObject({}),
    result: v.strictObject({
      offers: v.array(
        v.strictObject({
          title: v.string(),
          edit: v.looseObject({ format: v.literal('parsel/edit'), version: v.literal(1) }),
        }),
      ),
    }),
  },
  /**
   * As propagate, but over the part of the range in which nothing comes apart, and looked at by the independent checker;
   * refused where that leaves no slider.
   */
  propagate_clean: {
    parameters: v.strictObject({ edit: v.unknown() }),
    result: v.strictObject({ program: v.unknown(), trace: v.unknown() }),
  },
  /** A program with the range of a layer (an index) stretched to a value, or as far towards it as everything holds. */
  extend: {
    parameters: v.strictObject({ program: v.unknown(), layer: v.number(), to: v.number() }),
    result: v.strictObject({ program: v.unknown() }),
  },
  /** The opened model with a program applied: one buffer, a GLB; with an animation, or a morph target a slider. */
  apply: {
    parameters: v.strictObject({
      program: v.unknown(),
      values: v.array(v.number()),
      animate: v.optional(v.string()),
      morph: v.optional(v.boolean()),
      /** Parts that the edit has pulled apart are made longer until they meet; not with animate or morph. */
      repair: v.optional(v.boolean()),
      only: v.optional(v.array(v.string())),
    }),
    result: v.strictObject({
      warnings: v.array(v.strictObject({ place: v.string(), text: v.string() })),
      /** With repair: how many gaps there were, what became longer, and what is open still. Metres. */
      gaps: v.optional(
        v.strictObject({
          gaps: v.number(),
          closed: v.array(v.strictObject({ relation: v.string(), part: v.string(), longer: v.number() })),
          left: v.array(
            v.strictObject({ relation: v.string(), parts: v.tuple([v.string(), v.string()]), width: v.number() }),
          ),
        }),
      ),
      /** With morph: what the sliders are called in the file, and how exact they are. */
      sliders: v.optional(
        v.array(
          v.strictObject({
            parameter: v.string(),
            targets: v.array(v.string()),
            linear: v.boolean(),
            error_m: v.number(),
            ends_error_m: v.number(),
          }),
        ),
      ),
      together: v.optional(v.strictObject({ targets: v.array(v.string()), error_m: v.number() })),
    }),
  },
  /**
   * Random settings of a program's sliders, one value a layer, in which they spoil nothing together that each alone keeps;
   * how many were drawn and not taken, and why. The same for the same program and seed.
   */
  siblings: {
    parameters: v.strictObject({ program: v.unknown(), count: v.number(), seed: v.number() }),
    result: v.strictObject({
      siblings: v.array(v.array(v.number())),
      rejected: v.number(),
      reasons: v.array(v.strictObject({ reason: v.string(), count: v.number() })),
    }),
  },
  /** A program with its layers from number `first` on composed anew onto those before them: core/propagate/compose.h. */
  compose: {
    parameters: v.strictObject({ program: v.unknown(), first: v.number() }),
    result: v.strictObject({ program: v.unknown() }),
  },
  /**
   * What the layers of a program keep together of what each keeps alone, sampled over all ranges, and how far each slider
   * may go where the others stand: core/prove/stack.h.
   */
  judge: {
    parameters: v.strictObject({ program: v.unknown() }),
    result: v.strictObject({
      of: v.number(),
      /** Ids of relations. */
      lost: v.array(v.string()),
      settings: v.number(),
      failed: v.number(),
      failure: v.string(),
      stops: v.array(
        v.strictObject({ min: v.number(), max: v.number(), minReason: v.string(), maxReason: v.string() }),
      ),
    }),
  },
  /**
   * What a person sees go wrong over a layer's range, whatever its relations say: parts that touched and come apart, or that
   * run into each other, and at which value first (core/prove/clearance.h).
   */
  seen: {
    parameters: v.strictObject({ program: v.unknown(), layer: v.number() }),
    result: v.strictObject({
      faults: v.array(v.strictObject({ parts: v.tuple([v.string(), v.string()]), apart: v.boolean(), x: v.number() })),
    }),
  },
  /** Every model of the gallery: entries of gallery.json, and one GLB each as buffers. */
  gallery: {
    parameters: v.strictObject({}),
    result: v.strictObject({
      models: v.array(v.looseObject({ id: v.string(), title: v.string(), file: v.string() })),
    }),
  },
  /** Every prompt of a request, and of each task what it asks about and the JSON schema of its reply. `mentioned`: parts
   * pointed at. */
  prompts: {
    parameters: v.strictObject({ request: v.string(), mentioned: v.array(v.string()) }),
    result: v.strictObject({
      prompts: v.array(promptSchema),
      tasks: v.record(
        taskSchema,
        v.strictObject({ words: v.string(), schema: v.looseObject({ type: v.optional(v.string()) }) }),
      ),
    }),
  },
  /**
   * The prompt of a task that is asked on its own. `request` is empty for one about the model alone; `count` 0 is as many as
   * the task says; `picture`: one goes along, with numbers on its parts: number i is `numbered[i - 1]`.
   */
  proposal_prompt: {
    parameters: v.strictObject({
      task: taskSchema,
      request: v.string(),
      mentioned: v.array(v.string()),
      count: v.number(),
      picture: v.boolean(),
    }),
    result: v.strictObject({
      prompt: promptSchema,
      words: v.string(),
      schema: v.looseObject({ type: v.optional(v.string()) }),
      numbered: v.array(v.string()),
    }),
  },
  /** A request read at once, without a language model; `mentioned` as for prompts. */
  read_plainly: {
    parameters: v.strictObject({ request: v.string(), mentioned: v.array(v.string()) }),
    result: plainSchema,
  },
  /** What the model's replies to a request mean. `texts`: one for each vote that arrived. */
  read_replies: {
    parameters: v.strictObject({ request: v.string(), replies: v.array(repliesSchema) }),
    result: inferenceSchema,
  },
  /** Goes wrong on purpose: how the recovery below is tested. */
  fail: {
    parameters: v.strictObject({ kind: v.picklist(['exception', 'abort', 'memory', 'hang']) }),
    result: v.strictObject({}),
  },
} as const;

/** Which method lives in which module. */
export const methodsOf = { core: coreMethods, cad: familyMethods } as const;
export type ModuleName = keyof typeof methodsOf;

/** Every method, in whichever module. */
export const methodSchemas = { ...coreMethods, ...familyMethods } as const;

export type Method = keyof typeof methodSchemas;
export type Parameters<M extends Method> = v.InferInput<(typeof methodSchemas)[M]['parameters']>;
export type MethodResult<M extends Method> = v.InferOutput<(typeof methodSchemas)[M]['result']>;

export interface Progress {
  /** What is being done, for people. */
  step: string;
  done: number;
  total: number;
}

/** Page → worker. `module` is compiled once by the page, so that a respawned worker starts at once. */
export type Request =
  | { kind: 'start'; module: WebAssembly.Module }
  | { kind: 'call'; id: number; method: Method; parameters: unknown; buffers: Uint8Array[] };

/** Worker → page. After `crashed` the worker's memory cannot be trusted: the page discards the worker. */
export type Response =
  | { kind: 'ready'; startMilliseconds: number }
  | ({ kind: 'progress'; id: number } & Progress)
  | { kind: 'reply'; id: number; json: string; buffers: Uint8Array[] }
  | { kind: 'crashed'; text: string };
