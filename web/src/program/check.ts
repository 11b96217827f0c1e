// The gate for programs from outside (share links, files, replies): untrusted JSON → a program that is known to be
// well-formed, to fit a shape, and to be real and finite over the whole range of its parameters.
//
// The input is never changed; what comes out is a copy, and there is none unless everything has been accepted.
import { type DomainBudget, findDomainFault, maxMagnitude, parametersOf, type Range } from './domain';
import { type Format, pointer, quote, readFormat } from './gate';
import { type Expression, parseAmount } from './parse';
import { partIndex } from './part_index';
import { limits, programSchema } from './schema';
import {
  type CageRelation,
  type CageShape,
  type DirectionReference,
  isGeometric,
  isGroup,
  maxInstances,
  type PointReference,
  type Program,
  type ProgramError,
  type Result,
  type Statement,
} from './types';

declare const checked: unique symbol;

/** A program that has passed checkProgram() for a shape, with its amounts parsed. Only checkProgram() makes one. */
export interface CheckedProgram {
  readonly program: Program;
  /** Of every amount that occurs, by its text. */
  readonly amounts: ReadonlyMap<string, Expression>;
  readonly [checked]: true;
}

/** Operations on intervals that all amounts of a program may take together: judging_budget in core/amount/amount_range.h. */
const domainBudget = 2_000_000;

const format: Format = { stage: 'program/check', what: 'program', name: 'parsel/program' };

/** The structure of untrusted JSON alone: what its names mean is left to checkProgram(). */
export function readProgram(json: unknown): Result<Program> {
  return readFormat(json, programSchema, format);
}

/**
 * Checks untrusted JSON against the format and a shape. Refused are: unknown formats, versions, keys, operators, parts
 * and relations; numbers that are not finite; lists, texts and nesting beyond `limits`; amounts that do not parse, name
 * unknown parameters, or are complex, infinite, undefined or huge somewhere over the parameters' ranges; operators on an
 * instance of a group whose count the program changes. The place of an error is a JSON pointer.
 */
export function checkProgram(json: unknown, shape: CageShape): Result<CheckedProgram> {
  const read = readProgram(json);
  return read.ok ? new Checker(read.value, shape).run() : read;
}

/** Stops at the first fault; never leaves this file. */
class Fault extends Error {
  constructor(readonly error: ProgramError) {
    super(error.cause);
  }
}

class Checker {
  private readonly parts: ReadonlyMap<string, number>;
  private readonly relations: ReadonlyMap<string, CageRelation>;
  /** The group that a part, by its index, is an instance of. */
  private readonly groupOf: ReadonlyMap<number | undefined, string>;
  private readonly ranges = new Map<string, Range>();
  private readonly amounts = new Map<string, Expression>();
  private readonly recounted = new Set<string>();
  private readonly budget: DomainBudget = { nodes: domainBudget };

  constructor(
    private readonly program: Program,
    shape: CageShape,
  ) {
    this.parts = partIndex(shape);
    this.relations = new Map(shape.relations.map((relation) => [relation.id, relation]));
    this.groupOf = new Map(
      shape.relations.flatMap((relation) =>
        isGroup(relation) ? relation.parts.map((id) => [this.parts.get(id), relation.id] as const) : [],
      ),
    );
  }

  run(): Result<CheckedProgram> {
    try {
      const { layers } = this.program;
      const total = layers.reduce((sum, layer) => sum + layer.statements.length, 0);
      if (total > limits.statements) {
        this.refuse('/layers', `${total} statements in all`, `use at most ${limits.statements}`);
      }
      for (const [i, layer] of layers.entries()) this.parameter(layer.parameter, pointer('layers', i, 'parameter'));
      for (const [i, layer] of layers.entries()) {
        for (const [j, statement] of layer.statements.entries()) {
          this.statement(statement, pointer('layers', i, 'statements', j));
        }
        for (const [j, report] of layer.relations.entries()) {
          this.relation(report.id, pointer('layers', i, 'relations', j, 'id'));
        }
      }
      return { ok: true, value: { program: this.program, amounts: this.amounts } as unknown as CheckedProgram };
    } catch (thrown) {
      if (thrown instanceof Fault) return { ok: false, error: thrown.error };
      throw thrown;
    }
  }

  private refuse(place: string, cause: string, fix: string): never {
    throw new Fault({ stage: format.stage, place, cause, fix });
  }

  private parameter(parameter: Program['layers'][number]['parameter'], place: string): void {
    const { name, min, max, value } = parameter;
    if (this.ranges.has(name)) {
      this.refuse(
        `${place}/name`,
        `the parameter ${quote(name)} occurs twice`,
        'give each layer a parameter of its own',
      );
    }
    if (!(min <= value && value <= max && min <= 0 && 0 <= max)) {
      this.refuse(
        place,
        `min ${min}, value ${value}, max ${max} are out of order`,
        'let min <= value <= max and include 0, the shape at rest',
      );
    }
    this.ranges.set(name, { min, max });
  }

  private statement(statement: Statement, place: string): void {
    for (const [i, id] of (statement.why?.relations ?? []).entries()) this.relation(id, `${place}/why/relations/${i}`);
    if (statement.op === 'keep_fixed') {
      this.part(statement.part, `${place}/part`);
    } else if (isGeometric(statement)) {
      this.part(statement.part, `${place}/part`);
      const group = this.groupOf.get(this.parts.get(statement.part));
      if (group !== undefined && this.recounted.has(group)) {
        this.refuse(
          `${place}/part`,
          `${quote(statement.part)} is an instance of ${group}, whose count has been changed before`,
          'edit the instance in an earlier layer, or the whole group',
        );
      }
      for (const key of ['origin', 'direction', 'axis', 'normal'] as const) {
        this.reference(
          (statement as Partial<Record<typeof key, PointReference | DirectionReference>>)[key],
          `${place}/${key}`,
        );
      }
      this.amount(statement.amount, `${place}/amount`);
    } else {
      const relation = this.relation(statement.relation, `${place}/relation`);
      if (!isGroup(relation)) {
        this.refuse(
          `${place}/relation`,
          `${quote(relation.id)} is a ${relation.kind} relation, ${statement.op} needs a group`,
          'name a translation or rotation relation',
        );
      }
      const expression = this.amount(statement.amount, `${place}/amount`);
      if (statement.op === 'change_count') {
        this.domain(expression, maxInstances, `${place}/amount`);
        this.recounted.add(relation.id);
      }
    }
  }

  private part(id: string, place: string): void {
    if (!this.parts.has(id)) this.refuse(place, `the part ${quote(id)} is unknown`, 'name a part of this shape');
  }

  private relation(id: string, place: string): CageRelation {
    const relation = this.relations.get(id);
    if (!relation) this.refuse(place, `the relation ${quote(id)} is unknown`, 'name a relation of this shape');
    return relation;
  }

  private reference(reference: PointReference | DirectionReference | undefined, place: string): void {
    if (reference && 'part' in reference) this.part(reference.part, `${place}/part`);
  }

  private amount(text: string, place: string): Expression {
    const known = this.amounts.get(text);
    if (known) return known;
    const parsed = parseAmount(text);
    if (!parsed.ok) this.refuse(`${place}, ${parsed.error.place}`, parsed.error.cause, parsed.error.fix);
    for (const name of parametersOf(parsed.value)) {
      if (this.ranges.has(name)) continue;
      const fix = `use ${[...this.ranges.keys()].slice(0, 5).join(', ')}`;
      this.refuse(place, `the amount names an unknown parameter ${quote(name)}`, fix);
    }
    this.domain(parsed.value, maxMagnitude, place);
    this.amounts.set(text, parsed.value);
    return parsed.value;
  }

  private domain(expression: Expression, magnitude: number, place: string): void {
    const fault = findDomainFault(expression, this.ranges, this.budget, magnitude);
    if (this.budget.nodes < 0) this.refuse(place, 'the amounts are too many or too long to check', 'shorten them');
    if (!fault) return;
    const where = [...fault.at].map(([name, value]) => `${name} = ${Number(value.toPrecision(6))}`).join(', ');
    this.refuse(
      `${place}, column ${fault.column}`,
      `${fault.cause} occurs${where === '' ? '' : ` at ${where}`}`,
      'narrow the range or change the amount',
    );
  }
}
