// The edit language in words: what statements do, why they are there, what relations say.

import { compileAmount } from '../program/compile';
import { parametersOf } from '../program/domain';
import { parseAmount } from '../program/parse';
import {
  type DirectionReference,
  type GroupRelation,
  isGroup,
  type LocalTriple,
  type PointReference,
  type RelationReport,
  type Shape,
  type ShapeRelation,
  type Statement,
  type Vec3,
} from '../program/types';
import { type Document, nameOf } from '../session/document';
import { mostAlong } from '../session/measure';

const sides = [
  ['right', 'left'],
  ['bottom', 'top'],
  ['back', 'front'],
] as const;
const ways = [
  ['to its right', 'to its left'],
  ['down', 'up'],
  ['backwards', 'forwards'],
] as const;
export const axisWords = ['left–right', 'up–down', 'front–back'] as const;
export const lengthWords = ['width', 'height', 'depth'] as const;
const featureKinds = ['whole', 'face', 'edge', 'corner'] as const;
export type FeatureKind = (typeof featureKinds)[number];

export const featureKind = (feature: LocalTriple): FeatureKind =>
  featureKinds[feature.filter((sign) => sign !== 0).length] ?? 'whole';

/** All 27, the whole first, then faces, edges, corners. */
export const allFeatures: readonly LocalTriple[] = [-1, 0, 1]
  .flatMap((y) => [-1, 0, 1].flatMap((z) => [-1, 0, 1].map((x) => [x, -y, -z] as unknown as LocalTriple)))
  .sort((a, b) => featureKinds.indexOf(featureKind(a)) - featureKinds.indexOf(featureKind(b)));

/** "top", "top left edge", "top front left corner"; "centre" for the whole. */
export function featureWords(feature: LocalTriple): string {
  const words = [1, 2, 0].flatMap((axis) => {
    const sign = feature[axis];
    return sign ? [sides[axis]?.[sign < 0 ? 0 : 1] ?? ''] : [];
  });
  const kind = featureKind(feature);
  return kind === 'whole' ? 'centre' : kind === 'face' ? (words[0] ?? '') : `${words.join(' ')} ${kind}`;
}

function vectorOf(shape: Shape, reference: DirectionReference): Vec3 {
  if (!('part' in reference)) return reference;
  return shape.parts.find(({ id }) => id === reference.part)?.axes[reference.axis] ?? [1, 0, 0];
}

const isStraight = (v: Vec3) => Math.max(...v.map(Math.abs)) > 0.98 * Math.hypot(...v);

/** Whether an amount falls as its parameter grows from 0, so that its direction reads the other way round. */
function falls(amount: string): boolean {
  const parsed = parseAmount(amount);
  if (!parsed.ok) return false;
  const names = [...parametersOf(parsed.value)];
  const at = compileAmount(parsed.value, names);
  return at(names.map(() => 1e-3)) < at(names.map(() => 0));
}

/** "up", "to its left", "at an angle": the way in which a growing slider moves. */
function wayWords(v: Vec3, amount: string): string {
  const axis = mostAlong(v);
  const way = ways[axis]?.[v[axis] < 0 !== falls(amount) ? 0 : 1] ?? '';
  return isStraight(v) ? way : `${way}, at an angle`;
}

function fromWords(document: Document, part: string, origin: PointReference): string {
  if (!('part' in origin)) return '';
  const at = featureWords(origin.at);
  if (origin.part === part) return at === 'centre' ? 'about its centre' : `from its ${at}`;
  return `about the ${at} of ${nameOf(document, origin.part)}`;
}

export const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** What a statement does, as a sentence without a full stop. */
export function statementWords(document: Document, statement: Statement): string {
  const shape = document.model?.shape;
  if (shape === undefined) return statement.op;
  if ('relation' in statement) {
    const relation = groupOf(document, statement.relation);
    const group = relation ? nameOf(document, relation.parent) : statement.relation;
    if (statement.op === 'change_delta') return `${capital(group)}: the spacing changes`;
    const how = statement.anchor === 'fit' ? 'within the same space' : 'with the same spacing';
    return `${capital(group)}: more or fewer, ${how}`;
  }
  const part = nameOf(document, statement.part);
  if (statement.op === 'keep_fixed') return `${capital(part)} stays as it is`;
  const kind = featureKind(statement.feature);
  const what = kind === 'whole' ? capital(part) : `${capital(featureWords(statement.feature))} of ${part}`;
  switch (statement.op) {
    case 'translate':
      return `${what} moves ${wayWords(vectorOf(shape, statement.direction), statement.amount)}`;
    case 'rotate': {
      const axis = axisWords[mostAlong(vectorOf(shape, statement.axis))];
      return `${what} tilts about its ${axis} axis, ${fromWords(document, statement.part, statement.origin)}`;
    }
    case 'scale_1d': {
      const along = axisWords[mostAlong(vectorOf(shape, statement.direction))];
      return `${what} stretches ${along}, ${fromWords(document, statement.part, statement.origin)}`;
    }
    case 'scale_2d': {
      const across = axisWords[mostAlong(vectorOf(shape, statement.normal))];
      return `${what} grows in both directions across ${across}`;
    }
    case 'scale_3d':
      return `${what} grows in all directions, ${fromWords(document, statement.part, statement.origin)}`;
    case 'shear':
      return `${what} slants ${wayWords(vectorOf(shape, statement.direction), statement.amount)}`;
  }
}

function groupOf(document: Document, id: string): GroupRelation | undefined {
  return document.model?.shape.relations.filter(isGroup).find((relation) => relation.id === id);
}

/** Ids of the instances of a row or a ring. */
export const groupMembers = (document: Document, id: string): readonly string[] => groupOf(document, id)?.parts ?? [];

/** Why a statement is in the program. */
export function whyWords(document: Document, statement: Statement): string {
  const why = statement.why;
  if (why === undefined) return '';
  const shape = document.model?.shape;
  const own =
    'part' in statement
      ? [statement.part]
      : [groupOf(document, statement.relation)?.parent, ...groupMembers(document, statement.relation)];
  const isTold = ({ kind }: ShapeRelation) =>
    why.kind === 'symmetry' ? kind === 'reflection' : why.kind !== 'attachment' || kind !== 'reflection';
  const others = [
    ...new Set(
      why.relations
        .flatMap((id) => shape?.relations.filter((relation) => relation.id === id && isTold(relation)) ?? [])
        .flatMap(({ parts }) => parts)
        .filter((part) => !own.includes(part)),
    ),
  ].map((id) => nameOf(document, id));
  const list = listWords(others);
  switch (why.kind) {
    case 'seed':
      return 'this is what was asked for';
    case 'symmetry':
      return list ? `mirrors ${list}` : 'keeps the symmetry';
    case 'attachment':
      return list ? `stays joined to ${list}` : 'stays joined';
    case 'neighbour':
      return list ? `follows ${list}` : 'follows its neighbours';
    case 'breaking':
      return 'nothing fits all its relations; this gives up the fewest';
    case 'group':
      return 'part of its row';
  }
}

export function listWords(names: readonly string[], most = 3, count = names.length): string {
  const shown = names.slice(0, most);
  const rest = count - shown.length;
  if (rest > 0) return `${shown.join(', ')} and ${rest} more`;
  const last = shown.pop();
  return shown.length > 0 ? `${shown.join(', ')} and ${last}` : (last ?? '');
}

const joints = { point: 'at a point', line: 'along a line', face: 'by a face', volume: 'inside' } as const;

/** "by a face"; empty for what is no joint. */
export const jointWords = ({ kind }: ShapeRelation): string =>
  kind in joints ? joints[kind as keyof typeof joints] : '';

/** @param from reads the relation from this part's side: "joined to front left leg at a point" */
export function relationWords(document: Document, relation: ShapeRelation, from?: string): string {
  const [a = '', b = ''] = relation.parts.map((id) => nameOf(document, id));
  const other = from !== undefined && from === relation.parts[1] ? a : b;
  if (relation.kind === 'ground') return from === undefined ? `${a} stands on the floor` : 'stands on the floor';
  if (relation.kind === 'reflection') return from === undefined ? `${a} mirrors ${b}` : `mirrors ${other}`;
  if (isGroup(relation)) {
    const group = nameOf(document, relation.parent);
    return `${group}: ${relation.parts.length} ${relation.kind === 'translation' ? 'evenly spaced' : 'in a ring'}`;
  }
  if (from !== undefined) return `joined to ${other} ${joints[relation.kind]}`;
  return `${a} and ${b} joined ${joints[relation.kind]}`;
}

/** "keeps 23 of 24 relations at every position". */
export function keptWords(reports: readonly RelationReport[]): string {
  const counted = reports.filter(({ status }) => status !== 'disabled');
  const held = counted.filter(({ status }) => status === 'held');
  if (counted.length === 0) return '';
  const all = held.length === counted.length;
  if (all && held.length === 1) return 'keeps its one relation at every position';
  const kept = all ? `all ${held.length}` : `${held.length} of ${counted.length}`;
  return `keeps ${kept} ${counted.length === 1 ? 'relation' : 'relations'} at every position`;
}

export const hintWords = {
  translate: 'should move',
  rotate: 'should tilt',
  scale: 'should stretch',
  shear: 'should slant',
  change_count: 'should change its count',
  change_delta: 'should change its spacing',
  keep_fixed: 'should stay',
} as const;
