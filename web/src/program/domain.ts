// Is an amount real, finite and bounded wherever its parameters may go? Interval arithmetic proves it on a box of
// parameter values; where the interval is too wide to tell, the box is halved (Moore 1966, ch. 6).
//
// Intervals are not rounded outward: this is a gate that must not refuse honest programs, not a proof.
import type { Expression } from './parse';

export interface Range {
  readonly min: number;
  readonly max: number;
}
/** Where an amount fails, and how: "a division by zero", at parameter values. */
export interface DomainFault {
  readonly cause: string;
  readonly column: number;
  /** Parameter values, by name, at or near which it fails. */
  readonly at: ReadonlyMap<string, number>;
}
/** What one call, or all calls that share it, may still spend, in evaluated nodes. */
export interface DomainBudget {
  nodes: number;
}
/** An amount larger than this in magnitude counts as infinite: everything here is of the order of 1. */
export const maxMagnitude = 1e6;

/** Arguments of sqrt and bases of powers this little below 0 are rounding noise and count as 0. */
const noise = 1e-12;
const boxesPerAmount = 256;
/** Boxes narrower than this share of the range are not halved further. */
const narrowest = 1e-9;

type Trouble = 'division by zero' | 'root of a negative number' | 'undefined or infinite value';
/** All values that an expression may take on a box, and what may go wrong there. */
interface Interval {
  readonly low: number;
  readonly high: number;
  readonly trouble: { readonly kind: Trouble; readonly column: number } | null;
}
type Box = ReadonlyMap<string, Range>;

/**
 * The values of `expression` on the box `ranges`, which must name every parameter that occurs: null when no value is
 * undefined, infinite or larger than `magnitude`, as far as `budget` allows to tell, else the first fault found.
 */
export function findDomainFault(
  expression: Expression,
  ranges: ReadonlyMap<string, Range>,
  budget: DomainBudget,
  magnitude = maxMagnitude,
): DomainFault | null {
  const names = [...parametersOf(expression)].sort();
  const whole = new Map(names.map((name) => [name, ranges.get(name) ?? { min: 0, max: 0 }]));
  return search(expression, whole, budget, magnitude);
}

/** The names of the parameters that occur. */
export function parametersOf(expression: Expression, found: Set<string> = new Set()): Set<string> {
  switch (expression.kind) {
    case 'number':
      break;
    case 'parameter':
      found.add(expression.name);
      break;
    case 'negate':
      parametersOf(expression.operand, found);
      break;
    case 'binary':
      parametersOf(expression.left, found);
      parametersOf(expression.right, found);
      break;
    case 'call':
      for (const argument of expression.arguments) parametersOf(argument, found);
  }
  return found;
}

function search(expression: Expression, whole: Box, budget: DomainBudget, magnitude: number): DomainFault | null {
  for (const end of ['min', 'max'] as const) {
    const fault = faultAt(
      expression,
      new Map([...whole].map(([name, range]) => [name, range[end]])),
      budget,
      magnitude,
    );
    if (fault) return fault;
  }
  const queue: Box[] = [whole];
  for (let boxes = 0; boxes < boxesPerAmount && budget.nodes > 0; ++boxes) {
    const next = queue.shift();
    if (!next) break;
    const value = bound(expression, next, budget);
    const wide = Math.max(-value.low, value.high) > magnitude;
    if (!value.trouble && !wide) continue;
    const middle = new Map([...next].map(([name, range]) => [name, (range.min + range.max) / 2]));
    const fault = faultAt(expression, middle, budget, magnitude);
    if (fault) return fault;
    const [name, share] = widest(next, whole);
    if (share > narrowest) {
      queue.push(...halves(next, name));
    } else if (value.trouble && value.trouble.kind !== 'root of a negative number') {
      // A pole lies in this sliver. A root that only touches 0 is fine: its middle has just been tried.
      return { cause: describe(value.trouble.kind), column: value.trouble.column, at: middle };
    }
  }
  return null;
}

function faultAt(
  expression: Expression,
  at: ReadonlyMap<string, number>,
  budget: DomainBudget,
  magnitude: number,
): DomainFault | null {
  const point = new Map([...at].map(([name, value]) => [name, { min: value, max: value }]));
  const value = bound(expression, point, budget);
  if (value.trouble) return { cause: describe(value.trouble.kind), column: value.trouble.column, at };
  if (Math.abs(value.low) <= magnitude) return null;
  return { cause: `larger than ${magnitude}`, column: expression.column, at };
}

function describe(trouble: Trouble): string {
  return (
    { 'division by zero': 'a', 'root of a negative number': 'the', 'undefined or infinite value': 'an' }[trouble] +
    ` ${trouble}`
  );
}

function widest(box: Box, whole: Box): [name: string, share: number] {
  let found: [string, number] = ['', 0];
  for (const [name, range] of box) {
    const all = whole.get(name);
    const share = all && all.max > all.min ? (range.max - range.min) / (all.max - all.min) : 0;
    if (share > found[1]) found = [name, share];
  }
  return found;
}

function halves(box: Box, name: string): Box[] {
  const { min, max } = box.get(name) ?? { min: 0, max: 0 };
  const middle = (min + max) / 2;
  return [new Map(box).set(name, { min, max: middle }), new Map(box).set(name, { min: middle, max })];
}

function bound(expression: Expression, box: Box, budget: DomainBudget): Interval {
  budget.nodes -= 1;
  switch (expression.kind) {
    case 'number':
      return { low: expression.value, high: expression.value, trouble: null };
    case 'parameter': {
      const range = box.get(expression.name) ?? { min: 0, max: 0 };
      return { low: range.min, high: range.max, trouble: null };
    }
    case 'negate': {
      const { low, high, trouble } = bound(expression.operand, box, budget);
      return { low: -high, high: -low, trouble };
    }
    case 'binary': {
      const left = bound(expression.left, box, budget);
      const right = bound(expression.right, box, budget);
      if (isZeroToZero(expression.op, left, right) && parametersOf(expression.left).size === 0) {
        return everything({ kind: 'undefined or infinite value', column: expression.column });
      }
      return settle(binary(expression.op, left, right, expression.column), expression.column, left, right);
    }
    case 'call': {
      const list = expression.arguments.map((argument) => bound(argument, box, budget));
      return settle(call(expression.name, list, expression.column), expression.column, ...list);
    }
  }
}

/** x^0 is 1 for every x, but 0^0 written as such is refused, as it is by the C++ parser. */
function isZeroToZero(op: string, base: Interval, exponent: Interval): boolean {
  return op === '^' && [base.low, base.high, exponent.low, exponent.high].every((end) => end === 0);
}

/** The first trouble of the operands counts; a bound that is not finite is trouble of its own. */
function settle(value: Interval, column: number, ...operands: Interval[]): Interval {
  const trouble = operands.find((operand) => operand.trouble)?.trouble ?? value.trouble;
  if (Number.isFinite(value.low) && Number.isFinite(value.high)) return { ...value, trouble };
  return everything(trouble ?? { kind: 'undefined or infinite value', column });
}

function everything(trouble: Interval['trouble']): Interval {
  return { low: -Number.MAX_VALUE, high: Number.MAX_VALUE, trouble };
}

function hull(values: readonly number[]): Interval {
  return { low: Math.min(...values), high: Math.max(...values), trouble: null };
}

function corners(a: Interval, b: Interval, f: (x: number, y: number) => number): Interval {
  return hull([f(a.low, b.low), f(a.low, b.high), f(a.high, b.low), f(a.high, b.high)]);
}

function binary(op: string, a: Interval, b: Interval, column: number): Interval {
  switch (op) {
    case '+':
      return { low: a.low + b.low, high: a.high + b.high, trouble: null };
    case '-':
      return { low: a.low - b.high, high: a.high - b.low, trouble: null };
    case '*':
      return corners(a, b, (x, y) => x * y);
    case '/':
      if (b.low <= 0 && b.high >= 0) return everything({ kind: 'division by zero', column });
      return corners(a, b, (x, y) => x / y);
    default:
      return power(a, b, column);
  }
}

function power(base: Interval, exponent: Interval, column: number): Interval {
  const integer = exponent.low === exponent.high && Number.isInteger(exponent.low);
  if (!integer && base.low < -noise) return everything({ kind: 'root of a negative number', column });
  const clipped = integer ? base : { ...base, low: Math.max(0, base.low), high: Math.max(0, base.high) };
  const containsZero = clipped.low <= 0 && clipped.high >= 0;
  if (containsZero && exponent.low < 0) return everything({ kind: 'division by zero', column });
  // 0^0 has no agreed value as a limit; a constant exponent 0 is the constant 1.
  if (containsZero && exponent.low <= 0 && exponent.low !== exponent.high) {
    return everything({ kind: 'undefined or infinite value', column });
  }
  const ends = corners(clipped, exponent, (x, y) => x ** y);
  const even = integer && exponent.low % 2 === 0;
  return even && containsZero ? { ...ends, low: exponent.low === 0 ? 1 : 0 } : ends;
}

function call(name: string, list: readonly Interval[], column: number): Interval {
  const [first = everything(null), second = everything(null)] = list;
  switch (name) {
    case 'sqrt':
      if (first.low < -noise) return everything({ kind: 'root of a negative number', column });
      return { low: Math.sqrt(Math.max(0, first.low)), high: Math.sqrt(Math.max(0, first.high)), trouble: null };
    case 'abs': {
      const ends = hull([Math.abs(first.low), Math.abs(first.high)]);
      return first.low <= 0 && first.high >= 0 ? { ...ends, low: 0 } : ends;
    }
    case 'floor':
      return hull([Math.floor(first.low), Math.floor(first.high)]);
    case 'sin':
      return wave(
        { ...first, low: first.low - Math.PI / 2, high: first.high - Math.PI / 2 },
        Math.sin(first.low),
        Math.sin(first.high),
      );
    case 'cos':
      return wave(first, Math.cos(first.low), Math.cos(first.high));
    case 'tan':
      if (Math.floor(first.low / Math.PI - 0.5) !== Math.floor(first.high / Math.PI - 0.5)) {
        return everything({ kind: 'undefined or infinite value', column });
      }
      return hull([Math.tan(first.low), Math.tan(first.high)]);
    case 'atan2':
      if (second.low > 0 || (first.low === first.high && second.low === second.high)) {
        return corners(first, second, Math.atan2);
      }
      return { low: -Math.PI, high: Math.PI, trouble: null };
    case 'min':
      return hullOf(list, Math.min);
    default:
      return hullOf(list, Math.max);
  }
}

function hullOf(list: readonly Interval[], f: (...values: number[]) => number): Interval {
  return { low: f(...list.map((item) => item.low)), high: f(...list.map((item) => item.high)), trouble: null };
}

/** Bounds of cos over [phase.low, phase.high], whose values at the ends are given. */
function wave(phase: Interval, atLow: number, atHigh: number): Interval {
  const top = Math.ceil(phase.low / (2 * Math.PI)) * 2 * Math.PI <= phase.high;
  const bottom = (Math.ceil(phase.low / (2 * Math.PI) - 0.5) + 0.5) * 2 * Math.PI <= phase.high;
  return { low: bottom ? -1 : Math.min(atLow, atHigh), high: top ? 1 : Math.max(atLow, atHigh), trouble: null };
}
