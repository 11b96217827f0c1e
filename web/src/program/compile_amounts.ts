// Amounts compiled to closures over slots: each distinct sub-expression of a whole program has one slot of one
// Float64Array and one closure that fills it. Constants are folded by running their closures once.
//
// Closures return nothing on purpose: a number that crosses a call which the engine does not inline is boxed on the
// heap, and the slider path must not feed the garbage collector.
import type { BinaryOperator, Expression, FunctionName } from './parse';
import { countingSlack, noise } from './rounding';

export interface CompiledAmounts {
  /** One value a slot. Parameter i of the constructor's list is read from slot i. */
  readonly slots: Float64Array;
  /** Where the amount with this text is found after evaluate(); 0 in place of anything not finite. */
  slotOf(text: string): number;
  /** The same before that guard: NaN where the amount is undefined. */
  valueSlotOf(text: string): number;
  /** Whether the amount's value depends on no parameter, so that its slot is filled from the start. */
  isConstant(text: string): boolean;
  /** Fills all slots from the parameters' slots. */
  evaluate(): void;
}

interface Node {
  readonly op: 'number' | 'parameter' | 'negate' | 'finite' | BinaryOperator | FunctionName;
  /** Slots of the operands. */
  readonly left: number;
  readonly right: number;
  /** Of a number. */
  readonly value: number;
  readonly constant: boolean;
}

export function compileAmounts(
  amounts: ReadonlyMap<string, Expression>,
  parameters: readonly string[],
): CompiledAmounts {
  const nodes: Node[] = [];
  const known = new Map<string, number>();

  const add = (op: Node['op'], left = -1, right = -1, value = 0, constant = false): number => {
    const key = `${op} ${left} ${right} ${value}`;
    const found = known.get(key);
    if (found !== undefined) return found;
    nodes.push({ op, left, right, value, constant });
    known.set(key, nodes.length - 1);
    return nodes.length - 1;
  };
  const isConstant = (slot: number) => slot < 0 || nodes[slot]?.constant === true;
  const apply = (op: Node['op'], left: number, right = -1) =>
    add(op, left, right, 0, isConstant(left) && isConstant(right));
  const visit = (expression: Expression): number => {
    switch (expression.kind) {
      case 'number':
        return add('number', -1, -1, expression.value, true);
      case 'parameter':
        return parameters.indexOf(expression.name);
      case 'negate':
        return apply('negate', visit(expression.operand));
      case 'binary':
        return apply(expression.op, visit(expression.left), visit(expression.right));
      case 'call': {
        const [first = -1, ...rest] = expression.arguments.map(visit);
        if (rest.length === 0) return apply(expression.name, first);
        return rest.reduce((left, right) => apply(expression.name, left, right), first);
      }
    }
  };

  for (const [i] of parameters.entries()) add('parameter', -1, -1, i);
  const slotOf = new Map([...amounts].map(([text, expression]) => [text, apply('finite', visit(expression))]));
  const slots = new Float64Array(nodes.length);
  const steps: (() => void)[] = [];
  for (const [slot, node] of nodes.entries()) {
    const step = closure(node, slot, slots);
    if (node.constant) step();
    else if (node.op !== 'parameter') steps.push(step);
  }
  const slotOfText = (text: string): number => {
    const slot = slotOf.get(text);
    if (slot === undefined) throw new Error(`the amount ${text} was not compiled`);
    return slot;
  };
  return {
    slots,
    slotOf: slotOfText,
    valueSlotOf: (text) => nodes[slotOfText(text)]?.left ?? -1,
    isConstant: (text) => isConstant(slotOfText(text)),
    evaluate() {
      for (let i = 0; i < steps.length; ++i) (steps[i] as () => void)();
    },
  };
}

/**
 * Fills s[t] from s[a] and s[b]. What is undefined or overflows is NaN, and NaN stays NaN: x − x is 0 for finite x only,
 * so x + (x − x) is x or NaN.
 */
function closure(node: Node, t: number, s: Float64Array): () => void {
  const { op, left: a, right: b, value } = node;
  switch (op) {
    case 'number':
      return () => {
        s[t] = value;
      };
    case 'parameter':
      return () => {};
    case 'finite':
      return () => {
        const x = s[a] as number;
        s[t] = x - x === 0 ? x : 0;
      };
    case 'negate':
      return () => {
        s[t] = -(s[a] as number);
      };
    case '+':
      return () => {
        const x = (s[a] as number) + (s[b] as number);
        s[t] = x + (x - x);
      };
    case '-':
      return () => {
        const x = (s[a] as number) - (s[b] as number);
        s[t] = x + (x - x);
      };
    case '*':
      return () => {
        const x = (s[a] as number) * (s[b] as number);
        s[t] = x + (x - x);
      };
    case '/':
      return () => {
        const x = (s[a] as number) / (s[b] as number);
        s[t] = x + (x - x);
      };
    case '^':
      return () => {
        let base = s[a] as number;
        const exponent = s[b] as number;
        if (base < 0 && base >= -noise && Math.floor(exponent) !== exponent) base = 0;
        const x = base ** exponent;
        s[t] = x + (x - x) + (base - base);
      };
    case 'sqrt':
      return () => {
        const x = s[a] as number;
        s[t] = x < 0 && x >= -noise ? 0 : Math.sqrt(x);
      };
    case 'abs':
      return () => {
        s[t] = Math.abs(s[a] as number);
      };
    case 'floor':
      return () => {
        s[t] = Math.floor((s[a] as number) + countingSlack);
      };
    case 'sin':
      return () => {
        s[t] = Math.sin(s[a] as number);
      };
    case 'cos':
      return () => {
        s[t] = Math.cos(s[a] as number);
      };
    case 'tan':
      return () => {
        s[t] = Math.tan(s[a] as number);
      };
    case 'atan2':
      return () => {
        // Beside the cut, where it jumps by 2π, y may come out a hair below 0; -0 is 0.
        const y = s[a] as number;
        const x = (s[b] as number) + 0;
        s[t] = Math.atan2(x < 0 && y <= 0 && y >= noise * x ? 0 : y, x);
      };
    case 'min':
      return () => {
        s[t] = Math.min(s[a] as number, s[b] as number);
      };
    case 'max':
      return () => {
        s[t] = Math.max(s[a] as number, s[b] as number);
      };
  }
}
