// Amounts of the readable evaluator (interpret.ts): an expression at given values of its parameters.
import type { Expression } from './parse';

/** NaN where the expression is undefined or overflows. */
export function evaluateExpression(expression: Expression, parameters: ReadonlyMap<string, number>): number {
  const value = (inner: Expression) => evaluateExpression(inner, parameters);
  switch (expression.kind) {
    case 'number':
      return expression.value;
    case 'parameter':
      return parameters.get(expression.name) ?? Number.NaN;
    case 'negate':
      return -value(expression.operand);
    case 'binary':
      return defined(binary(expression.op, value(expression.left), value(expression.right)));
    case 'call':
      return defined(call(expression.name, expression.arguments.map(value)));
  }
}

function defined(value: number): number {
  return Number.isFinite(value) ? value : Number.NaN;
}

function binary(op: string, a: number, b: number): number {
  if (Number.isNaN(a) || Number.isNaN(b)) return Number.NaN;
  switch (op) {
    case '+':
      return a + b;
    case '-':
      return a - b;
    case '*':
      return a * b;
    case '/':
      return a / b;
    default:
      return Number.isInteger(b) ? a ** b : notNegative(a) ** b;
  }
}

function call(name: string, list: readonly number[]): number {
  const [a = Number.NaN, b = Number.NaN] = list;
  switch (name) {
    case 'sqrt':
      return Math.sqrt(notNegative(a));
    case 'abs':
      return Math.abs(a);
    case 'floor':
      return Math.floor(a + 1e-9);
    case 'sin':
      return Math.sin(a);
    case 'cos':
      return Math.cos(a);
    case 'tan':
      return Math.tan(a);
    case 'atan2':
      return b < 0 && a <= 0 && a >= 1e-12 * b ? Math.PI : Math.atan2(a, b + 0);
    case 'min':
      return Math.min(...list);
    default:
      return Math.max(...list);
  }
}

/** The noise of expanded forms below 0 is 0. */
function notNegative(value: number): number {
  return value >= -1e-12 && value < 0 ? 0 : value;
}
