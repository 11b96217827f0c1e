// The edit language in words: what statements do, why they are there, what relations say.

import { compileAmount } from '../program/compile';
import { parametersOf } from '../program/domain';
import type { Hint } from '../program/operators';
import { parseAmount } from '../program/parse';
import {
  type DirectionReference,
  type GroupRelation,
  isAttachment,
  isGroup,
  type LocalTriple,
  type PointReference,
  type RelationReport,
  type Shape,
  type ShapeRelation,
  type Statement,
  type Vec3,
} from '../program/types';
import { type Document, nameOf, type Side } from '../session/document';
import { mostAlong } from '../session/measure';
import { listed, m, plural, type Sentence, t } from '../texts/texts';

const faces = [
  [m`right@face`, m`left@face`],
  [m`bottom@face`, m`top@face`],
  [m`back@face`, m`front@face`],
] as const;
/** "front", as a side of the object. */
export const sideName = (side: Side | 'top' | 'bottom'): string => t(sideNames[side]);
const sideNames = {
  right: faces[0][0],
  left: faces[0][1],
  bottom: faces[1][0],
  top: faces[1][1],
  back: faces[2][0],
  front: faces[2][1],
} as const;
/** Of an edge or a corner: "top left". */
const places = [
  [m`right@edge`, m`left@edge`],
  [m`bottom@edge`, m`top@edge`],
  [m`back@edge`, m`front@edge`],
] as const;
const ways = [
  [m`to its right`, m`to its left`],
  [m`down@moves`, m`up@moves`],
  [m`backwards`, m`forwards`],
] as const;
export const axisWords = [m`left–right`, m`up–down`, m`front–back`] as const;
export const lengthWords = [m`width`, m`height`, m`depth`] as const;
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
  const kind = featureKind(feature);
  const words = [1, 2, 0].flatMap((axis) => {
    const sign = feature[axis];
    const word = sign && (kind === 'face' ? faces : places)[axis]?.[sign < 0 ? 0 : 1];
    return word ? [t(word)] : [];
  });
  switch (kind) {
    case 'whole':
      return t`centre`;
    case 'face':
      return words.join('');
    case 'edge':
      return t`${words.join(' ')} edge`;
    case 'corner':
      return t`${words.join(' ')} corner`;
  }
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
  const way = t(ways[axis][v[axis] < 0 !== falls(amount) ? 0 : 1]);
  return isStraight(v) ? way : t`${way}, at an angle`;
}

function fromWords(document: Document, part: string, origin: PointReference): string {
  if (!('part' in origin)) return '';
  const at = featureWords(origin.at);
  if (origin.part === part) return featureKind(origin.at) === 'whole' ? t`about its centre` : t`from its ${at}`;
  return t`about the ${at} of ${nameOf(document, origin.part)}`;
}

export const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** What a statement does, as a sentence without a full stop. */
export function statementWords(document: Document, statement: Statement): string {
  const shape = document.model?.shape;
  if (shape === undefined) return statement.op;
  if ('relation' in statement) {
    const relation = groupOf(document, statement.relation);
    const group = relation ? nameOf(document, relation.parent) : statement.relation;
    if (statement.op === 'change_delta') return t`${capital(group)}: the spacing changes`;
    return statement.anchor === 'fit'
      ? t`${capital(group)}: more or fewer, within the same space`
      : t`${capital(group)}: more or fewer, with the same spacing`;
  }
  const part = nameOf(document, statement.part);
  if (statement.op === 'keep_fixed') return t`${capital(part)} stays as it is`;
  const kind = featureKind(statement.feature);
  const what = kind === 'whole' ? capital(part) : t`${capital(featureWords(statement.feature))} of ${part}`;
  switch (statement.op) {
    case 'translate':
      return t`${what} moves ${wayWords(vectorOf(shape, statement.direction), statement.amount)}`;
    case 'rotate': {
      const axis = t(axisWords[mostAlong(vectorOf(shape, statement.axis))]);
      return t`${what} tilts about its ${axis} axis, ${fromWords(document, statement.part, statement.origin)}`;
    }
    case 'scale_1d': {
      const along = t(axisWords[mostAlong(vectorOf(shape, statement.direction))]);
      return t`${what} stretches ${along}, ${fromWords(document, statement.part, statement.origin)}`;
    }
    case 'scale_2d': {
      const across = t(axisWords[mostAlong(vectorOf(shape, statement.normal))]);
      return t`${what} grows in both directions across ${across}`;
    }
    case 'scale_3d':
      return t`${what} grows in all directions, ${fromWords(document, statement.part, statement.origin)}`;
    case 'shear':
      return t`${what} slants ${wayWords(vectorOf(shape, statement.direction), statement.amount)}`;
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
      return t`this is what was asked for`;
    case 'symmetry':
      return list ? t`mirrors ${list}` : t`keeps the symmetry`;
    case 'attachment':
      return list ? t`stays joined to ${list}` : t`stays joined`;
    case 'neighbour':
      return list ? t`follows ${list}` : t`follows its neighbours`;
    case 'breaking':
      return t`nothing fits all its relations; this gives up the fewest`;
    case 'group':
      return t`part of its row`;
  }
}

export function listWords(names: readonly string[], most = 3, count = names.length): string {
  const shown = names.slice(0, most);
  const rest = count - shown.length;
  if (rest > 0) return t`${shown.join(', ')} and ${rest} more`;
  return listed(shown);
}

const joints = { point: m`at a point`, line: m`along a line`, face: m`by a face`, volume: m`inside@joint` } as const;

/** "by a face"; empty for what is no joint. */
export const jointWords = ({ kind }: ShapeRelation): string =>
  kind in joints ? t(joints[kind as keyof typeof joints]) : '';

/** @param from reads the relation from this part's side: "joined to front left leg at a point" */
export function relationWords(document: Document, relation: ShapeRelation, from?: string): string {
  const [a = '', b = ''] = relation.parts.map((id) => nameOf(document, id));
  const other = from !== undefined && from === relation.parts[1] ? a : b;
  if (relation.kind === 'ground') return from === undefined ? t`${a} stands on the floor` : t`stands on the floor`;
  if (relation.kind === 'reflection') return from === undefined ? t`${a} mirrors ${b}` : t`mirrors ${other}`;
  if (isGroup(relation)) {
    const group = nameOf(document, relation.parent);
    const { length } = relation.parts;
    return relation.kind === 'translation' ? t`${group}: ${length} evenly spaced` : t`${group}: ${length} in a ring`;
  }
  if (from !== undefined) return t`joined to ${other} ${t(joints[relation.kind])}`;
  return t`${a} and ${b} joined ${t(joints[relation.kind])}`;
}

/**
 * "All 3 symmetries are kept; 2 joints may come loose".
 * @param listed those that a request is asked about or gives up, by id
 */
export function givenUpWords(
  { relations }: Shape,
  listed: readonly { readonly relation: string }[],
  disabled: readonly string[],
): string {
  const joints = new Set(relations.filter(isAttachment).map(({ id }) => id));
  const symmetries = listed.filter(({ relation }) => !joints.has(relation)).length;
  const givenUp = listed.filter(({ relation }) => disabled.includes(relation));
  const loose = givenUp.filter(({ relation }) => joints.has(relation)).length;
  const broken = givenUp.length - loose;
  const kept = plural(symmetries, 'Its symmetry is kept', 'All {n} symmetries are kept');
  const ofSymmetries = broken === 0 ? kept : t`${broken} of ${symmetries} symmetries may break`;
  const ofJoints = loose === 0 ? t`All joints are kept` : plural(loose, 'A joint gives way', '{n} joints give way');
  if (symmetries === 0) return ofJoints;
  return loose === 0 ? ofSymmetries : `${ofSymmetries}. ${ofJoints}`;
}

/** "keeps 23 of 24 relations at every position". */
export function keptWords(reports: readonly RelationReport[]): string {
  const counted = reports.filter(({ status }) => status !== 'disabled');
  const held = counted.filter(({ status }) => status === 'held');
  if (counted.length === 0) return '';
  if (held.length === counted.length)
    return plural(held.length, 'keeps its one relation at every position', 'keeps all {n} relations at every position');
  return plural(
    counted.length,
    'keeps {0} of {n} relation at every position',
    'keeps {0} of {n} relations at every position',
    held.length,
  );
}

/** What operators are called where one is chosen, in that order. */
export const operatorWords: Readonly<Record<Statement['op'], { readonly label: Sentence; readonly help: Sentence }>> = {
  translate: { label: m`Move`, help: m`Moves it along a direction` },
  scale_1d: { label: m`Stretch`, help: m`Stretches it along one direction` },
  scale_2d: { label: m`Thicken`, help: m`Grows it in the two directions across one` },
  scale_3d: { label: m`Grow`, help: m`Grows it in all directions` },
  rotate: { label: m`Tilt`, help: m`Turns it about an axis` },
  shear: { label: m`Slant`, help: m`Slants it` },
  change_count: { label: m`Count`, help: m`More or fewer of the row` },
  change_delta: { label: m`Spacing`, help: m`Sets the row wider or closer` },
  keep_fixed: { label: m`Keep`, help: m`Keeps it as it is` },
};

export const hintWords: Readonly<Record<Hint, Sentence>> = {
  translate: m`should move`,
  rotate: m`should tilt`,
  scale: m`should stretch`,
  shear: m`should slant`,
  change_count: m`should change its count`,
  change_delta: m`should change its spacing`,
  keep_fixed: m`should stay`,
};
