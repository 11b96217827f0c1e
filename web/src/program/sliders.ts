// `parsel/sliders` v1: a program with the hexahedra and groups that it is evaluated on, so that it runs where there is no
// core. It lies beside a model as a file of its own, or inside it (embedded.ts).
import * as v from 'valibot';
import { type CheckedProgram, checkProgram, readProgram } from './check';
import { type Format, readFormat } from './gate';
import { limits } from './schema';
import { cageShapeOf, checkShape } from './shape_check';
import type { CageShape, Layer, Program, ProgramError, Result } from './types';

const format: Format = { stage: 'program/sliders', what: 'file of sliders', name: 'parsel/sliders' };

/** What the page that wrote it knows besides: names, labels, the view. Kept as it is, for the page to check. */
export type Extras = Readonly<Record<string, unknown>>;

export interface Sliders {
  readonly format: 'parsel/sliders';
  readonly version: 1;
  /** Every layer of the work, with the values at which the sliders stood. */
  readonly program: Program;
  /** Indices of the layers that are switched off, or do not fit the shape. They move nothing and need not fit. */
  readonly off: readonly number[];
  /** What evaluation needs of the shape. */
  readonly shape: CageShape;
  /** Ids of the parts that are not shown. */
  readonly hidden: readonly string[];
  readonly session?: Extras;
}

/** Sliders that have passed readSliders(). */
export interface ReadSliders {
  readonly sliders: Sliders;
  /** The layers that are on. */
  readonly checked: CheckedProgram;
}

const id = v.pipe(v.string(), v.minLength(1), v.maxBytes(limits.nameLength));
const slidersSchema = v.strictObject({
  format: v.literal('parsel/sliders'),
  version: v.literal(1),
  program: v.unknown(),
  off: v.optional(v.pipe(v.array(v.pipe(v.number(), v.integer(), v.minValue(0))), v.maxLength(limits.layers)), []),
  shape: v.unknown(),
  hidden: v.optional(v.array(id), []),
  session: v.exactOptional(v.record(v.string(), v.unknown())),
});

/** The layers that are on. */
export function layersOn({ program, off }: Pick<Sliders, 'program' | 'off'>): readonly Layer[] {
  return program.layers.filter((_, i) => !off.includes(i));
}

/** Checks untrusted JSON: the program's structure, the shape, and that the layers that are on fit it. */
export function readSliders(json: unknown): Result<ReadSliders> {
  const read = readFormat(json, slidersSchema, format);
  if (!read.ok) return read;
  const shape = within('/shape', checkShape(read.value.shape));
  if (!shape.ok) return shape;
  const program = within('/program', readProgram(read.value.program));
  if (!program.ok) return program;
  const { format: name, version, off, hidden, session } = read.value;
  const sliders: Sliders = {
    format: name,
    version,
    program: program.value,
    off,
    shape: shape.value,
    hidden,
    ...(session === undefined ? {} : { session }),
  };
  const checked = within('/program', checkProgram({ ...program.value, layers: layersOn(sliders) }, shape.value));
  return checked.ok ? { ok: true, value: { sliders, checked: checked.value } } : checked;
}

export function slidersOf(
  program: Program,
  shape: CageShape,
  rest: Partial<Pick<Sliders, 'off' | 'hidden' | 'session'>> = {},
): Sliders {
  const { off = [], hidden = [], session } = rest;
  const own = { format: 'parsel/sliders', version: 1 } as const;
  return { ...own, program, off, shape: cageShapeOf(shape), hidden, ...(session === undefined ? {} : { session }) };
}

/** A refusal of something that lies deeper in this file. */
function within<T>(place: string, result: Result<T>): Result<T> {
  return result.ok ? result : { ok: false, error: { ...result.error, place: place + result.error.place } };
}

/** Coordinates of two readings of one model may differ by this, normalised: other tools rewrite files, some in 16 bits. */
const fitSlack = 1e-3;

/** Why sliders made on one shape do not belong to another, which was found in a file; null when they do. */
export function misfitOf(made: CageShape, found: CageShape): ProgramError | null {
  const refusal = (place: string, cause: string): ProgramError => ({
    stage: 'program/sliders',
    place,
    cause,
    fix: 'use the sliders with the model that they were made on, or make them anew',
  });
  const near = (a: readonly number[], b: readonly number[]) =>
    a.every((x, i) => Math.abs(x - (b[i] ?? Number.NaN)) <= fitSlack);
  const { scale } = found.frame;
  const off = made.frame.centre.map((x, i) => (x - (found.frame.centre[i] ?? Number.NaN)) / scale);
  if (!near([made.frame.scale / scale], [1]) || !near(off, [0, 0, 0])) {
    return refusal('/shape/frame', 'the model has another size or stands elsewhere');
  }
  const parts = new Map(found.parts.map((part) => [part.id, part]));
  for (const [i, part] of made.parts.entries()) {
    const other = parts.get(part.id);
    const place = `/shape/parts/${i}`;
    if (other === undefined || other.virtual !== part.virtual || other.primitive !== part.primitive) {
      return refusal(place, `the model has no part ${JSON.stringify(part.id)}`);
    }
    if (part.node !== other.node) return refusal(place, `${JSON.stringify(part.id)} is another node of the model`);
    if (!part.corners.every((corner, k) => near(corner, other.corners[k] ?? []))) {
      return refusal(place, `${JSON.stringify(part.id)} has another place or size in the model`);
    }
  }
  return null;
}
