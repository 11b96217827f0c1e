// Models of other people are sloppy: faces that are meant to be flush are a little apart, legs that are meant to be alike differ
// in the fourth digit. What a family is found of is rounded, so that this is equal in numbers too: the base and all its
// variations are moved, as little as possible (least squares), to where faces, centres and sizes that are one in all of them
// within a tolerance are exactly one. The model itself stays as it is; its sliders move what they move by equal lengths.

/** By part, [lowest, highest] along x, y and z. */
export type Boxes = readonly (readonly (readonly [number, number])[])[];

/** One instance of the same parts; null: it lacks the part. */
export type Instance = readonly (Boxes[number] | null)[];

/** What lies this near counts as flush, in half-diagonals (snap_distance in core/shape/attachment.h); of a thin part … */
const flush = 0.01;
/** … this share of its half extent. */
const thin = 1 / 4;
/** How far apart two are may change by this from one instance to another, in half-diagonals (`exact` in core/base/tolerance.h). */
const steady = 0.002;
/** Sizes that differ by less than this share are one (same_size() in core/split/form.h), as far as they are flush. */
const alike = 0.02;

const sweeps = 500;
/** How far apart what is one may be left, in half-diagonals: far less than what the core takes for equal (1e-6). */
const exact = 1e-9;
/** How often the tolerance is halved where rounding would move something farther than it. */
const tries = 8;

/** A face, a centre or a size: of a part along an axis, its value in every instance. */
interface Quantity {
  readonly part: number;
  readonly axis: number;
  /** Share of the lowest and of the highest bound in it: -1 and 1 make a size. */
  readonly low: number;
  readonly high: number;
}

/**
 * The instances, rounded; the first is the base, which has all parts.
 * @param scale the half-diagonal of the model, in their unit
 */
export function rounded(instances: readonly Instance[], scale: number): readonly Instance[] {
  for (let [tolerance, i] = [flush, 0]; i < tries; tolerance /= 2, i++) {
    const classes = quantities(instances[0]?.length ?? 0).flatMap((group) =>
      classesOf(instances, group, tolerance * scale, Math.min(tolerance, steady) * scale),
    );
    const made = instances.map((instance) => projected(instance, classes, exact * scale));
    if (made.every((one, k) => one !== null && isNear(one, instances[k] ?? [], tolerance * scale))) {
      return made as readonly Instance[];
    }
  }
  return instances;
}

/** Those that may be one with each other: faces and centres along an axis, sizes along all. */
function quantities(parts: number): readonly (readonly Quantity[])[] {
  const all = (low: number, high: number, axis: number): Quantity[] =>
    Array.from({ length: parts }, (_, part) => ({ part, axis, low, high }));
  const axes = [0, 1, 2];
  return [
    ...axes.map((axis) => [...all(1, 0, axis), ...all(0, 1, axis)]),
    ...axes.map((axis) => all(0.5, 0.5, axis)),
    axes.flatMap((axis) => all(-1, 1, axis)),
  ];
}

const valueIn = (instance: Instance, { part, axis, low, high }: Quantity): number => {
  const [from, to] = instance[part]?.[axis] ?? [Number.NaN, Number.NaN];
  return low * from + high * to;
};

/** Classes of at least two, in each of which any two are one (complete linkage), the nearest first. */
function classesOf(
  instances: readonly Instance[],
  group: readonly Quantity[],
  tolerance: number,
  change: number,
): Quantity[][] {
  const values = group.map((one) => instances.map((instance) => valueIn(instance, one)));
  const allowed = group.map((one) =>
    instances.map((instance) => {
      const [from, to] = instance[one.part]?.[one.axis] ?? [0, 0];
      const isSize = one.low + one.high === 0;
      return Math.min(tolerance, (to - from) * (isSize ? alike : thin / 2));
    }),
  );
  /** How far apart two are, and how much that changes, of what they may be: above 1, they are two. */
  const apart = (a: number, b: number): number => {
    let [most, least, greatest] = [0, Number.POSITIVE_INFINITY, Number.NEGATIVE_INFINITY];
    for (const i of instances.keys()) {
      const difference = (values[a]?.[i] ?? Number.NaN) - (values[b]?.[i] ?? Number.NaN);
      if (Number.isNaN(difference)) continue;
      most = Math.max(most, Math.abs(difference) / Math.min(allowed[a]?.[i] ?? 0, allowed[b]?.[i] ?? 0));
      [least, greatest] = [Math.min(least, difference), Math.max(greatest, difference)];
    }
    return Math.max(most, (greatest - least) / change);
  };
  const pairs: (readonly [number, number, number])[] = [];
  for (let a = 0; a < group.length; a++)
    for (let b = 0; b < a; b++) {
      const distance = apart(a, b);
      if (distance <= 1) pairs.push([distance, b, a]);
    }
  pairs.sort(([a], [b]) => a - b); // stable: as they come where they are equally near
  const classOf = group.map((_, i) => [i]);
  for (const [, a, b] of pairs) {
    const [one, other] = [classOf[a], classOf[b]];
    if (one === undefined || other === undefined || one === other) continue;
    if (!one.every((i) => other.every((k) => apart(i, k) <= 1))) continue;
    one.push(...other);
    for (const i of other) classOf[i] = one;
  }
  return [...new Set(classOf)].filter(({ length }) => length > 1).map((one) => one.map((i) => group[i] as Quantity));
}

/**
 * An instance moved to where every class has one value: the nearest such, by projecting onto one class after the other, again
 * and again (Kaczmarz 1937). Null where it is not reached.
 */
function projected(instance: Instance, classes: readonly (readonly Quantity[])[], near: number): Instance | null {
  const boxes = instance.map((box) => box?.map(([low, high]) => [low, high] as [number, number]) ?? null);
  const here = classes.map((one) => one.filter(({ part }) => boxes[part] !== null)).filter(({ length }) => length > 1);
  for (let sweep = 0; sweep < sweeps; sweep++) {
    let farthest = 0;
    for (const one of here) {
      const values = one.map((quantity) => valueIn(boxes, quantity));
      const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
      for (const [i, { part, axis, low, high }] of one.entries()) {
        const off = mean - (values[i] as number);
        farthest = Math.max(farthest, Math.abs(off));
        const bounds = boxes[part]?.[axis];
        const share = off / (low * low + high * high);
        if (bounds === undefined) continue;
        bounds[0] += low * share;
        bounds[1] += high * share;
      }
    }
    if (farthest <= near) return boxes;
  }
  return null;
}

/** Whether no face has moved farther than the tolerance, and every box is one. */
const isNear = (moved: Instance, from: Instance, tolerance: number): boolean =>
  moved.every(
    (box, part) =>
      box?.every(([low, high], axis) => {
        const [l, h] = from[part]?.[axis] ?? [low, high];
        return high > low && Math.abs(low - l) <= tolerance && Math.abs(high - h) <= tolerance;
      }) ?? true,
  );
