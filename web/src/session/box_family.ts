// The family of any model whose parts are boxes along the axes, as hexahedra are at rest or after an edit: what the core
// takes for a CAD program (`parsel/cad`), and a state of all sliders as a variation of it (`parsel/variations`). Lengths are
// in metres, in the file's own frame. What is asked of the core is no other than for a program.
import * as v from 'valibot';
import type { Shape } from '../program/types';
import type { CadSource } from '../scene/load';
import { t } from '../texts/texts';
import { type Boxes, type Instance, rounded } from './box_rounding';
import { partKey } from './document';
import type { FoundFamily, Variations } from './family_found';

/** [lowest, highest] along x, y and z. */
export type Bounds = readonly (readonly [number, number])[];
export type BoundsRead =
  | { readonly ok: true; readonly bounds: ReadonlyMap<string, Bounds> }
  | { readonly ok: false; readonly text: string };

/** Corners this far off their box, in half-diagonals of the model, are turned or slanted. */
const slack = 1e-5;

/** The box along the axes whose corners eight corners are, and which of these are its high ones; null when they are none's. */
function boundsOf(corners: ArrayLike<number>, from: number): { bounds: Bounds; places: string } | null {
  const bounds: [number, number][] = [];
  let places = '';
  for (let axis = 0; axis < 3; axis++) {
    const along = Array.from({ length: 8 }, (_, k) => corners[from + 3 * k + axis] as number);
    const [low, high] = [Math.min(...along), Math.max(...along)];
    const isHigh = along.map((value) => high - value < value - low);
    const isOff = along.some((value, k) => (isHigh[k] ? high - value : value - low) > slack);
    if (isOff || !(high > low) || isHigh.filter(Boolean).length !== 4) return null;
    bounds.push([low, high]);
    places += isHigh.map(Number).join('');
  }
  return { bounds, places };
}

/**
 * The boxes of all real parts, by partKey(); refused with a sentence that names the first part that is none, or lies otherwise
 * than at rest.
 * @param corners of every part, part × 24 in the shape's order, in its frame
 * @param nameOf by id
 */
export function boxesOf(shape: Shape, corners: ArrayLike<number>, nameOf: (id: string) => string): BoundsRead {
  const { centre, scale } = shape.frame;
  const bounds = new Map<string, Bounds>();
  for (const [i, part] of shape.parts.entries()) {
    if (part.virtual) continue;
    const own = boundsOf(corners, 24 * i);
    const rest = boundsOf(part.corners.flat(), 0);
    // What is turned by a quarter is a box as well, but no other size of what it was.
    if (own === null || own.places !== rest?.places) {
      return {
        ok: false,
        text: t`A variation is made of boxes along the axes: “${nameOf(part.id)}” is turned or slanted.`,
      };
    }
    const inFile = (value: number, axis: number) => Number((centre[axis] as number) + scale * value).toPrecision(12);
    bounds.set(
      partKey(part),
      own.bounds.map(([low, high], axis) => [Number(inFile(low, axis)), Number(inFile(high, axis))] as const),
    );
  }
  return { ok: true, bounds };
}

/** A model at rest as the program of a family; refused with a sentence. */
export function boxProgram(
  shape: Shape,
  nameOf: (id: string) => string,
): { readonly ok: true; readonly base: CadSource } | Extract<BoundsRead, { ok: false }> {
  const rest = shape.parts.flatMap(({ corners }) => corners.flat());
  const read = boxesOf(shape, rest, nameOf);
  if (!read.ok) return read;
  const real = shape.parts.filter(({ virtual }) => !virtual);
  const parts = real.map((part) => {
    const bounds = read.bounds.get(partKey(part)) ?? [];
    return {
      id: partKey(part),
      label: part.label,
      name: nameOf(part.id),
      kind: 'box',
      centre: bounds.map(([low, high]) => (low + high) / 2),
      size: bounds.map(([low, high]) => high - low),
      role: 'add',
    };
  });
  return {
    ok: true,
    base: {
      program: { format: 'parsel/cad', version: 1, name: shape.name, unit: 'm', parts },
      variations: null,
      parts: parts.map(({ id, name, label }) => ({ id, name, stem: label, role: 'add' })),
      remarks: [],
      of: 'hexahedra',
    },
  };
}

const pair = v.tuple([v.number(), v.number()]);
const programSchema = v.looseObject({
  parts: v.array(v.looseObject({ id: v.string(), centre: v.array(v.number()), size: v.array(v.number()) })),
});
const variationsSchema = v.looseObject({
  variations: v.array(
    v.looseObject({
      bounds: v.optional(v.record(v.string(), v.tuple([pair, pair, pair])), {}),
      values: v.optional(v.record(v.string(), v.number()), {}),
      absent: v.optional(v.array(v.string()), []),
    }),
  ),
});

/** What the core is asked about. */
export interface Asked {
  readonly cad: unknown;
  readonly variations: Variations;
}

/**
 * A program and its variations as the core is asked about them: those of boxes with what is one in all of them within a
 * tolerance made equal (box_rounding.ts). What is not understood stays as it is: the core says what is wrong with it.
 * @param scale the half-diagonal of the model, in metres
 */
export function askedOf(base: CadSource, variations: Variations, scale: number): Asked {
  const asked = { cad: base.program, variations };
  const program = v.safeParse(programSchema, base.program);
  const list = v.safeParse(variationsSchema, variations);
  if (base.of !== 'hexahedra' || !program.success || !list.success) return asked;
  const { parts } = program.output;
  const own = (centre: readonly number[], size: readonly number[]): Boxes[number] =>
    [0, 1, 2].map((k) => [(centre[k] ?? 0) - (size[k] ?? 0) / 2, (centre[k] ?? 0) + (size[k] ?? 0) / 2] as const);
  const instances: Instance[] = [
    parts.map(({ centre, size }) => own(centre, size)),
    ...list.output.variations.map(({ bounds, values, absent }) =>
      parts.map(({ id, centre, size }) => {
        if (absent.includes(id)) return null;
        const box = bounds[id] ?? own(centre, size);
        const at = (word: string, rest: (low: number, high: number) => number) =>
          box.map(([low, high], k) => values[`${id}.${word}${'xyz'[k]}`] ?? rest(low, high));
        return own(
          at('c', (low, high) => (low + high) / 2),
          at('s', (low, high) => high - low),
        );
      }),
    ),
  ];
  const [first = [], ...others] = rounded(instances, scale);
  const made = parts.map((part, i) => ({
    ...part,
    centre: first[i]?.map(([low, high]) => (low + high) / 2) ?? part.centre,
    size: first[i]?.map(([low, high]) => high - low) ?? part.size,
  }));
  const varied = list.output.variations.map(({ values: _, ...variation }, k) => ({
    ...variation,
    bounds: Object.fromEntries(parts.flatMap(({ id }, i) => (others[k]?.[i] ? [[id, others[k][i]]] : []))),
  }));
  return {
    cad: { ...program.output, parts: made },
    variations: { ...list.output, variations: varied } as unknown as Variations,
  };
}

/**
 * What the core found of boxes, with parameters that count in half-diagonals of the shape: the core knows the boxes alone,
 * and surfaces may end within them.
 */
export function inFrame(found: FoundFamily, { scale }: Shape['frame']): FoundFamily {
  const factor = found.scale / scale;
  const layers = (found.program.layers as readonly { readonly parameter: { min: number; max: number } }[]).map(
    (layer) => {
      const { parameter } = layer;
      return { ...layer, parameter: { ...parameter, min: parameter.min * factor, max: parameter.max * factor } };
    },
  );
  return { ...found, scale, program: { ...found.program, layers } };
}
