// The formats `parsel/program` v1 and `parsel/shape` v1 as types, and how the steps of this folder report refusals.
//
// The same formats are read and written by core/edit/program.h and core/shape/shape.h.

/** Where an input was refused, why, and what to do about it. Clauses without a full stop. */
export interface ProgramError {
  /** Folder and step that refused: "program/check". */
  readonly stage: string;
  /** Where in the input: "column 7", or a JSON pointer "/layers/0/statements/3/amount"; empty for the whole of it. */
  readonly place: string;
  readonly cause: string;
  readonly fix: string;
}

/** An expected failure is a value. */
export type Result<T> = { readonly ok: true; readonly value: T } | { readonly ok: false; readonly error: ProgramError };

/** One line for people: "program/check: /layers: too many layers; remove some." */
export function errorMessage(error: ProgramError): string {
  const place = error.place === '' ? '' : `${error.place}: `;
  return `${error.stage}: ${place}${error.cause}; ${error.fix}.`;
}

/** Normalised frame: the shape's bounding box is centred at the origin and its half-diagonal is 1. */
export type Vec3 = readonly [number, number, number];

/**
 * A point of a hexahedron, or the feature that an operator acts on: (0,0,0) is the centre or the whole part, one
 * non-zero a face, two an edge, three a corner.
 */
export type Sign = -1 | 0 | 1;
export type LocalTriple = readonly [Sign, Sign, Sign];
export type Axis = 0 | 1 | 2;

// ---------------------------------------------------------------------------------------------------- parsel/shape

/** Corner k has local signs (k&1, k&2, k&4) → ±1 along local axes 0, 1, 2. */
export type Corners = readonly Vec3[];

export interface ShapePart {
  readonly id: string;
  readonly label: string;
  readonly name: string;
  /** glTF node index, -1 for a virtual part. */
  readonly node: number;
  readonly primitive: number;
  readonly corners: Corners;
  readonly axes: readonly [Vec3, Vec3, Vec3];
  readonly virtual: boolean;
  /** Ids of the instances of a virtual part, in the group's order. */
  readonly members: readonly string[];
  /** Id of the translation or rotation relation that the part is an instance of or, virtual, stands for. */
  readonly group?: string;
}

interface RelationBase {
  readonly id: string;
  readonly parts: readonly string[];
}
export interface ReflectionRelation extends RelationBase {
  readonly kind: 'reflection';
  readonly origin: Vec3;
  readonly normal: Vec3;
  /** Corner k of the second part is the mirror image of corner corner_map[k] of the first. */
  readonly corner_map: readonly number[];
  /** One above the other: a change of height need not mirror. */
  readonly stacked?: true;
}
/** Instances at equal distances; start and end are the centres of the first and the last. */
export interface TranslationRelation extends RelationBase {
  readonly kind: 'translation';
  readonly parent: string;
  readonly start: Vec3;
  readonly end: Vec3;
  /** Local axis of the parent that the instances follow, and whether they run along + or - of it. */
  readonly axis: Axis;
  readonly direction: -1 | 1;
  /** Each instance touches the next. */
  readonly touching?: true;
}
/** A closed ring of instances: number k is number 0 turned by k · 2π/count. */
export interface RotationRelation extends RelationBase {
  readonly kind: 'rotation';
  readonly parent: string;
  readonly centre: Vec3;
  readonly axis: Vec3;
  readonly parent_axis: Axis;
  readonly radius: number;
}
export interface AttachmentRelation extends RelationBase {
  readonly kind: 'point' | 'line' | 'face' | 'volume';
  readonly points: readonly Vec3[];
  /** The same points in local coordinates of the first and of the second part. */
  readonly local_a: readonly Vec3[];
  readonly local_b: readonly Vec3[];
  /** Where the parts touch: a rectangle by its centre, its normal out of the first part, and half its sides. */
  readonly patch?: {
    readonly centre: Vec3;
    readonly normal: Vec3;
    readonly half_sides: readonly [Vec3, Vec3];
    /** Its corners in local coordinates of each part. */
    readonly local_a: readonly Vec3[];
    readonly local_b: readonly Vec3[];
  };
}
/** Its one part stands on the floor: these points keep their height. */
export interface GroundRelation extends RelationBase {
  readonly kind: 'ground';
  readonly points: readonly Vec3[];
  /** The same points in local coordinates of the part. */
  readonly local: readonly Vec3[];
}
export type GroupRelation = TranslationRelation | RotationRelation;
export type ShapeRelation = ReflectionRelation | GroupRelation | AttachmentRelation | GroundRelation;

export interface Shape {
  readonly format: 'parsel/shape';
  readonly version: 1;
  readonly name: string;
  /** Of the model file's bytes, lower-case hex. */
  readonly sha256: string;
  /** `axes`: the normalised axes as rows in the file's coordinates, where the model does not stand along the file's. */
  readonly frame: { readonly centre: Vec3; readonly scale: number; readonly axes?: readonly [Vec3, Vec3, Vec3] };
  readonly parts: readonly ShapePart[];
  readonly relations: readonly ShapeRelation[];
  readonly warnings: readonly { readonly place: string; readonly text: string }[];
}

/** A part as evaluation and drawing see it: its hexahedron, and the mesh that rides in it. */
export type CagePart = Pick<ShapePart, 'id' | 'node' | 'primitive' | 'corners' | 'virtual'>;
/** A relation of which no more is known than what it is about. */
export interface NamedRelation extends RelationBase {
  readonly kind: string;
}
export type CageRelation = ShapeRelation | NamedRelation;

/** What evaluating a program and drawing the result need of a shape, and what travels with a program (sliders.ts). */
export interface CageShape extends Pick<Shape, 'name' | 'sha256' | 'frame'> {
  readonly parts: readonly CagePart[];
  readonly relations: readonly CageRelation[];
}

export function isGroup(relation: CageRelation): relation is GroupRelation {
  return 'parent' in relation && (relation.kind === 'translation' || relation.kind === 'rotation');
}
export function isReflection(relation: CageRelation): relation is ReflectionRelation {
  return 'normal' in relation && relation.kind === 'reflection';
}
export function isAttachment(relation: CageRelation): relation is AttachmentRelation {
  return 'points' in relation;
}

// -------------------------------------------------------------------------------------------------- parsel/program

/** A feature point of a part, on its state at the start of the layer. */
export interface PartPoint {
  readonly part: string;
  readonly at: LocalTriple;
}
/** From the part's - face centre to its + face centre along a local axis, at the start of the layer. */
export interface PartAxis {
  readonly part: string;
  readonly axis: Axis;
}
export type PointReference = Vec3 | PartPoint;
export type DirectionReference = Vec3 | PartAxis;

export const whyKinds = ['seed', 'symmetry', 'attachment', 'neighbour', 'breaking', 'group'] as const;
/** What made propagation add a statement. */
export interface Why {
  readonly kind: (typeof whyKinds)[number];
  readonly relations: readonly string[];
}

interface StatementBase {
  readonly why?: Why;
}
interface GeometricBase extends StatementBase {
  readonly part: string;
  readonly feature: LocalTriple;
  /** Closed-form expression of the parameters: lengths (translate), radians (rotate) or a ratio. */
  readonly amount: string;
}
export interface Translate extends GeometricBase {
  readonly op: 'translate';
  readonly direction: DirectionReference;
}
export interface Rotate extends GeometricBase {
  readonly op: 'rotate';
  readonly origin: PointReference;
  readonly axis: DirectionReference;
}
export interface Scale1d extends GeometricBase {
  readonly op: 'scale_1d';
  readonly origin: PointReference;
  readonly direction: DirectionReference;
}
export interface Scale2d extends GeometricBase {
  readonly op: 'scale_2d';
  readonly origin: PointReference;
  readonly normal: DirectionReference;
}
export interface Scale3d extends GeometricBase {
  readonly op: 'scale_3d';
  readonly origin: PointReference;
}
export interface Shear extends GeometricBase {
  readonly op: 'shear';
  readonly origin: PointReference;
  readonly normal: DirectionReference;
  readonly direction: DirectionReference;
}
export type GeometricStatement = Translate | Rotate | Scale1d | Scale2d | Scale3d | Shear;

export const anchors = ['start', 'middle', 'end', 'fit'] as const;
/** Which instance of a group stays, or that its extent stays. */
export type Anchor = (typeof anchors)[number];
export interface GroupStatement extends StatementBase {
  readonly op: 'change_count' | 'change_delta';
  readonly relation: string;
  readonly anchor: Anchor;
  readonly amount: string;
}
export interface KeepFixed extends StatementBase {
  readonly op: 'keep_fixed';
  readonly part: string;
}
export type Statement = GeometricStatement | GroupStatement | KeepFixed;

export interface Parameter {
  readonly name: string;
  readonly min: number;
  readonly max: number;
  readonly value: number;
}

export interface RelationReport {
  readonly id: string;
  readonly status: 'held' | 'broken' | 'disabled';
  /** Largest deviation of a coordinate over the parameter's range, normalised. */
  readonly worst: number;
  readonly proof: 'certified' | 'sampled';
  /** When sampled: at how many values of the parameter, if known. */
  readonly samples?: number;
}

/** Layers run in order; a part edited by one is the input of the next (paper §8.1). */
export interface Layer {
  readonly request: string;
  readonly parameter: Parameter;
  readonly statements: readonly Statement[];
  readonly relations: readonly RelationReport[];
}

export interface Program {
  readonly format: 'parsel/program';
  readonly version: 1;
  readonly shape: { readonly name: string; readonly sha256: string };
  readonly layers: readonly Layer[];
}

export function isGeometric(statement: Statement): statement is GeometricStatement {
  return statement.op !== 'change_count' && statement.op !== 'change_delta' && statement.op !== 'keep_fixed';
}

/** Most instances that a group may grow to; the evaluators clamp to it. */
export const maxInstances = 1000;
