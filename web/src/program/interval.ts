// Intervals of doubles with outward rounding, and what the operations of amounts do to them: as core/amount/interval.h and
// amount_range.cpp, rounding for rounding.
import { countingSlack, noise } from './rounding';

export type Trouble = 'none' | 'division by zero' | 'root of a negative number' | 'undefined or infinite value';
export interface Interval {
  readonly low: number;
  readonly high: number;
}

const ulp = 2 ** -52;
const smallest = 2 ** -1022;
/** π lies above its double, and below the next. */
const halfTurn = Math.PI + 2 ** -51;
export const everything: Interval = { low: Number.NEGATIVE_INFINITY, high: Number.POSITIVE_INFINITY };
const anyTurn: Interval = { low: -halfTurn, high: halfTurn };

function down(r: number): number {
  return r - (Math.abs(r) * ulp + smallest);
}
function up(r: number): number {
  return r + (Math.abs(r) * ulp + smallest);
}
function contains(a: Interval, value: number): boolean {
  return a.low <= value && value <= a.high;
}
export function magnitudeOf(a: Interval): number {
  return Math.max(Math.abs(a.low), Math.abs(a.high));
}
export function mignitudeOf(a: Interval): number {
  return a.low > 0 ? a.low : a.high < 0 ? -a.high : 0;
}
function outward(values: readonly number[]): Interval {
  if (values.some(Number.isNaN)) return everything;
  return { low: down(Math.min(...values)), high: up(Math.max(...values)) };
}
/** Functions of the library are trusted to four ulps. */
function library(values: readonly number[], floor = -Infinity, ceiling = Infinity): Interval {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  return {
    low: Math.max(low - (Math.abs(low) * 4 * ulp + smallest), floor),
    high: Math.min(high + (Math.abs(high) * 4 * ulp + smallest), ceiling),
  };
}
/** Whether some point phase + 2πk may lie in the interval; says yes when in doubt. */
function meets(a: Interval, phase: number): boolean {
  const slack = 1e-9 * (1 + magnitudeOf(a));
  const first = Math.ceil((a.low - slack - phase) / (2 * Math.PI));
  const last = Math.floor((a.high + slack - phase) / (2 * Math.PI));
  return !(last < first);
}
/** Of sin, cos, tan and floor: what two libraries make of x1^3 differs in the last place, an eighth of a turn at 1e15. */
const largestArgument = 1e6;
function wave(a: Interval, f: (x: number) => number, crest: number): Interval | Trouble {
  if (magnitudeOf(a) > largestArgument) return 'undefined or infinite value';
  const ends = library([f(a.low), f(a.high)], -1, 1);
  return { low: meets(a, crest + Math.PI) ? -1 : ends.low, high: meets(a, crest) ? 1 : ends.high };
}
function corners(a: Interval, b: Interval, f: (x: number, y: number) => number): number[] {
  return [f(a.low, b.low), f(a.low, b.high), f(a.high, b.low), f(a.high, b.high)];
}

function integerPower(base: Interval, n: number): Interval {
  if (n === 0) return { low: 1, high: 1 };
  const even = n % 2 === 0;
  if (even) return library([mignitudeOf(base) ** n, magnitudeOf(base) ** n], 0);
  return library([base.low ** n, base.high ** n]);
}

function power(base: Interval, exponent: Interval): Interval | Trouble {
  if (exponent.low === exponent.high && Number.isInteger(exponent.low)) {
    if (exponent.low < 0 && contains(base, 0)) return 'division by zero';
    return integerPower(base, exponent.low);
  }
  if (base.low < -noise) return 'root of a negative number';
  const real = { low: Math.max(0, base.low), high: Math.max(0, base.high) };
  if (real.low <= 0 && exponent.low < 0) return 'division by zero';
  // As a limit 0^0 has no value.
  if (real.low <= 0 && exponent.low <= 0) return 'undefined or infinite value';
  return library(
    corners(real, exponent, (x, y) => x ** y),
    0,
  );
}

function turn(y: Interval, x: Interval): Interval {
  const away = x.low > 0 || y.low > 0 || y.high < Math.min(noise * x.low, 0);
  return away ? library(corners(y, x, Math.atan2), -halfTurn, halfTurn) : anyTurn;
}

/** By operator or function. */
export const binaryOperations = {
  '+': (a: Interval, b: Interval): Interval => ({ low: down(a.low + b.low), high: up(a.high + b.high) }),
  '-': (a: Interval, b: Interval): Interval => ({ low: down(a.low - b.high), high: up(a.high - b.low) }),
  '*': (a: Interval, b: Interval): Interval => outward(corners(a, b, (x, y) => x * y)),
  '/': (a: Interval, b: Interval): Interval | Trouble =>
    contains(b, 0) ? 'division by zero' : outward(corners(a, b, (x, y) => x / y)),
  '^': power,
  atan2: turn,
  min: (a: Interval, b: Interval): Interval => ({ low: Math.min(a.low, b.low), high: Math.min(a.high, b.high) }),
  max: (a: Interval, b: Interval): Interval => ({ low: Math.max(a.low, b.low), high: Math.max(a.high, b.high) }),
};

export const unaryOperations = {
  negate: (a: Interval): Interval => ({ low: -a.high, high: -a.low }),
  sqrt: (a: Interval): Interval | Trouble =>
    a.low < -noise
      ? 'root of a negative number'
      : library([Math.sqrt(Math.max(0, a.low)), Math.sqrt(Math.max(0, a.high))], 0),
  abs: (a: Interval): Interval => ({ low: mignitudeOf(a), high: magnitudeOf(a) }),
  floor: (a: Interval): Interval | Trouble =>
    magnitudeOf(a) > largestArgument
      ? 'undefined or infinite value'
      : { low: Math.floor(down(a.low + countingSlack)), high: Math.floor(up(a.high + countingSlack)) },
  sin: (a: Interval): Interval | Trouble => wave(a, Math.sin, Math.PI / 2),
  cos: (a: Interval): Interval | Trouble => wave(a, Math.cos, 0),
  tan: (a: Interval): Interval =>
    magnitudeOf(a) > largestArgument || meets(a, Math.PI / 2) || meets(a, -Math.PI / 2)
      ? everything
      : library([Math.tan(a.low), Math.tan(a.high)]),
};
