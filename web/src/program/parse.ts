// Amounts: text → expression tree. The grammar is that of core/edit/amount.h, kept in step by
// tests/golden/expression_vectors.json:
//   sum     = product { ("+" | "-") product }
//   product = unary { ("*" | "/") unary }
//   unary   = ("-" | "+") unary | power                   so -x^2 = -(x^2)
//   power   = primary [ "^" unary ]                       right-associative; x^-2 is allowed
//   primary = number | "pi" | parameter | function "(" sum { "," sum } ")" | "(" sum ")"
import type { Result } from './types';

/** Longest amount, in characters. */
export const maxAmountLength = 4096;
/** Most parentheses, signs and exponents that may be open at once. */
export const maxAmountDepth = 64;

export const functionNames = ['sqrt', 'abs', 'floor', 'sin', 'cos', 'tan', 'atan2', 'min', 'max'] as const;
export type FunctionName = (typeof functionNames)[number];
export type BinaryOperator = '+' | '-' | '*' | '/' | '^';

/** `column` is where the node's operator, function or first character stands, 1-based. */
export type Expression =
  | { readonly kind: 'number'; readonly value: number; readonly column: number }
  | { readonly kind: 'parameter'; readonly name: string; readonly column: number }
  | { readonly kind: 'negate'; readonly operand: Expression; readonly column: number }
  | {
      readonly kind: 'binary';
      readonly op: BinaryOperator;
      readonly left: Expression;
      readonly right: Expression;
      readonly column: number;
    }
  | {
      readonly kind: 'call';
      readonly name: FunctionName;
      readonly arguments: readonly Expression[];
      readonly column: number;
    };

/** [a-z][a-z0-9_]* that is neither a function's name nor `pi`. */
export function isParameterName(name: string): boolean {
  return /^[a-z][a-z0-9_]*$/.test(name) && name !== 'pi' && !isFunctionName(name);
}

/** Reads an amount. Errors have the place "column N", 1-based. */
export function parseAmount(text: string): Result<Expression> {
  if (text.length > maxAmountLength) {
    return refusal(maxAmountLength + 1, `the amount has ${text.length} characters`, `use at most ${maxAmountLength}`);
  }
  try {
    return { ok: true, value: new Parser(text).parse() };
  } catch (thrown) {
    if (thrown instanceof SyntaxProblem) return refusal(thrown.column, thrown.message, thrown.fix);
    throw thrown;
  }
}

function refusal(column: number, cause: string, fix: string): Result<never> {
  return { ok: false, error: { stage: 'program/parse', place: `column ${column}`, cause, fix } };
}

/** Unwinds the recursive descent; never leaves this file. */
class SyntaxProblem extends Error {
  constructor(
    readonly column: number,
    cause: string,
    readonly fix: string,
  ) {
    super(cause);
  }
}

interface Token {
  readonly kind: 'number' | 'name' | 'symbol' | 'end';
  readonly text: string;
  readonly column: number;
}

const tokenPattern = /[ \t\r\n]*(?:((?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d+)?)|([a-z][a-z0-9_]*)|([-+*/^(),])|($))/y;

function isFunctionName(name: string): name is FunctionName {
  return (functionNames as readonly string[]).includes(name);
}

class Parser {
  private readonly pattern = new RegExp(tokenPattern);
  private token: Token;
  private depth = 0;

  constructor(private readonly text: string) {
    this.token = this.scan();
  }

  parse(): Expression {
    const expression = this.sum();
    if (this.token.kind !== 'end') this.unexpected('an operator or the end');
    return expression;
  }

  private sum(): Expression {
    let left = this.product();
    for (let op = this.take('+', '-'); op; op = this.take('+', '-')) {
      left = { kind: 'binary', op: op.text as BinaryOperator, left, right: this.product(), column: op.column };
    }
    return left;
  }

  private product(): Expression {
    let left = this.unary();
    for (let op = this.take('*', '/'); op; op = this.take('*', '/')) {
      left = { kind: 'binary', op: op.text as BinaryOperator, left, right: this.unary(), column: op.column };
    }
    return left;
  }

  private unary(): Expression {
    const sign = this.take('-', '+');
    if (!sign) return this.power();
    const operand = this.nested(sign, () => this.unary());
    return sign.text === '-' ? { kind: 'negate', operand, column: sign.column } : operand;
  }

  private power(): Expression {
    const base = this.primary();
    const op = this.take('^');
    if (!op) return base;
    return { kind: 'binary', op: '^', left: base, right: this.nested(op, () => this.unary()), column: op.column };
  }

  private primary(): Expression {
    const token = this.token;
    if (token.kind === 'number') {
      this.token = this.scan();
      return { kind: 'number', value: this.number(token), column: token.column };
    }
    if (token.kind === 'name') {
      this.token = this.scan();
      if (isFunctionName(token.text)) return this.call(token, token.text);
      if (token.text === 'pi') return { kind: 'number', value: Math.PI, column: token.column };
      if (this.token.text === '(') {
        throw new SyntaxProblem(token.column, `"${token.text}" is no function`, `use ${functionNames.join(', ')}`);
      }
      return { kind: 'parameter', name: token.text, column: token.column };
    }
    const open = this.take('(');
    if (!open) return this.unexpected('a number, a parameter, a function or "("');
    const inner = this.nested(open, () => this.sum());
    this.expect(')');
    return inner;
  }

  private call(token: Token, name: FunctionName): Expression {
    const open = this.take('(');
    if (!open) throw new SyntaxProblem(token.column, `${name} has no arguments`, 'write them in parentheses');
    const list = this.nested(open, () => {
      const found = [this.sum()];
      while (this.take(',')) found.push(this.sum());
      return found;
    });
    this.expect(')');
    const variadic = name === 'min' || name === 'max';
    const wanted = variadic || name === 'atan2' ? 2 : 1;
    if (variadic ? list.length < wanted : list.length !== wanted) {
      const words = `${variadic ? 'at least ' : ''}${wanted} argument${wanted === 1 ? '' : 's'}`;
      throw new SyntaxProblem(token.column, `${name} has ${list.length} argument(s)`, `give it ${words}`);
    }
    return { kind: 'call', name, arguments: list, column: token.column };
  }

  private number(token: Token): number {
    const exponent = /[eE](.*)$/.exec(token.text)?.[1];
    const value = Number(token.text);
    // The other parser keeps exact rationals, for which an exponent of a billion would be a billion digits.
    if (!Number.isFinite(value) || (exponent !== undefined && Math.abs(Number(exponent)) > 308)) {
      throw new SyntaxProblem(token.column, 'the number is out of range', 'use exponents from -308 to 308');
    }
    return value;
  }

  private nested<T>(opener: Token, body: () => T): T {
    if (++this.depth > maxAmountDepth) {
      throw new SyntaxProblem(opener.column, 'the amount is nested too deeply', `use at most ${maxAmountDepth} levels`);
    }
    const value = body();
    this.depth -= 1;
    return value;
  }

  private take(...symbols: string[]): Token | null {
    const token = this.token;
    if (token.kind !== 'symbol' || !symbols.includes(token.text)) return null;
    this.token = this.scan();
    return token;
  }

  private expect(symbol: string): void {
    if (!this.take(symbol)) this.unexpected(`"${symbol}"`);
  }

  private unexpected(wanted: string): never {
    const found = this.token.kind === 'end' ? 'the amount ends here' : `"${this.token.text}" is unexpected`;
    throw new SyntaxProblem(this.token.column, found, `write ${wanted} here`);
  }

  private scan(): Token {
    const from = this.pattern.lastIndex;
    const match = this.pattern.exec(this.text);
    if (!match) {
      const blanks = /[ \t\r\n]*/y;
      blanks.lastIndex = from;
      const column = from + (blanks.exec(this.text)?.[0].length ?? 0);
      const character = JSON.stringify(String.fromCodePoint(this.text.codePointAt(column) ?? 0));
      throw new SyntaxProblem(
        column + 1,
        `${character} is no part of an amount`,
        'use + - * / ^ ( ) , and lower-case names',
      );
    }
    const [, number, name, symbol] = match;
    const text = number ?? name ?? symbol ?? '';
    const kind =
      number !== undefined ? 'number' : name !== undefined ? 'name' : symbol !== undefined ? 'symbol' : 'end';
    return { kind, text, column: this.pattern.lastIndex - text.length + 1 };
  }
}
