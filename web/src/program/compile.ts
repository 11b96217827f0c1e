// A checked program compiled for one shape: what the slider calls on every frame. Everything is laid out once; evaluate()
// runs closures over flat arrays, calls no solver, and allocates nothing unless a group outgrows its buffer.
//
// Per frame: all amounts (they depend on the parameters alone), then layer by layer the references that can have moved,
// then the layer's statements. Not kept: a copy of the state after each layer, to start from the layer whose slider
// moves. At 100 parts and 200 statements a whole evaluation takes about 0.05 ms of the half millisecond there is.
import type { CheckedProgram } from './check';
import { type CompiledAmounts, compileAmounts } from './compile_amounts';
import { writeAxis } from './compile_cage';
import { CompiledGroup, type GroupView } from './compile_groups';
import {
  applyMap,
  compileMap,
  directionAt,
  featureMask,
  mapSize,
  normalAt,
  originAt,
  referenceSize,
} from './compile_operators';
import { parametersOf } from './domain';
import type { Expression } from './parse';
import { partIndex } from './part_index';
import {
  type CageShape,
  type DirectionReference,
  type GeometricStatement,
  type GroupStatement,
  isGeometric,
  isGroup,
  type LocalTriple,
  type Parameter,
  type PointReference,
  type Statement,
} from './types';

export { at as groupPointAt, type GroupView } from './compile_groups';

export interface Evaluator {
  /** Of the layers, in order. */
  readonly parameters: readonly Parameter[];
  /** Corners of every part after evaluate(), part × 24 in the shape's order; at rest before. Always the same array. */
  readonly corners: Float64Array;
  /** By relation index; null for relations that are no group. */
  readonly groups: readonly (GroupView | null)[];
  /** Indices of the parts that the program can move; all others stay at rest. */
  readonly movingParts: readonly number[];
  /** Evaluates at values[i] of layer i's parameter. The caller keeps them in the parameter's range. */
  evaluate(values: ArrayLike<number>): void;
}

/** Compiles a program for the shape that it was checked against. */
export function compileProgram({ program, amounts }: CheckedProgram, shape: CageShape): Evaluator {
  const parameters = program.layers.map((layer) => layer.parameter);
  const names = parameters.map((parameter) => parameter.name);
  return new Compiler(shape, compileAmounts(amounts, names), parameters, program.layers).evaluator;
}

/**
 * One amount as a function of parameter values in the order of `names`, which must hold every parameter that occurs.
 * NaN where it is undefined.
 */
export function compileAmount(expression: Expression, names: readonly string[]): (values: ArrayLike<number>) => number {
  const unknown = [...parametersOf(expression)].filter((name) => !names.includes(name));
  if (unknown.length > 0) throw new Error(`the amount names ${unknown.join(', ')}, which has no value`);
  const compiled = compileAmounts(new Map([['', expression]]), names);
  const slot = compiled.valueSlotOf('');
  return (values) => {
    for (let i = 0; i < names.length; ++i) compiled.slots[i] = values[i] ?? Number.NaN;
    compiled.evaluate();
    return compiled.slots[slot] as number;
  };
}

class Compiler {
  readonly evaluator: Evaluator;
  private readonly rest: Float64Array;
  private readonly corners: Float64Array;
  private readonly index: ReadonlyMap<string, number>;
  private readonly groups: (CompiledGroup | null)[];
  private readonly groupOfParent = new Map<number, CompiledGroup>();
  private readonly memberOf = new Map<number, { group: CompiledGroup; number: number }>();
  private readonly moving = new Set<number>();
  private readonly map = new Float64Array(mapSize);
  private readonly references: Float64Array;
  private used = 0;

  constructor(
    shape: CageShape,
    private readonly amounts: CompiledAmounts,
    parameters: readonly Parameter[],
    layers: readonly { readonly statements: readonly Statement[] }[],
  ) {
    this.rest = Float64Array.from(shape.parts.flatMap((part) => part.corners.flat()));
    this.corners = this.rest.slice();
    this.index = partIndex(shape);
    this.groups = shape.relations.map((relation) => {
      if (!isGroup(relation)) return null;
      const layout = { parent: this.find(relation.parent), members: relation.parts.map((id) => this.find(id)) };
      const group = new CompiledGroup(relation, layout, this.corners);
      this.groupOfParent.set(layout.parent, group);
      for (const [number, member] of layout.members.entries()) this.memberOf.set(member, { group, number });
      return group;
    });
    const relationIndex = new Map(shape.relations.map((relation, i) => [relation.id, i]));
    const active = layers.map((layer) => layer.statements.filter((statement) => this.isActive(statement)));
    this.references = new Float64Array(referenceSize * active.flat().length);

    const steps: (() => void)[] = [];
    for (const statements of active) {
      // Two passes, because references mean the state at the start of the layer.
      const first = this.used;
      for (const statement of statements) {
        if (isGeometric(statement)) steps.push(...this.compileReferences(statement, this.allocate()));
      }
      const touched = new Set<CompiledGroup>();
      let next = first;
      for (const statement of statements) {
        if (isGeometric(statement)) {
          steps.push(this.compileGeometric(statement, next, touched));
          next += referenceSize;
        } else if (statement.op !== 'keep_fixed') {
          const group = this.groups[relationIndex.get(statement.relation) ?? -1];
          if (group) steps.push(this.compileGroupEdit(statement, group, touched));
        }
      }
      for (const group of touched) steps.push(() => group.writeMembers());
    }
    this.evaluator = this.assemble(parameters, steps);
  }

  private assemble(parameters: readonly Parameter[], steps: readonly (() => void)[]): Evaluator {
    const { amounts, corners, rest, groups } = this;
    const live = groups.filter((group) => group !== null);
    return {
      parameters,
      corners,
      groups,
      movingParts: [...this.moving].sort((a, b) => a - b),
      evaluate(values) {
        for (let i = 0; i < parameters.length; ++i) amounts.slots[i] = values[i] ?? 0;
        amounts.evaluate();
        corners.set(rest);
        for (let i = 0; i < live.length; ++i) (live[i] as CompiledGroup).reset();
        for (let i = 0; i < steps.length; ++i) (steps[i] as () => void)();
      },
    };
  }

  /** A count changes by floor(a) and a spacing by a, so that an amount of 0 is no change for any operator. */
  private isActive(statement: Statement): boolean {
    if (statement.op === 'keep_fixed') return false;
    const { amounts } = this;
    return !(amounts.isConstant(statement.amount) && amounts.slots[amounts.slotOf(statement.amount)] === 0);
  }

  private find(id: string): number {
    const found = this.index.get(id);
    if (found === undefined) throw new Error(`the shape has no part ${id}: the program was checked for another`);
    return found;
  }

  private allocate(): number {
    const offset = this.used;
    this.used += referenceSize;
    return offset;
  }

  // -------------------------------------------------------------------------------------------------- references

  /** Fills in what is constant; returns the steps that read the rest off the state at the start of the layer. */
  private compileReferences(statement: GeometricStatement, offset: number): (() => void)[] {
    const steps: (() => void)[] = [];
    const origin = 'origin' in statement ? statement.origin : null;
    const direction =
      statement.op === 'rotate' ? statement.axis : 'direction' in statement ? statement.direction : null;
    const normal = 'normal' in statement ? statement.normal : null;
    if (origin) steps.push(...this.compilePoint(origin, offset + originAt));
    if (direction) steps.push(...this.compileDirection(direction, offset + directionAt));
    if (normal) steps.push(...this.compileDirection(normal, offset + normalAt));
    return steps;
  }

  private compilePoint(reference: PointReference, to: number): (() => void)[] {
    if (!('part' in reference)) {
      this.references.set(reference, to);
      return [];
    }
    const part = this.find(reference.part);
    return this.onceOrAlways(part, pointReader(this.corners, 24 * part, reference.at, this.references, to));
  }

  private compileDirection(reference: DirectionReference, to: number): (() => void)[] {
    const { references, corners } = this;
    if (!('part' in reference)) {
      const length = Math.hypot(...reference);
      for (const [i, x] of reference.entries()) references[to + i] = x / length;
      return [];
    }
    const part = this.find(reference.part);
    const { axis } = reference;
    return this.onceOrAlways(part, () => {
      writeAxis(corners, 24 * part, axis, references, to);
    });
  }

  /** A part that no layer before this one moves is read now, at rest, and never again. */
  private onceOrAlways(part: number, step: () => void): (() => void)[] {
    if (this.moving.has(part)) return [step];
    step();
    return [];
  }

  // -------------------------------------------------------------------------------------------------- statements

  private compileGeometric(statement: GeometricStatement, offset: number, touched: Set<CompiledGroup>): () => void {
    const { map, corners, amounts } = this;
    const part = this.find(statement.part);
    const mask = featureMask(statement.feature);
    const slot = amounts.slotOf(statement.amount);
    const fillMap = compileMap(statement, map, amounts.slots, slot, this.references, offset);
    const parentOf = this.groupOfParent.get(part);
    if (parentOf) {
      this.touch(parentOf, touched);
      return () => {
        fillMap();
        parentOf.moveParent(map, mask);
      };
    }
    const member = this.memberOf.get(part);
    if (member) {
      const { group, number } = member;
      this.touch(group, touched);
      return () => {
        fillMap();
        group.moveMember(number, map, mask);
      };
    }
    this.moving.add(part);
    const start = 24 * part;
    return () => {
      fillMap();
      applyMap(map, corners, start, 8, mask);
    };
  }

  private compileGroupEdit(statement: GroupStatement, group: CompiledGroup, touched: Set<CompiledGroup>): () => void {
    const { slots } = this.amounts;
    const slot = this.amounts.slotOf(statement.amount);
    const { anchor } = statement;
    this.touch(group, touched);
    if (statement.op === 'change_count') return () => group.changeCount(anchor, slots, slot);
    return () => group.changeDelta(anchor, slots, slot);
  }

  private touch(group: CompiledGroup, touched: Set<CompiledGroup>): void {
    touched.add(group);
    for (const part of [group.layout.parent, ...group.layout.members]) this.moving.add(part);
  }
}

/** A step that writes the feature point of a part's corners, corners[from …], to out[to … to + 2]. */
function pointReader(
  corners: Float64Array,
  from: number,
  point: LocalTriple,
  out: Float64Array,
  to: number,
): () => void {
  const mask = featureMask(point);
  const selected = [0, 1, 2, 3, 4, 5, 6, 7].filter((k) => (mask >> k) & 1);
  return () => {
    for (let i = 0; i < 3; ++i) {
      let sum = 0;
      for (let j = 0; j < selected.length; ++j) sum += corners[from + 3 * (selected[j] as number) + i] as number;
      out[to + i] = sum / selected.length;
    }
  };
}
