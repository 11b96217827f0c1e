// Which amounts are accepted: those that interval arithmetic shows to be defined and bounded on every piece of a box of
// parameter values; where it cannot exclude a pole, the amount is refused (Moore 1966, ch. 6). This is the rule of
// core/amount/amount_range.h, operation by operation and box by box, so that the page accepts what the tools accept;
// program_acceptance.test.ts holds the two against each other. Roots alone are forgiven: an expanded square that touches
// 0 is noise below it, so pieces where nothing but the sign under a root is open count as defined when their middle is.
import {
  binaryOperations,
  everything,
  type Interval,
  magnitudeOf,
  mignitudeOf,
  type Trouble,
  unaryOperations,
} from './interval';
import type { BinaryOperator, Expression, FunctionName } from './parse';
import { countingSlack, noise } from './rounding';

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
/** What one call, or all calls that share it, may still spend, in operations on intervals; below 0: overspent. */
export interface DomainBudget {
  nodes: number;
}
/** An amount larger than this in magnitude counts as infinite: everything here is of the order of 1. */
export const maxMagnitude = 1e6;

const boxesPerAmount = 2000;
/** Boxes narrower than this share of the range are not halved further. */
const narrowest = 1e-9;
/** What rounding outward adds to a value that just reaches the limit, and more. */
const limitSlack = 1e-9;

/** All values that an amount may take on a box, or the first trouble in the order of its code. */
interface Bound {
  readonly values: Interval;
  readonly trouble: Trouble;
  readonly column: number;
}
interface Instruction {
  readonly op: 'number' | 'parameter' | 'negate' | BinaryOperator | FunctionName;
  /** Of a number; of a parameter, its place among the names. */
  readonly value: number;
  readonly column: number;
}
type Box = readonly Interval[];

/**
 * The values of `expression` on the box `ranges`, which must name every parameter that occurs: null when it is shown that
 * no value is undefined, infinite or larger than `magnitude`, else the first fault found. Spends `budget`; null when it
 * is overspent.
 */
export function findDomainFault(
  expression: Expression,
  ranges: ReadonlyMap<string, Range>,
  budget: DomainBudget,
  magnitude = maxMagnitude,
): DomainFault | null {
  const names = [...parametersOf(expression)].sort();
  const whole = names.map((name): Interval => {
    const { min, max } = ranges.get(name) ?? { min: 0, max: 0 };
    return { low: min, high: max };
  });
  const code: Instruction[] = [];
  emit(expression, names, code);
  const look = (box: Box): Bound => {
    budget.nodes -= code.length;
    return bound(code, box);
  };
  const fits = ({ trouble, values }: Bound) =>
    trouble === 'none' && magnitudeOf(values) <= magnitude * (1 + limitSlack);
  const fault = ({ trouble, column }: Bound, at: readonly number[]): DomainFault => ({
    cause: trouble === 'none' ? `larger than ${magnitude}` : describe(trouble),
    column: trouble === 'none' ? expression.column : column,
    at: new Map(names.map((name, i) => [name, at[i] as number])),
  });
  const faultAt = (at: readonly number[]): DomainFault | null => {
    const range = look(at.map((value) => ({ low: value, high: value })));
    return range.trouble === 'none' && mignitudeOf(range.values) <= magnitude ? null : fault(range, at);
  };

  for (const end of ['low', 'high'] as const) {
    const found = faultAt(whole.map((side) => side[end]));
    if (found) return found;
  }
  const open: Box[] = [whole];
  for (let boxes = 0; boxes < open.length && budget.nodes >= 0; ++boxes) {
    const box = open[boxes] as Box;
    open[boxes] = [];
    const range = look(box);
    if (fits(range)) continue;
    const at = box.map(({ low, high }) => (low + high) / 2);
    const found = faultAt(at);
    if (found) return found;
    const [side, share] = widest(box, whole);
    if (share > narrowest && boxes < boxesPerAmount) {
      const middle = at[side] as number;
      open.push(box.map((old, i) => (i === side ? { low: old.low, high: middle } : old)));
      open.push(box.map((old, i) => (i === side ? { low: middle, high: old.high } : old)));
    } else if (range.trouble !== 'root of a negative number') {
      return fault(range, at);
    }
  }
  return null;
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

function describe(trouble: Trouble): string {
  const article = { none: '', 'division by zero': 'a', 'root of a negative number': 'the' }[trouble as string] ?? 'an';
  return `${article} ${trouble}`;
}

function widest(box: Box, whole: Box): [side: number, share: number] {
  let found: [number, number] = [0, 0];
  for (const [i, { low, high }] of box.entries()) {
    const all = (whole[i] as Interval).high - (whole[i] as Interval).low;
    const share = all > 0 ? (high - low) / all : 0;
    if (share > found[1]) found = [i, share];
  }
  return found;
}

// ------------------------------------------------------------------------------------------------------------- code

/** Postfix, as the C++ parser writes it: an operation on numbers is done at once, one without a value is left to fail. */
function emit(expression: Expression, names: readonly string[], code: Instruction[]): void {
  const { column } = expression;
  switch (expression.kind) {
    case 'number':
      code.push({ op: 'number', value: expression.value, column });
      break;
    case 'parameter':
      code.push({ op: 'parameter', value: names.indexOf(expression.name), column });
      break;
    case 'negate':
      emit(expression.operand, names, code);
      apply('negate', 1, column, code);
      break;
    case 'binary':
      emit(expression.left, names, code);
      emit(expression.right, names, code);
      apply(expression.op, 2, column, code);
      break;
    case 'call':
      for (const [i, argument] of expression.arguments.entries()) {
        emit(argument, names, code);
        if (i > 0) apply(expression.name, 2, column, code);
      }
      if (expression.arguments.length === 1) apply(expression.name, 1, column, code);
  }
}

function apply(op: Instruction['op'], arity: 1 | 2, column: number, code: Instruction[]): void {
  const operands = code.slice(-arity);
  const [a = Number.NaN, b = Number.NaN] = operands.map(({ value }) => value);
  const value = operands.every((operand) => operand.op === 'number') ? operate(op, a, b) : Number.NaN;
  // x^0 is 1 for every x, but 0^0 written as such is refused, as it is by the C++ parser.
  const isZeroToZero = op === '^' && operands.every((operand) => operand.op === 'number' && operand.value === 0);
  if (!Number.isFinite(value) && !isZeroToZero) {
    code.push({ op, value: 0, column });
    return;
  }
  code.length -= arity;
  code.push({ op: 'number', value: isZeroToZero ? Number.NaN : value, column });
}

function operate(op: Instruction['op'], a: number, b: number): number {
  const notNegative = (x: number) => (x < 0 && x >= -noise ? 0 : x);
  switch (op) {
    case 'negate':
      return -a;
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    case '^':
      return (Number.isInteger(b) ? a : notNegative(a)) ** b;
    case 'sqrt':
      return Math.sqrt(notNegative(a));
    case 'abs':
      return Math.abs(a);
    case 'floor':
      return Math.floor(a + countingSlack);
    case 'sin':
      return Math.sin(a);
    case 'cos':
      return Math.cos(a);
    case 'tan':
      return Math.tan(a);
    case 'atan2': {
      const x = b + 0;
      return Math.atan2(x < 0 && a <= 0 && a >= noise * x ? 0 : a, x);
    }
    case 'min':
      return Math.min(a, b);
    case 'max':
      return Math.max(a, b);
    default:
      return Number.NaN;
  }
}

function bound(code: readonly Instruction[], box: Box): Bound {
  const stack: Interval[] = [];
  for (const { op, value, column } of code) {
    let result: Interval | Trouble;
    if (op === 'number') result = { low: value, high: value };
    else if (op === 'parameter') result = box[value] as Interval;
    else {
      const last = stack.pop() as Interval;
      const binary = op in binaryOperations ? binaryOperations[op as keyof typeof binaryOperations] : null;
      result = binary
        ? binary(stack.pop() as Interval, last)
        : unaryOperations[op as keyof typeof unaryOperations](last);
    }
    if (typeof result === 'string') return { values: everything, trouble: result, column };
    if (!Number.isFinite(result.low) || !Number.isFinite(result.high)) {
      return { values: everything, trouble: 'undefined or infinite value', column };
    }
    stack.push(result);
  }
  return { values: stack[0] as Interval, trouble: 'none', column: 0 };
}
