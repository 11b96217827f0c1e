// Programs read and compiled: `parsel/program` and `parsel/sliders` in, a function from slider values to corners out.
import { checkProgram, readProgram } from '../../src/program/check';
import { compileProgram, type GroupView } from '../../src/program/compile';
import { parseJson } from '../../src/program/json';
import { checkShape } from '../../src/program/shape_check';
import { type ReadSliders, readSliders } from '../../src/program/sliders';
import type { CageShape, Program } from '../../src/program/types';
import { ParselError, unwrap } from './error';
import { indexOf, type SliderParameter, valueFor } from './values';

export interface LoadedProgram {
  /** The layers that are on, in order. */
  readonly program: Program;
  /** Hexahedra and groups to evaluate it on; null when the file holds the program alone (`parsel/program`). */
  readonly shape: CageShape | null;
  /** One a layer. */
  readonly parameters: readonly SliderParameter[];
  /** Ids of parts that are not to be shown. */
  readonly hidden: readonly string[];
}

/** Slider values by the parameter's name, or in the order of `parameters`. What is not given is as it was loaded. */
export type Values = Readonly<Record<string, number>> | readonly number[] | Float64Array;

export interface Evaluate {
  /**
   * Corners of every part at slider values, part × 24: corner k of a part has local signs (k&1, k&2, k&4) → ±1 along the
   * part's axes 0, 1, 2. In the normalised frame: model = frame.centre + frame.scale · corner. Always the same array.
   * Values beyond a slider's range count as its end; ParselError for unknown names and what is not a finite number.
   */
  (values?: Values): Float64Array;
  readonly shape: CageShape;
  readonly parameters: readonly SliderParameter[];
  /** By relation index, after a call; null for relations that are no group. See GroupView. */
  readonly groups: readonly (GroupView | null)[];
  /** Indices of the parts that the program can move. */
  readonly movingParts: readonly number[];
}

const refusal = (stage: string, place: string, cause: string, fix: string) =>
  new ParselError({ stage: `runtime/${stage}`, place, cause, fix });

/**
 * Reads untrusted JSON, as text or parsed: `parsel/sliders` v1, or `parsel/program` v1 for a shape that compile() is given.
 * Throws a ParselError for everything else.
 */
export function loadProgram(json: unknown): LoadedProgram {
  const value = typeof json === 'string' ? unwrap(parseJson(json)) : json;
  const format = typeof value === 'object' && value !== null ? (value as { format?: unknown }).format : undefined;
  if (format === 'parsel/session') {
    throw refusal(
      'load',
      '/format',
      'a session holds no hexahedra to evaluate it on',
      'open it in the page and export “Sliders” or “Model with sliders”',
    );
  }
  if (format !== 'parsel/sliders') return loaded(unwrap(readProgram(value)), null, []);
  return ofSliders(unwrap(readSliders(value)));
}

export function ofSliders({ sliders, checked }: ReadSliders): LoadedProgram {
  return loaded(checked.program, sliders.shape, sliders.hidden);
}

function loaded(program: Program, shape: CageShape | null, hidden: readonly string[]): LoadedProgram {
  const parameters = program.layers.map(({ request, parameter }) => ({ ...parameter, request }));
  return { program, shape, parameters, hidden };
}

/**
 * A program as a function, through closures built once: no `eval`, no solver, nothing allocated at a step unless a group
 * outgrows its buffer.
 * @param shape `parsel/shape` v1 as `parsel inspect` writes it, or what a LoadedProgram holds; its own when left out
 */
export function compile(program: LoadedProgram, shape: unknown = program.shape): Evaluate {
  if (shape === null || shape === undefined) {
    throw refusal(
      'compile',
      '',
      'this program comes without the shape that it is evaluated on',
      'give the output of `parsel inspect MODEL.glb` as the second argument, or load a "parsel/sliders" file',
    );
  }
  const cages = unwrap(checkShape(shape));
  const evaluator = compileProgram(unwrap(checkProgram(program.program, cages)), cages);
  const { parameters } = program;
  const now = new Float64Array(parameters.length);

  function evaluate(values: Values = []): Float64Array {
    for (let i = 0; i < now.length; i++) now[i] = (parameters[i] as SliderParameter).value;
    if (Array.isArray(values) || ArrayBuffer.isView(values)) {
      const list = values as ArrayLike<number>;
      if (list.length > parameters.length) {
        throw refusal('values', '', `${list.length} values for ${parameters.length} sliders`, 'give one a slider');
      }
      for (let i = 0; i < list.length; i++) now[i] = valueFor(parameters[i] as SliderParameter, list[i]);
    } else {
      for (const [name, value] of Object.entries(values)) {
        const i = indexOf(name, parameters);
        now[i] = valueFor(parameters[i] as SliderParameter, value);
      }
    }
    evaluator.evaluate(now);
    return evaluator.corners;
  }
  evaluate();
  const { groups, movingParts } = evaluator;
  return Object.assign(evaluate, { shape: cages, parameters, groups, movingParts });
}
