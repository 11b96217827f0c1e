// What the session asks of the core, and the core that answers. The core keeps one model; when it holds another than the
// one that is asked about (after undo, say), it opens that one first.
import type { Program, Shape } from '../program/types';
import type { ModelFiles } from '../scene/load';
import type { CallOptions, CoreClient } from '../worker/client';
import type { Inference, MethodResult, Replies } from '../worker/protocol';
import { type EditInput, type Labels, noLabels, type OpenModel } from './document';
import type { Trace } from './trace';

export interface Exported {
  readonly glb: Uint8Array;
  /** What could not be carried over, in sentences. */
  readonly warnings: readonly string[];
}

export interface ExportOptions {
  /** Name of the parameter that a glTF animation plays over its range. */
  readonly animate?: string;
  /** Ids of the parts to keep; all when absent. */
  readonly only?: readonly string[];
}

export interface Propagation {
  /** One layer. */
  readonly program: Program;
  readonly trace?: Trace;
}

type Options = Pick<CallOptions, 'signal' | 'onProgress'>;

export interface ModelCore {
  /** Reads and abstracts a model, with labels that take the place of the file's own. */
  open(files: ModelFiles, options: Options, labels?: Labels): Promise<Shape>;
  /** One layer, from a seed edit. */
  propagate(model: OpenModel, edit: EditInput, options: Options): Promise<Propagation>;
  /** The model's file with the program applied. */
  apply(model: OpenModel, program: Program, options: ExportOptions): Promise<Exported>;
  /** What a language model is to be asked. `mentioned`: ids of parts that were pointed at. */
  prompts(model: OpenModel, request: string, mentioned: readonly string[]): Promise<MethodResult<'prompts'>>;
  /** What its replies mean. */
  readReplies(model: OpenModel, request: string, replies: Replies[]): Promise<Inference>;
}

/** @param onLost the core has lost its model, which is opened again when it is next asked about */
export function modelCore(client: CoreClient, onLost: () => void): ModelCore {
  let opened: Pick<OpenModel, 'files' | 'labels'> | null = null;
  client.onStateLost = () => {
    opened = null;
    onLost();
  };
  const open = async (files: ModelFiles, options: Options, labels = noLabels): Promise<Shape> => {
    const external = [...files.external.keys()];
    const buffers = [files.main, ...files.external.values()];
    const { result } = await client.call(
      'open',
      { name: files.name, external, ...(labels.size > 0 ? { labels: Object.fromEntries(labels) } : {}) },
      { ...options, buffers, state: 'model' },
    );
    opened = { files, labels };
    return result.shape as unknown as Shape;
  };
  const hold = async ({ files, labels }: OpenModel, options: Options) => {
    if (opened?.files !== files || opened.labels !== labels) await open(files, options, labels);
  };
  return {
    open,
    async propagate(model, edit, options) {
      await hold(model, options);
      const { result } = await client.call('propagate', { edit }, options);
      return result as Propagation;
    },
    async prompts(model, request, mentioned) {
      await hold(model, {});
      return (await client.call('prompts', { request, mentioned: [...mentioned] })).result;
    },
    async readReplies(model, request, replies) {
      await hold(model, {});
      return (await client.call('read_replies', { request, replies })).result;
    },
    async apply(model, program, { animate, only }) {
      await hold(model, {});
      const parameters = {
        program,
        values: program.layers.map(({ parameter }) => parameter.value),
        ...(animate === undefined ? {} : { animate }),
        ...(only === undefined ? {} : { only: [...only] }),
      };
      const { result, buffers } = await client.call('apply', parameters);
      const [glb] = buffers;
      if (glb === undefined) throw new Error('The core gave no file.');
      return { glb, warnings: result.warnings.map(({ place, text }) => [place, text].filter(Boolean).join(': ')) };
    },
  };
}
