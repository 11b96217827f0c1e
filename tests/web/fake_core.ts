// A core that answers what a test tells it, and a model of two boxes for it.
import type { Program, Shape } from '../../web/src/program/types';
import { type EditInput, noLabels, type OpenModel } from '../../web/src/session/document';
import type { ModelCore } from '../../web/src/session/model_core';
import type { Inference, PlainInference, Target } from '../../web/src/worker/protocol';
import { twoBoxes } from './box_shapes';

export function openModel(name: string, shape: Shape = twoBoxes): OpenModel {
  const files = { name, main: new Uint8Array([1]), external: new Map<string, Uint8Array>() };
  return { files, source: { kind: 'file' }, shape: { ...shape, name }, labels: noLabels };
}

/** A program of one layer that moves a part. */
export const moving = (part: string, range = 0.35): Program => ({
  format: 'parsel/program',
  version: 1,
  shape: { name: '', sha256: '' },
  layers: [
    {
      request: '',
      parameter: { name: 'x', min: -range, max: range, value: 0 },
      statements: [{ op: 'translate', part, feature: [0, 0, 0], amount: 'x', direction: [0, 1, 0] }],
      relations: [],
    },
  ],
});

export const edit = (part: string): EditInput => ({
  seed: moving(part).layers[0]?.statements ?? [],
  disabled: [],
  hints: {},
});

/** What a language model is understood to mean: to move a part. */
export const understood = (part: string): Inference => ({
  seed: {
    outcome: 'decided',
    readings: ['left', 'right'].map((other) => ({
      statements: edit(other).seed as unknown as Inference['seed']['readings'][number]['statements'],
      words: `move ${other}`,
      votes: other === part ? 2 : 1,
    })),
    of: 3,
    reason: null,
  },
  hints: [],
  relations: [],
  refused: [],
  edit: { format: 'parsel/edit', version: 1, ...edit(part) },
});

export interface FakeCore extends ModelCore {
  /** Of every propagation, the part whose move was asked for. */
  readonly asked: string[];
  /** What propagation does; by default it moves the part of the seed. */
  answer: (edit: EditInput, signal: AbortSignal) => Promise<Program>;
  inference: Inference;
  /** What is read without a language model; by default it is not understood. */
  plain: PlainInference;
}

/** What a request is read as without a language model: to move the parts, the first of them unless it is not sure. */
export function readPlainly(parts: readonly string[], sure: boolean, target: Target | null = null): PlainInference {
  const readings = parts.map((part) => ({
    edit: { format: 'parsel/edit' as const, version: 1 as const, ...edit(part) },
    words: `move ${part}`,
    target,
  }));
  const [first] = readings;
  return {
    ...understood(parts[0] ?? 'left'),
    seed: {
      outcome: sure ? 'decided' : first ? 'split' : 'unclear',
      readings: readings.map(({ words, edit: { seed } }) => ({
        statements: seed as unknown as Inference['seed']['readings'][number]['statements'],
        words,
        votes: sure ? 1 : 0,
      })),
      of: 1,
      reason: first ? null : 'it says nothing',
    },
    edit: first?.edit ?? null,
    plain: { sure, language: 'en', unused: sure ? [] : ['nicer'], reason: sure ? null : 'it is not clear', readings },
  };
}

export function fakeCore(): FakeCore {
  const partOf = ({ seed }: EditInput) => (seed[0] as { part: string }).part;
  const core: FakeCore = {
    asked: [],
    answer: async (asked) => moving(partOf(asked)),
    inference: understood('left'),
    plain: readPlainly([], false),
    open: () => Promise.reject(new Error('not here')),
    split: () => Promise.reject(new Error('not here')),
    splitWays: () => Promise.reject(new Error('not here')),
    apply: () => Promise.reject(new Error('not here')),
    async propagate(_, asked, { signal }) {
      core.asked.push(partOf(asked));
      const program = await core.answer(asked, signal ?? new AbortController().signal);
      signal?.throwIfAborted();
      return { program };
    },
    prompts: async () => ({
      prompts: [{ task: 'seed_edit', relation: null, text: 'p', hash: 'h', version: '1' }],
      tasks: { seed_edit: { words: 'the edit', schema: {} } },
    }),
    cadPrompt: async ({ task, kind }) => ({
      prompt: { task, text: 'ask', hash: `${task} ${kind}`, version: '1' },
      words: 'kinds',
      schema: {},
    }),
    readCadReplies: async () => ({ refused: [] }),
    proposalPrompt: async (_, { task }) => ({
      prompt: { task, relation: null, text: 'propose', hash: task, version: '1' },
      words: 'sliders',
      schema: {},
      numbered: ['left', 'right'],
    }),
    propagateClean: (model, asked, options) => core.propagate(model, asked, options),
    offers: async () => [],
    extend: async (_, program) => program,
    compose: async (_, program) => program,
    judge: async () => ({ of: 0, lost: [], settings: 0, failed: 0, failure: '', stops: [] }),
    seen: async () => [],
    siblings: async () => ({ siblings: [], rejected: 0, reasons: [] }),
    readCad: () => Promise.reject(new Error('not here')),
    findFamily: () => Promise.reject(new Error('not here')),
    familyText: () => Promise.reject(new Error('not here')),
    readPlainly: async () => core.plain,
    readReplies: async () => core.inference,
  };
  return core;
}
