// Seeded shapes and programs for tests and benchmarks: the same seed gives the same shape and program everywhere.
import type {
  Anchor,
  Axis,
  Corners,
  DirectionReference,
  GroupRelation,
  LocalTriple,
  PointReference,
  Program,
  Shape,
  ShapePart,
  ShapeRelation,
  Sign,
  Statement,
  Vec3,
} from '../../web/src/program/types';
import { anchors, isGroup, whyKinds } from '../../web/src/program/types';

/** mulberry32 (Tommy Ettinger): 32 bits of state, the same on every machine. */
export class Random {
  constructor(private state: number) {}

  /** Uniform in [0, 1). */
  unit(): number {
    this.state = (this.state + 0x6d2b79f5) | 0;
    let t = Math.imul(this.state ^ (this.state >>> 15), 1 | this.state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  }
  uniform(low: number, high: number): number {
    return low + (high - low) * this.unit();
  }
  /** Uniform in 0 … bound - 1. */
  below(bound: number): number {
    return Math.floor(bound * this.unit());
  }
  pick<T>(list: readonly T[]): T {
    const found = list[this.below(list.length)];
    if (found === undefined) throw new Error('nothing to pick from');
    return found;
  }
  vector(size: number): Vec3 {
    return [this.uniform(-size, size), this.uniform(-size, size), this.uniform(-size, size)];
  }
}

// ------------------------------------------------------------------------------------------------------------ shapes

type Axes = readonly [Vec3, Vec3, Vec3];
const globalAxes: Axes = [
  [1, 0, 0],
  [0, 1, 0],
  [0, 0, 1],
];

function boxCorners(centre: Vec3, axes: Axes, half: Vec3): Corners {
  return Array.from({ length: 8 }, (_, k): Vec3 => {
    const component = (i: 0 | 1 | 2) =>
      axes.reduce((sum, axis, j) => sum + ((k >> j) & 1 ? 1 : -1) * (half[j] ?? 0) * axis[i], centre[i]);
    return [component(0), component(1), component(2)];
  });
}

/** Right-handed axes turned by a random angle about a random global axis. */
function randomAxes(random: Random): Axes {
  const angle = random.uniform(-0.6, 0.6);
  const fixed = random.below(3);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const turned = globalAxes.map((axis): Vec3 => {
    const [i, j] = [(fixed + 1) % 3, (fixed + 2) % 3];
    const out = [...axis] as [number, number, number];
    out[i] = c * (axis[i] ?? 0) - s * (axis[j] ?? 0);
    out[j] = s * (axis[i] ?? 0) + c * (axis[j] ?? 0);
    return out;
  });
  return turned as unknown as Axes;
}

export interface ShapeSize {
  /** Parts that are in no group. */
  readonly loose: number;
  readonly rows: number;
  readonly rings: number;
}
export const defaultShapeSize: ShapeSize = { loose: 4, rows: 1, rings: 1 };

/** Turned boxes, translation groups and rotation groups with their parents, in the normalised frame. */
export function randomShape(seed: number, size: ShapeSize = defaultShapeSize): Shape {
  const random = new Random(seed);
  const parts: ShapePart[] = [];
  const relations: ShapeRelation[] = [];
  const addPart: AddPart = (id, corners, axes, group, members = []) => {
    const virtual = members.length > 0;
    const place = virtual ? { node: -1, primitive: -1 } : { node: 2 * parts.length + 1, primitive: 0 };
    parts.push({ id, label: id, name: id, ...place, corners, axes, virtual, members, ...(group ? { group } : {}) });
    return id;
  };
  const half = (): Vec3 => [random.uniform(0.05, 0.4), random.uniform(0.05, 0.4), random.uniform(0.05, 0.4)];

  for (let i = 0; i < size.loose; ++i) {
    const axes = randomAxes(random);
    addPart(`part_${i}`, boxCorners(random.vector(0.6), axes, half()), axes);
  }
  for (let r = 0; r < size.rows; ++r) relations.push(addRow(random, r, addPart));
  for (let r = 0; r < size.rings; ++r) relations.push(addRing(random, r, addPart));
  const [a, b] = parts;
  if (a && b && size.loose >= 2) {
    const image = mirrored(a);
    parts[1] = { ...b, ...image };
    relations.push({ id: 'r1', kind: 'reflection', parts: [a.id, b.id], ...mirrorPlane });
    const [points, local_a, local_b] = [
      [a.corners[0] ?? noVector],
      [[-1, -1, -1] as const],
      [localPoint(image, a.corners[0] ?? noVector)],
    ];
    relations.push({ id: 'a1', kind: 'point', parts: [a.id, b.id], points, local_a, local_b });
  }
  const frame = { centre: [0, 0, 0] as const, scale: 1 };
  const sha256 = '0'.repeat(64);
  return { format: 'parsel/shape', version: 1, name: `random ${seed}`, sha256, frame, parts, relations, warnings: [] };
}

type AddPart = (id: string, corners: Corners, axes: Axes, group?: string, members?: readonly string[]) => string;

const noVector: Vec3 = [0, 0, 0];
const mirrorPlane = { origin: noVector, normal: [1, 0, 0] as const, corner_map: [1, 0, 3, 2, 5, 4, 7, 6] };

/** The image about the plane x = 0, its first axis turned round so that the axes stay right-handed. */
function mirrored({ corners, axes }: Pick<ShapePart, 'corners' | 'axes'>): { corners: Corners; axes: Axes } {
  const image = ([x, y, z]: Vec3): Vec3 => [-x, y, z];
  const [first, second, third] = axes;
  const turned: Vec3 = [first[0], -first[1], -first[2]];
  return {
    corners: mirrorPlane.corner_map.map((from) => image(corners[from] ?? noVector)),
    axes: [turned, image(second), image(third)],
  };
}

/** Local coordinates of a point in a box. */
function localPoint({ corners, axes }: Pick<ShapePart, 'corners' | 'axes'>, point: Vec3): Vec3 {
  const project = (v: Vec3, axis: Vec3) => v.reduce((sum, x, i) => sum + x * (axis[i] ?? 0), 0);
  const local = axes.map((axis, i) => {
    const low = project(corners[0] ?? noVector, axis);
    const high = project(corners[1 << i] ?? noVector, axis);
    return (2 * project(point, axis) - low - high) / (high - low);
  });
  return local as unknown as Vec3;
}

function along(axes: Axes, from: Vec3, local: readonly [number, number, number]): Vec3 {
  const component = (i: 0 | 1 | 2) => axes.reduce((sum, axis, j) => sum + (local[j] ?? 0) * axis[i], from[i]);
  return [component(0), component(1), component(2)];
}

function addRow(random: Random, number: number, addPart: AddPart): GroupRelation {
  const axes = randomAxes(random);
  const axis = random.below(3) as Axis;
  const direction = random.pick([-1, 1] as const);
  const count = 3 + random.below(4);
  const middle = random.vector(0.3);
  const half: [number, number, number] = [random.uniform(0.1, 0.3), random.uniform(0.1, 0.3), random.uniform(0.1, 0.3)];
  half[axis] = 0.04;
  const spacing = random.uniform(0.12, 0.2);
  const place = (k: number): Vec3 => {
    const local: [number, number, number] = [0, 0, 0];
    local[axis] = direction * (k - (count - 1) / 2) * spacing;
    return along(axes, middle, local);
  };
  const id = `t${number + 1}`;
  const members = Array.from({ length: count }, (_, k) =>
    addPart(`row_${number}_${k}`, boxCorners(place(k), axes, half), axes, id),
  );
  const outer: [number, number, number] = [...half];
  outer[axis] = 0.04 + ((count - 1) / 2) * spacing;
  const parent = addPart(`row_${number}`, boxCorners(middle, axes, outer), axes, id, members);
  const [start, end] = [place(0), place(count - 1)];
  return { id, kind: 'translation', parts: members, parent, start, end, axis, direction };
}

function addRing(random: Random, number: number, addPart: AddPart): GroupRelation {
  const axes = randomAxes(random);
  const parentAxis = random.below(3) as Axis;
  const [first, second] = [((parentAxis + 1) % 3) as Axis, ((parentAxis + 2) % 3) as Axis];
  const count = 3 + random.below(4);
  const centre = random.vector(0.3);
  const radius = random.uniform(0.2, 0.4);
  const half: [number, number, number] = [0, 0, 0];
  half[parentAxis] = random.uniform(0.1, 0.3);
  half[first] = 0.05;
  half[second] = 0.03;
  const id = `o${number + 1}`;
  /** Whether the axis points along the parent's own, or against it. */
  const sign = random.pick([-1, 1]);
  const members = Array.from({ length: count }, (_, k) => {
    const angle = (sign * 2 * Math.PI * k) / count;
    const [c, s] = [Math.cos(angle), Math.sin(angle)];
    const outward = along([axes[first], axes[second], axes[parentAxis]], [0, 0, 0], [c, s, 0]);
    const around = along([axes[first], axes[second], axes[parentAxis]], [0, 0, 0], [-s, c, 0]);
    const own: [Vec3, Vec3, Vec3] = [...axes];
    own[first] = outward;
    own[second] = around;
    const at = along([outward, around, axes[parentAxis]], centre, [radius, 0, 0]);
    return addPart(`ring_${number}_${k}`, boxCorners(at, own, half), own, id);
  });
  const outer: [number, number, number] = [radius + 0.05, radius + 0.05, radius + 0.05];
  outer[parentAxis] = half[parentAxis];
  const parent = addPart(`ring_${number}`, boxCorners(centre, axes, outer), axes, id, members);
  const axis = along(
    axes,
    [0, 0, 0],
    globalAxes[parentAxis].map((x) => sign * x) as unknown as [number, number, number],
  );
  return {
    id,
    kind: 'rotation',
    parts: members,
    parent,
    centre,
    axis,
    parent_axis: parentAxis,
    radius,
  };
}

// ---------------------------------------------------------------------------------------------------------- programs

export interface ProgramSize {
  readonly layers: number;
  /** In each layer. */
  readonly statements: number;
  /** Amounts are about this large at most; features of small parts turn inside out beyond 0.3. */
  readonly amount: number;
}
export const defaultProgramSize: ProgramSize = { layers: 3, statements: 8, amount: 0.25 };

const geometricOps = ['translate', 'rotate', 'scale_1d', 'scale_2d', 'scale_3d', 'shear'] as const;

/**
 * A program that passes checkProgram() for the shape: all operators, features, kinds of reference and anchors, over
 * layers with a parameter each, on parts, on parents and members of groups and on the groups themselves.
 */
export function randomProgram(shape: Shape, seed: number, size: ProgramSize = defaultProgramSize): Program {
  const random = new Random(seed);
  const writer = new StatementWriter(shape, random, size);
  const layers = Array.from({ length: size.layers }, (_, i) => {
    const names = Array.from({ length: i + 1 }, (_unused, j) => `x${j + 1}`);
    return {
      request: random.pick(['', 'widen the chair', 'größer: "quoted" \\ and 椅子', 'two\nlines']),
      parameter: { name: `x${i + 1}`, min: -1, max: 1, value: random.pick([0, 0.25, -1]) },
      statements: Array.from({ length: size.statements }, () => writer.statement(names)),
      relations: shape.relations.slice(0, random.below(3)).map((relation) => ({
        id: relation.id,
        status: random.pick(['held', 'broken', 'disabled'] as const),
        worst: random.pick([0, 1.25e-9, 0.03]),
        proof: random.pick(['certified', 'sampled'] as const),
      })),
    };
  });
  return { format: 'parsel/program', version: 1, shape: { name: shape.name, sha256: shape.sha256 }, layers };
}

/** Values of the parameters, inside their ranges. */
export function randomValues(program: Program, random: Random): number[] {
  return program.layers.map(({ parameter }) => random.uniform(parameter.min, parameter.max));
}

class StatementWriter {
  private readonly recounted = new Set<string>();
  private readonly groups: readonly GroupRelation[];

  constructor(
    private readonly shape: Shape,
    private readonly random: Random,
    private readonly size: ProgramSize,
  ) {
    this.groups = shape.relations.filter(isGroup);
  }

  statement(names: readonly string[]): Statement {
    const { random } = this;
    const why = this.why();
    const kind = random.unit();
    if (kind < 0.2 && this.groups.length > 0) {
      const relation = random.pick(this.groups).id;
      const op = random.pick(['change_count', 'change_delta'] as const);
      const anchor: Anchor = random.pick(anchors);
      if (op === 'change_delta')
        return { op, relation, anchor, amount: randomAmount(random, names, this.size.amount), ...why };
      this.recounted.add(relation);
      return { op, relation, anchor, amount: `${randomAmount(random, names, 4)} + 0.37`, ...why };
    }
    const part = this.part();
    if (kind < 0.25) return { op: 'keep_fixed', part, ...why };
    const amount = randomAmount(random, names, this.size.amount);
    const base = { part, feature: this.triple(), amount, ...why };
    const origin = this.point();
    const op = random.pick(geometricOps);
    switch (op) {
      case 'translate':
        return { op, ...base, direction: this.direction() };
      case 'rotate':
        return { op, ...base, origin, axis: this.direction() };
      case 'scale_1d':
        return { op, ...base, origin, direction: this.direction() };
      case 'scale_2d':
        return { op, ...base, origin, normal: this.direction() };
      case 'scale_3d':
        return { op, ...base, origin };
      case 'shear':
        return { op, ...base, origin, normal: this.direction(), direction: this.direction() };
    }
  }

  private why(): Pick<Statement, 'why'> {
    if (this.random.unit() < 0.5) return {};
    const relations = this.shape.relations.slice(0, this.random.below(3)).map((relation) => relation.id);
    return { why: { kind: this.random.pick(whyKinds), relations } };
  }

  /** Any part, parents more often than their share, but no member of a group whose count has changed. */
  private part(): string {
    const parents = this.groups.map((group) => group.parent);
    if (parents.length > 0 && this.random.unit() < 0.2) return this.random.pick(parents);
    const frozen = new Set(this.groups.flatMap((group) => (this.recounted.has(group.id) ? group.parts : [])));
    const part = this.random.pick(this.shape.parts.filter((candidate) => !frozen.has(candidate.id)));
    return part.node >= 0 && this.random.unit() < 0.1 ? `node:${part.node}` : part.id;
  }

  private triple(): LocalTriple {
    const sign = (): Sign => this.random.pick([-1, 0, 0, 1] as const);
    return this.random.unit() < 0.3 ? [0, 0, 0] : [sign(), sign(), sign()];
  }

  private point(): PointReference {
    if (this.random.unit() < 0.4) return this.random.vector(0.7);
    return { part: this.random.pick(this.shape.parts).id, at: this.triple() };
  }

  private direction(): DirectionReference {
    const kind = this.random.unit();
    if (kind < 0.2) return this.random.pick(globalAxes);
    if (kind < 0.5) return this.random.vector(2).map((x) => x + 0.01) as unknown as Vec3;
    return { part: this.random.pick(this.shape.parts).id, axis: this.random.below(3) as Axis };
  }
}

/** An expression that is defined for parameters in [-1, 1] and stays within about ±size; uses the whole grammar. */
export function randomAmount(random: Random, names: readonly string[], size: number): string {
  const factor = random.uniform(0.2, 1) * size * random.pick([-1, 1]);
  return `${factor.toPrecision(random.pick([2, 5, 17]))}*(${tame(random, names, 2)})`;
}

/** Within [-1, 1] for parameters in [-1, 1]. */
function tame(random: Random, names: readonly string[], depth: number): string {
  const x = depth > 0 && random.unit() < 0.6 ? tame(random, names, depth - 1) : random.pick(names);
  const y = random.pick(names);
  return random.pick([
    y,
    y,
    `-(${x})`,
    `+${y}`,
    `(${x} - ${y})/2`,
    `0.5*(${x} + ${y})`,
    `(${x})*${y}`,
    `(${x})^2`,
    `(${x})^3`,
    `abs(${x})`,
    `sin(pi*(${x}))`,
    `cos(2*(${x}))`,
    `tan((${x})/2)`,
    `atan2(${x}, 2.5 + ${y})`,
    `min(${x}, ${y}, 0.3)`,
    `max(${x}, -0.2)`,
    `sqrt(1 - (${x})^2)`,
    `sqrt(2 + ${x}) - 1.2`,
    `(2 + ${x})^0.5 - 1`,
    `(2 + ${x})^-1.5e0`,
    `2^(${x}) - 1`,
    `${y}/(1 + abs(${x}))`,
    `floor(3*(${x}) + 0.37)/4`,
    `x${names.length}^1`,
  ]);
}
