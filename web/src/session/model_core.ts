// What the session asks of the core, and the core that answers. The core keeps one model; whichever a call is about (after
// undo, say, or in a new worker) is its state.

import type { Program, Shape } from '../program/types';
import type { ModelFiles } from '../scene/load';
import { t } from '../texts/texts';
import type { CallOptions, Calls, CoreState } from '../worker/client';
import type { Inference, MethodResult, Parameters, PlainInference, Replies } from '../worker/protocol';
import { type Corrections, type EditInput, type Labels, noCorrections, noLabels, type OpenModel } from './document';
import type { Trace } from './trace';

export interface Exported {
  readonly glb: Uint8Array;
  /** What could not be carried over, in sentences. */
  readonly warnings: readonly string[];
  /** Of a repair. */
  readonly gaps?: MethodResult<'apply'>['gaps'];
}

export interface ExportOptions {
  /** Name of the parameter that a glTF animation plays over its range. */
  readonly animate?: string;
  /** Ids of the parts to keep; all when absent. */
  readonly only?: readonly string[];
  /** Whether what the edit has pulled apart is closed (core/export/close_gaps.h). */
  readonly repair?: boolean;
}

export interface Propagation {
  /** One layer. */
  readonly program: Program;
  readonly trace?: Trace;
}

export interface SplitFiles {
  readonly files: ModelFiles;
  /** Real parts before and after. */
  readonly before: number;
  readonly parts: number;
  readonly remarks: readonly string[];
}

type Options = Pick<CallOptions, 'signal' | 'onProgress'>;

export interface ModelCore {
  /** Reads and abstracts a model, with labels that take the place of the file's own, and corrections of what is found. */
  open(files: ModelFiles, options: Options, labels?: Labels, corrections?: Corrections): Promise<Shape>;
  /** The files with their parts told apart, and what was left whole, in sentences. */
  split(files: ModelFiles, how: Parameters<'split'>, options: Options): Promise<SplitFiles>;
  /** What each way would tell apart, without doing it. */
  splitWays(files: ModelFiles, fine: number, options: Options): Promise<MethodResult<'split_ways'>>;
  /** One layer, from a seed edit. */
  propagate(model: OpenModel, edit: EditInput, options: Options): Promise<Propagation>;
  /** The same over the part of the range where nothing comes apart; refused where that is not worth a slider. */
  propagateClean(model: OpenModel, edit: EditInput, options: Options): Promise<Propagation>;
  /** What geometry and labels alone offer of the model; not yet known to be clean. */
  offers(model: OpenModel): Promise<MethodResult<'offers'>['offers']>;
  /** The program with a layer's range stretched to `to`, or as far towards it as everything holds. */
  extend(model: OpenModel, program: Program, layer: number, to: number): Promise<Program>;
  /** The program with its layers from number `first` on composed onto those before them. */
  compose(model: OpenModel, program: Program, first: number): Promise<Program>;
  /** What the layers keep together of what each keeps alone, and how far each slider may go now. */
  judge(model: OpenModel, program: Program): Promise<MethodResult<'judge'>>;
  /** What a person sees go wrong over the range of a layer. */
  seen(model: OpenModel, program: Program, layer: number): Promise<MethodResult<'seen'>['faults']>;
  /** The model's file with the program applied. */
  apply(model: OpenModel, program: Program, options: ExportOptions): Promise<Exported>;
  /** What a request means, read without a language model. `mentioned` as below. */
  readPlainly(model: OpenModel, request: string, mentioned: readonly string[]): Promise<PlainInference>;
  /** What a language model is to be asked. `mentioned`: ids of parts that were pointed at. */
  prompts(model: OpenModel, request: string, mentioned: readonly string[]): Promise<MethodResult<'prompts'>>;
  /** What a language model is asked for proposals; see `proposal_prompt` in protocol.ts. */
  proposalPrompt(model: OpenModel, about: Parameters<'proposal_prompt'>): Promise<MethodResult<'proposal_prompt'>>;
  /** Random settings of a program's sliders that are sound together; the same for the same seed. */
  siblings(
    model: OpenModel,
    program: Program,
    count: number,
    seed: number,
    options: Options,
  ): Promise<MethodResult<'siblings'>>;
  /** An OpenSCAD text as parts, and the GLB that they make. */
  readCad(
    name: string,
    text: Uint8Array,
    options: Options,
  ): Promise<{ read: MethodResult<'open_cad'>; glb: Uint8Array }>;
  /** What the variations of a CAD program share; and a GLB of each. */
  findFamily(
    about: Parameters<'find_family'>,
    options: Options,
  ): Promise<{ found: MethodResult<'find_family'>; pictures: readonly Uint8Array[] }>;
  /** A family as an OpenSCAD program. */
  familyText(about: Parameters<'family_text'>): Promise<MethodResult<'family_text'>>;
  /** What a language model is asked about a CAD program, and what its replies mean. */
  cadPrompt(about: Parameters<'cad_prompt'>): Promise<MethodResult<'cad_prompt'>>;
  readCadReplies(about: Parameters<'read_cad_replies'>): Promise<MethodResult<'read_cad_replies'>>;
  /** What its replies mean. */
  readReplies(model: OpenModel, request: string, replies: Replies[]): Promise<Inference>;
}

/** The model that calls are about is told to the core with each of them; the client sees to it that it is only told anew. */
export function modelCore(client: Calls): ModelCore {
  const states = new WeakMap<ModelFiles, Map<string, CoreState<'open'>>>();
  const stateOf = ({
    files,
    labels,
    corrections = noCorrections,
  }: Pick<OpenModel, 'files' | 'labels' | 'corrections'>): CoreState<'open'> => {
    const known = states.get(files) ?? new Map<string, CoreState<'open'>>();
    states.set(files, known);
    const key = JSON.stringify([[...labels], corrections]);
    const state: CoreState<'open'> = known.get(key) ?? {
      method: 'open',
      parameters: {
        name: files.name,
        external: [...files.external.keys()],
        ...(labels.size > 0 ? { labels: Object.fromEntries(labels) } : {}),
        ...(corrections.length > 0
          ? { corrections: corrections.map(({ kind, parts }) => ({ kind, parts: [...parts] })) }
          : {}),
      },
      buffers: [files.main, ...files.external.values()],
    };
    known.set(key, state);
    return state;
  };
  return {
    async open(files, options, labels = noLabels, corrections = noCorrections) {
      const { result } = await client.setUp(stateOf({ files, labels, corrections }), options);
      return result.shape as unknown as Shape;
    },
    async split(files, how, options) {
      const { result, buffers } = await client.call('split', how, {
        ...options,
        needs: stateOf({ files, labels: noLabels }),
      });
      const [main] = buffers;
      if (main === undefined) throw new Error(t`The core gave no file.`);
      const { converted, decompressed } = files;
      return {
        files: {
          name: files.name,
          main,
          external: new Map(),
          ...(converted ? { converted } : {}),
          ...(decompressed ? { decompressed } : {}),
          split: { from: files, ...how },
        },
        before: result.before,
        parts: result.parts,
        remarks: result.warnings.map(({ place, text }) => `${place}: ${text}`),
      };
    },
    async splitWays(files, fine, options) {
      const needs = stateOf({ files, labels: noLabels });
      return (await client.call('split_ways', { fine }, { ...options, needs })).result;
    },
    async propagate(model, edit, options) {
      const { result } = await client.call('propagate', { edit }, { ...options, needs: stateOf(model) });
      return result as Propagation;
    },
    async propagateClean(model, edit, options) {
      const { result } = await client.call('propagate_clean', { edit }, { ...options, needs: stateOf(model) });
      return result as Propagation;
    },
    async offers(model) {
      return (await client.call('offers', {}, { needs: stateOf(model) })).result.offers;
    },
    async extend(model, program, layer, to) {
      const { result } = await client.call('extend', { program, layer, to }, { needs: stateOf(model) });
      return result.program as Program;
    },
    async compose(model, program, first) {
      const { result } = await client.call('compose', { program, first }, { needs: stateOf(model) });
      return result.program as Program;
    },
    async judge(model, program) {
      return (await client.call('judge', { program }, { needs: stateOf(model) })).result;
    },
    async seen(model, program, layer) {
      return (await client.call('seen', { program, layer }, { needs: stateOf(model) })).result.faults;
    },
    async readPlainly(model, request, mentioned) {
      const needs = stateOf(model);
      return (await client.call('read_plainly', { request, mentioned: [...mentioned] }, { needs })).result;
    },
    async prompts(model, request, mentioned) {
      const needs = stateOf(model);
      return (await client.call('prompts', { request, mentioned: [...mentioned] }, { needs })).result;
    },
    async proposalPrompt(model, about) {
      return (await client.call('proposal_prompt', about, { needs: stateOf(model) })).result;
    },
    async siblings(model, program, count, seed, options) {
      const needs = stateOf(model);
      return (await client.call('siblings', { program, count, seed }, { ...options, needs })).result;
    },
    async readCad(name, text, options) {
      const { result, buffers } = await client.call('open_cad', { name }, { ...options, buffers: [text] });
      const [glb] = buffers;
      if (glb === undefined) throw new Error(t`The core gave no file.`);
      return { read: result, glb };
    },
    async findFamily(about, options) {
      const { result, buffers } = await client.call('find_family', about, options);
      return { found: result, pictures: buffers };
    },
    async familyText(about) {
      return (await client.call('family_text', about)).result;
    },
    async cadPrompt(about) {
      return (await client.call('cad_prompt', about)).result;
    },
    async readCadReplies(about) {
      return (await client.call('read_cad_replies', about)).result;
    },
    async readReplies(model, request, replies) {
      return (await client.call('read_replies', { request, replies }, { needs: stateOf(model) })).result;
    },
    async apply(model, program, { animate, only, repair = false }) {
      const parameters = {
        program,
        values: program.layers.map(({ parameter }) => parameter.value),
        ...(animate === undefined ? {} : { animate }),
        ...(only === undefined ? {} : { only: [...only] }),
        ...(repair ? { repair } : {}),
      };
      const { result, buffers } = await client.call('apply', parameters, { needs: stateOf(model) });
      const [glb] = buffers;
      if (glb === undefined) throw new Error(t`The core gave no file.`);
      return {
        glb,
        warnings: result.warnings.map(({ place, text }) => [place, text].filter(Boolean).join(': ')),
        ...(result.gaps === undefined ? {} : { gaps: result.gaps }),
      };
    },
  };
}
