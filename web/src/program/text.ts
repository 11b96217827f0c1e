// Programs, statements and amounts as text that people read and edit by hand, in the manner of ParSEL's figure 2:
//   parsel program 1
//   shape "chair" "<sha256>"
//
//   layer "widen the chair": x1 = 0 in [-0.35, 0.35]
//     scale_1d("seat", amount=x1, origin=point("seat", 0, 0, 0), direction=(1, 0, 0)) because seed
//     rotate("door", amount=pi*x1, origin=(0.2, 0, 0.1), axis=axis("door", 1), feature=(0, 0, 1))   # a comment
//     change_count("t1", amount=floor(6.1*x1), anchor=fit) because group "t1", "a2"
//     keep_fixed("back")
//     relation "a3": held, worst 1.2e-9, certified
// One statement a line; blanks and the order of named fields are free. text_parse.ts and core/edit/program_text_read.cpp
// read it.
import type { Expression } from './parse';
import type { DirectionReference, PointReference, Program, RelationReport, Statement } from './types';

/** The whole program, without loss but for line breaks inside amounts. */
export function programText(program: Program): string {
  const lines = ['parsel program 1', `shape ${quoted(program.shape.name)} ${quoted(program.shape.sha256)}`];
  for (const { request, parameter, statements, relations } of program.layers) {
    const { name, value, min, max } = parameter;
    lines.push('', `layer ${quoted(request)}: ${name} = ${value} in [${min}, ${max}]`);
    lines.push(...statements.map((statement) => `  ${statementText(statement)}`));
    lines.push(...relations.map((report) => `  ${reportText(report)}`));
  }
  return `${lines.join('\n')}\n`;
}

/** One statement as it stands in the text form, without its reason when `why` is false. */
export function statementText(statement: Statement, { why = true } = {}): string {
  const operand = 'relation' in statement ? statement.relation : statement.part;
  const fields = [quoted(operand)];
  if ('amount' in statement) fields.push(`amount=${statement.amount.trim().replaceAll(/[ \t\r\n]+/g, ' ')}`);
  if ('origin' in statement) fields.push(`origin=${pointText(statement.origin)}`);
  if ('normal' in statement) fields.push(`normal=${directionText(statement.normal)}`);
  if ('direction' in statement) fields.push(`direction=${directionText(statement.direction)}`);
  if ('axis' in statement) fields.push(`axis=${directionText(statement.axis)}`);
  if ('feature' in statement && statement.feature.some((sign) => sign !== 0)) {
    fields.push(`feature=(${statement.feature.join(', ')})`);
  }
  if ('anchor' in statement) fields.push(`anchor=${statement.anchor}`);
  const text = `${statement.op}(${fields.join(', ')})`;
  if (!why || !statement.why) return text;
  return [`${text} because ${statement.why.kind}`, statement.why.relations.map(quoted).join(', ')].join(' ').trimEnd();
}

function reportText({ id, status, worst, proof, samples }: RelationReport): string {
  return `relation ${quoted(id)}: ${status}, worst ${worst}, ${proof}${samples === undefined ? '' : ` at ${samples}`}`;
}

function pointText(reference: PointReference): string {
  if (!('part' in reference)) return `(${reference.join(', ')})`;
  return `point(${quoted(reference.part)}, ${reference.at.join(', ')})`;
}

function directionText(reference: DirectionReference): string {
  if (!('part' in reference)) return `(${reference.join(', ')})`;
  return `axis(${quoted(reference.part)}, ${reference.axis})`;
}

/** As in JSON, with the escapes that both readers know. */
function quoted(text: string): string {
  const short = { '\\b': '\\u0008', '\\f': '\\u000c' } as Readonly<Record<string, string>>;
  return JSON.stringify(text).replaceAll(/\\./g, (found) => short[found] ?? found);
}

/** An amount with the fewest parentheses with which parseAmount() reads the same tree back. */
export function amountText(expression: Expression): string {
  switch (expression.kind) {
    case 'number':
      return expression.value === Math.PI ? 'pi' : String(expression.value);
    case 'parameter':
      return expression.name;
    case 'negate':
      return `-${atLeast(3, expression.operand)}`;
    case 'call':
      return `${expression.name}(${expression.arguments.map(amountText).join(', ')})`;
    case 'binary': {
      const { op, left, right } = expression;
      if (op === '^') return `${atLeast(5, left)}^${atLeast(3, right)}`;
      if (op === '*' || op === '/') return `${atLeast(2, left)}${op}${atLeast(3, right)}`;
      return `${atLeast(1, left)} ${op} ${atLeast(2, right)}`;
    }
  }
}

/** In parentheses unless it binds at least as tightly as asked: 1 sum, 2 product, 3 sign, 4 power, 5 primary. */
function atLeast(level: number, expression: Expression): string {
  const text = amountText(expression);
  return binding(expression) >= level ? text : `(${text})`;
}

function binding(expression: Expression): number {
  if (expression.kind === 'negate') return 3;
  if (expression.kind !== 'binary') return 5;
  return { '+': 1, '-': 1, '*': 2, '/': 2, '^': 4 }[expression.op];
}
