// What the page and the core say to each other. The core's side is wasm/methods.cpp; tests/web/protocol.test.ts fails
// when the two differ.
import * as v from 'valibot';

/** Why something was refused: where it happened, where in the input, what is wrong and what to do about it. */
export const errorSchema = v.strictObject({ stage: v.string(), place: v.string(), cause: v.string(), fix: v.string() });
export type CoreErrorValue = v.InferOutput<typeof errorSchema>;

/** Every method of the core: the JSON parameters that it takes and the JSON result that it gives. */
export const methodSchemas = {
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
   * "node:<index>/<primitive>". Sets the core's state: call it with a `state` of its own.
   */
  open: {
    parameters: v.strictObject({
      name: v.string(),
      external: v.array(v.string()),
      labels: v.optional(v.record(v.string(), v.string())),
    }),
    result: v.strictObject({ shape: v.looseObject({ format: v.literal('parsel/shape'), version: v.literal(1) }) }),
  },
  /** Bytes of the core's memory. It never shrinks, so this is its peak as well. */
  memory: { parameters: v.strictObject({}), result: v.strictObject({ bytes: v.number() }) },
  /** `parsel/edit` v1 to a `parsel/program` v1 of one layer, and how it was found. */
  propagate: {
    parameters: v.strictObject({ edit: v.unknown() }),
    result: v.strictObject({ program: v.unknown(), trace: v.unknown() }),
  },
  /** The opened model with a program applied: one buffer, a GLB. */
  apply: {
    parameters: v.strictObject({
      program: v.unknown(),
      values: v.array(v.number()),
      animate: v.optional(v.string()),
      only: v.optional(v.array(v.string())),
    }),
    result: v.strictObject({ warnings: v.array(v.strictObject({ place: v.string(), text: v.string() })) }),
  },
  /** Every model of the gallery: entries of gallery.json, and one GLB each as buffers. */
  gallery: {
    parameters: v.strictObject({}),
    result: v.strictObject({
      models: v.array(v.looseObject({ id: v.string(), title: v.string(), file: v.string() })),
    }),
  },
  /** Goes wrong on purpose: how the recovery below is tested. */
  fail: {
    parameters: v.strictObject({ kind: v.picklist(['exception', 'abort', 'memory', 'hang']) }),
    result: v.strictObject({}),
  },
} as const;

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
