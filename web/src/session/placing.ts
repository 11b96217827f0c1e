// How the model stands and how large it is, where its file says it otherwise than one would think: guessed, offered, and
// changed by a person. What is shown and said follows; the file does not, unless it is exported so.

import { signal } from '@preact/signals';
import { asInFile, type Direction, directions, type Placing, vectorOf } from '../carve/placing';
import { type Corners, isReflection, type Shape } from '../program/types';
import type { ModelFiles } from '../scene/load';
import { m } from '../texts/texts';
import { carved } from './carve';
import { carveModel } from './carving';
import type { ModelCore } from './model_core';
import { oncePerShape } from './once_per_shape';
import type { RunOptions } from './tasks';

/** How a model stands now. */
export function placingOf({ carved: done }: ModelFiles): Placing {
  const step = done?.steps.findLast(({ kind }) => kind === 'place');
  return step?.kind === 'place' ? { up: step.up, front: step.front, metres: step.metres } : asInFile;
}

/** Whether it stands or measures otherwise than its file says. */
export function isPlaced(files: ModelFiles): boolean {
  const { up, front, metres } = placingOf(files);
  return up !== asInFile.up || front !== asInFile.front || metres !== asInFile.metres;
}

export const place = (core: ModelCore, placing: Placing): Promise<boolean> =>
  carveModel(core, { kind: 'place', ...placing });

/** What is exported of a model that was stood up here: as its file stands. Rejects as carved() does. */
export async function asItsFile(files: ModelFiles, glb: Uint8Array, options: RunOptions): Promise<Uint8Array> {
  if (!isPlaced(files)) return glb;
  const bare = { name: files.name, main: glb, external: new Map() };
  return (await carved(bare, { kind: 'place', ...asInFile }, options)).files.main;
}

/** Offers that were declined, by the files that they were about. */
export const declined = signal<ReadonlySet<ModelFiles>>(new Set());
export const decline = (files: ModelFiles): void => {
  declined.value = new Set([...declined.peek(), files]);
};

/** What a language model takes for the front of a model, by the files that it was said of. */
export const fronts = signal<ReadonlyMap<ModelFiles, Direction>>(new Map());
export function suggestFront(files: ModelFiles, front: Direction): void {
  fronts.value = new Map([...fronts.peek(), [files, front]]);
}

type Box = readonly [low: number, high: number][];

const boxOf = (corners: Corners): Box =>
  [0, 1, 2].map((axis) => {
    let [low, high] = [Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const corner of corners) {
      low = Math.min(low, corner[axis] ?? 0);
      high = Math.max(high, corner[axis] ?? 0);
    }
    return [low, high] as [number, number];
  });

/** Feet are narrower than this share of the whole, across what they stand on. */
const narrow = 0.35;
/** … reach the ground within this share of the height … */
const level = 0.02;
/** … are longer than this share of it … */
const leastFoot = 0.15;
/** … and together stand on this share of the whole, both ways. */
const spread = 0.5;

/** Of the parts, those that would be feet if a direction were up: three or more, alike in length, standing apart. */
function feet(boxes: readonly Box[], whole: Box, up: Direction): number {
  const axis = 'xyz'.indexOf(up.charAt(1));
  const sign = vectorOf(up)[axis] ?? 1;
  const extent = (i: number, box = whole) => (box[i]?.[1] ?? 0) - (box[i]?.[0] ?? 0);
  const ground = sign > 0 ? (whole[axis]?.[0] ?? 0) : -(whole[axis]?.[1] ?? 0);
  const others = [0, 1, 2].filter((i) => i !== axis);
  const found = boxes.filter((box) => {
    const low = sign > 0 ? (box[axis]?.[0] ?? 0) : -(box[axis]?.[1] ?? 0);
    return (
      low - ground <= level * extent(axis) &&
      extent(axis, box) >= leastFoot * extent(axis) &&
      others.every((i) => extent(i, box) <= narrow * extent(i))
    );
  });
  const stands = others.every((i) => {
    const lows = found.map((box) => box[i]?.[0] ?? 0);
    const highs = found.map((box) => box[i]?.[1] ?? 0);
    return Math.max(...highs) - Math.min(...lows) >= spread * extent(i);
  });
  return found.length >= 3 && stands ? found.length : 0;
}

/**
 * The direction of the model, as it stands, that seems to be up where +y does not: the one that it has feet for, and
 * mirror images do not speak against. Null where it stands well, or nobody can say.
 */
export const seemsUp = oncePerShape((shape): Direction | null => {
  const real = shape.parts.filter(({ virtual }) => !virtual);
  if (real.length < 4) return null;
  const boxes = real.map(({ corners }) => boxOf(corners));
  const whole = boxOf(real.flatMap(({ corners }) => corners));
  const standing = directions.map((up) => ({ up, count: feet(boxes, whole, up) })).filter(({ count }) => count > 0);
  const [first, ...others] = standing;
  if (first === undefined || others.length > 0 || first.up === '+y') return null;
  // Left and right are mirror images of each other, top and bottom seldom: up lies in the planes of symmetry.
  const [x, y, z] = vectorOf(first.up);
  const normals = shape.relations.filter(isReflection).map(({ normal }) => normal);
  const across = normals.filter((normal) => Math.abs(normal[0] * x + normal[1] * y + normal[2] * z) > 0.9).length;
  return across > normals.length / 2 ? null : first.up;
});

/** Words of labels for what is at the front (1) or at the back (-1). */
const facingWords: Readonly<Record<string, number>> = {
  front: 1,
  back: -1,
  rear: -1,
  backrest: -1,
  vorne: 1,
  hinten: -1,
};
/** Of half the model's extent, from its middle: so far out, and no further aside. */
const farOut = 0.5;
const aside = 0.25;

/** What is the front of the model as it stands, by what its labels call front and back: +z where they say nothing else. */
export const seemsFront = oncePerShape((shape): Direction => {
  const real = shape.parts.filter(({ virtual }) => !virtual);
  const whole = boxOf(real.flatMap(({ corners }) => corners));
  const told = real.flatMap(({ label, corners }) => {
    const words = label
      .replace(/([a-z])([A-Z])/g, '$1 $2')
      .toLowerCase()
      .split(/[^a-z]+/);
    const sign = Math.sign(words.reduce((sum, word) => sum + (facingWords[word] ?? 0), 0));
    if (sign === 0) return [];
    return [
      boxOf(corners).map(([low, high], i) => {
        const [least = 0, most = 0] = whole[i] ?? [];
        return (sign * (low + high - least - most)) / (most - least || 1);
      }),
    ];
  });
  if (told.length === 0) return '+z';
  const [x, z] = [0, 2].map((i) => told.reduce((sum, out) => sum + (out[i] ?? 0), 0) / told.length) as [number, number];
  if (Math.abs(x) >= farOut && Math.abs(z) <= aside) return x > 0 ? '+x' : '-x';
  return z <= -farOut && Math.abs(x) <= aside ? '-z' : '+z';
});

/** Things that people make or sit on are between these, in metres, along their longest side. */
const usual = { least: 0.02, most: 15 };
/** Units that files are drawn in, in metres; a file that says nothing is read in metres. */
export const fileUnits = [
  { metres: 1, label: m`metres` },
  { metres: 0.01, label: m`centimetres` },
  { metres: 0.001, label: m`millimetres` },
  { metres: 0.0254, label: m`inches` },
  { metres: 0.3048, label: m`feet` },
] as const;

/** Along x, y and z, in metres, at rest. */
export const extentOf = oncePerShape(({ parts, frame }): [number, number, number] => {
  const box = boxOf(parts.filter(({ virtual }) => !virtual).flatMap(({ corners }) => corners));
  return box.map(([low, high]) => (high - low) * frame.scale) as [number, number, number];
});

/** The unit that the file seems to be drawn in, where it is too large or too small for one in metres; else null. */
export function seemsDrawnIn(shape: Shape, now: Placing): number | null {
  const longest = Math.max(...extentOf(shape));
  if (now.metres !== 1 || (longest >= usual.least && longest <= usual.most) || longest === 0) return null;
  // Inches cannot be told from centimetres by size: they are for a person to choose.
  const likely = longest > usual.most ? [0.001, 0.01] : [1000, 100];
  // Nearest to a metre and a half, as a chair or a table is.
  const off = (metres: number) => Math.abs(Math.log((longest * metres) / 1.5));
  const best = likely.reduce((a, b) => (off(b) < off(a) ? b : a));
  const made = longest * best;
  return made >= usual.least && made <= usual.most ? best : null;
}
