// What the variations of a program have in common, in plain words: its constraints by class, so that four legs make one
// line and not sixteen. The core names features "seat.x-" (a face), "leg.sy" (a size), "wheel.x" (an axis), "seat.x-y+z-"
// (a corner); frame and words as everywhere: own left is +x, +y is up, front is +z.

import type { LocalTriple } from '../program/types';
import type { CadPart } from '../scene/load';
import { listed, m, plural, type Sentence, t } from '../texts/texts';
import type { Constraint } from '../worker/family_protocol';
import type { Choice } from './family_found';

/** In all variations that have the parts, in all but one, or by accident of the program alone. */
export type Agreement = 'common' | 'near' | 'accidental';

export interface SharedClass {
  readonly key: string;
  readonly text: string;
  readonly agreement: Agreement;
  /** Whether the sliders keep it. */
  readonly kept: boolean;
  /** How many variations show it, of those that have its parts: "in 5 of 6". */
  readonly holds: number;
  readonly of: number;
  /** Names of the variations that do not, each once. */
  readonly brokenBy: readonly string[];
  /** Its constraints, by id. */
  readonly ids: readonly string[];
  /** Those that say the same and more, such as corners that meet: they are switched off with it. */
  readonly implying: readonly string[];
  /** Ids of the parts of the program, and their faces. */
  readonly faces: readonly { readonly part: string; readonly feature: LocalTriple }[];
}

interface Feature {
  readonly part: string;
  readonly stem: string;
  /** After the point: "x-", "sy", "top". */
  readonly what: string;
}

const axisOf = (what: string) => 'xyz'.indexOf(what.startsWith('s') ? (what[1] ?? '') : (what[0] ?? ''));
const isFace = (what: string) => /^[xyz][-+]$/.test(what);
const isCorner = (what: string) => /^([xyz][-+]){3}$/.test(what);

export function agreementOf({ of, holds }: Pick<Constraint, 'of' | 'holds'>): Agreement {
  if (holds === of) return 'common';
  return of - holds === 1 && of > 2 ? 'near' : 'accidental';
}

/** In the order of the core: common ones of a kind beside each other. */
export function sharedClasses(constraints: readonly Constraint[], parts: readonly CadPart[]): readonly SharedClass[] {
  const byId = new Map(parts.map((part) => [part.id, part]));
  const feature = (name: string): Feature => {
    const dot = name.lastIndexOf('.');
    const part = name.slice(0, dot);
    return { part, stem: byId.get(part)?.stem ?? part, what: name.slice(dot + 1) };
  };
  const corners = constraints.filter(({ a, b }) => isCorner(feature(a).what) && isCorner(feature(b).what));
  const hidden = new Set(corners);
  const groups = new Map<string, { constraint: Constraint; a: Feature; b: Feature }[]>();
  for (const constraint of constraints) {
    if (hidden.has(constraint)) continue; // three faces say the same
    const ends = [feature(constraint.a), feature(constraint.b)].sort((p, q) => order(p).localeCompare(order(q)));
    const [a, b] = ends as [Feature, Feature];
    const kinds = `${a.part === b.part} ${a.what === b.what}`;
    const key = `${constraint.kind} ${order(a)} ${order(b)} ${kinds} ${agreementOf(constraint)}`;
    groups.set(key, [...(groups.get(key) ?? []), { constraint, a, b }]);
  }
  return [...groups].map(([key, members]) => {
    const [{ constraint, a, b }] = members as [(typeof members)[number]];
    const ends = (end: 'a' | 'b') => new Set(members.map((member) => member[end].part));
    const name = (end: Feature, those: ReadonlySet<string>) => nameOf(end, those, byId);
    const all = new Set([...ends('a'), ...ends('b')]);
    const text =
      a.stem === b.stem
        ? alikeText(constraint.kind, a, b, name(a, all), all.size)
        : betweenText(constraint.kind, a, b, name(a, ends('a')), name(b, ends('b')));
    const implying = corners.filter((corner) => members.some((member) => implies(corner, member)));
    return {
      key,
      text,
      agreement: agreementOf(constraint),
      kept: members.some((member) => member.constraint.kept),
      holds: Math.min(...members.map((member) => member.constraint.holds)),
      of: Math.max(...members.map((member) => member.constraint.of)),
      brokenBy: [...new Set(members.flatMap((member) => member.constraint.broken_by ?? []))],
      ids: members.map((member) => member.constraint.id),
      implying: implying.map(({ id }) => id),
      faces: members.flatMap((member) => [member.a, member.b].flatMap(facesOf)),
    };
  });
}

/** What turns a class on or off: the choices to make, null where the evidence decides. */
export function choicesFor(shared: SharedClass, on: boolean): ReadonlyMap<string, Choice | null> {
  const isAsFound = on === (shared.agreement === 'common');
  const own = shared.ids.map((id) => [id, isAsFound ? null : on ? 'forced' : 'off'] as const);
  const others = shared.agreement === 'common' ? shared.implying.map((id) => [id, on ? null : 'off'] as const) : [];
  return new Map<string, Choice | null>([...own, ...others]);
}

/** Left and right are one: what holds at one side of a pair holds at the other side of its twin. */
const side = (what: string) => (isFace(what) && what[0] === 'x' ? 'x' : what);
const order = ({ stem, what }: Feature) => `${stem} ${side(what)}`;

function implies({ a, b }: Constraint, member: { constraint: Constraint; a: Feature; b: Feature }): boolean {
  if (member.constraint.kind !== 'coplanar') return false;
  const has = (name: string, { part, what }: Feature) => name.startsWith(`${part}.`) && name.includes(what);
  return (has(a, member.a) && has(b, member.b)) || (has(a, member.b) && has(b, member.a));
}

function facesOf({ part, what }: Feature): { part: string; feature: LocalTriple }[] {
  const axis = axisOf(what);
  const face = (sign: number) => [0, 1, 2].map((i) => (i === axis ? sign : 0)) as unknown as LocalTriple;
  if (isFace(what)) return [{ part, feature: face(what.endsWith('-') ? -1 : 1) }];
  if (/^s[xyz]$/.test(what)) return [-1, 1].map((sign) => ({ part, feature: face(sign) }));
  return [{ part, feature: [0, 0, 0] }];
}

/** "the legs", "the seat" */
function nameOf({ stem }: Feature, parts: ReadonlySet<string>, byId: ReadonlyMap<string, CadPart>): string {
  const [only = ''] = parts;
  if (parts.size === 1) return t`the ${byId.get(only)?.name ?? only}`;
  const noun = stem.replaceAll('_', ' ');
  return t`the ${`${noun}${/(s|x|z|ch|sh)$/.test(noun) ? 'es' : 's'}`}`;
}

const sizeWords: Readonly<Record<string, Sentence>> = {
  sx: m`width`,
  sy: m`height`,
  sz: m`depth`,
  top: m`top diameter`,
};
const sizeWord = (what: string) => (sizeWords[what] ? t(sizeWords[what]) : what);

/** A sentence on as many parts as `count` under one name. */
type Say = (count: number, name: string) => string;
const alike: Readonly<Record<string, Say>> = {
  sx: (count, name) => plural(count, '{0} is equally wide', '{0} are equally wide', name),
  sy: (count, name) => plural(count, '{0} is equally high', '{0} are equally high', name),
  sz: (count, name) => plural(count, '{0} is equally deep', '{0} are equally deep', name),
  top: (count, name) => plural(count, '{0} is equally wide at the top', '{0} are equally wide at the top', name),
};
const alikeAtAll: Say = (count, name) => plural(count, '{0} is equally large', '{0} are equally large', name);
const flush: Readonly<Record<string, Say>> = {
  x: (count, name) => plural(count, '{0} is flush at the sides', '{0} are flush at the sides', name),
  'y-': (count, name) => plural(count, '{0} is on one level below', '{0} are on one level below', name),
  'y+': (count, name) => plural(count, '{0} is on one level above', '{0} are on one level above', name),
  'z-': (count, name) => plural(count, '{0} is flush at the back', '{0} are flush at the back', name),
  'z+': (count, name) => plural(count, '{0} is flush in front', '{0} are flush in front', name),
};
const flushAtAll: Say = (count, name) => plural(count, '{0} is flush', '{0} are flush', name);
const inLine: readonly Say[] = [
  (count, name) => plural(count, '{0} is in line from side to side', '{0} are in line from side to side', name),
  (count, name) => plural(count, '{0} is centred above one another', '{0} are centred above one another', name),
  (count, name) => plural(count, '{0} is in line from front to back', '{0} are in line from front to back', name),
];
const atOnePoint: Say = (count, name) => plural(count, '{0} is at one point', '{0} are at one point', name);
const betweenFlush: Readonly<Record<string, Sentence>> = {
  x: m`{0} and {1}: flush at the sides`,
  'y-': m`{0} and {1}: on one level below`,
  'y+': m`{0} and {1}: on one level above`,
  'z-': m`{0} and {1}: flush at the back`,
  'z+': m`{0} and {1}: flush in front`,
};
const betweenLines = [
  m`{0} and {1}: in line from side to side`,
  m`{0} and {1}: centred above one another`,
  m`{0} and {1}: in line from front to back`,
];

const capital = (text: string) => text.charAt(0).toUpperCase() + text.slice(1);

/** Of parts with one stem, or within one part. */
function alikeText(kind: Constraint['kind'], a: Feature, b: Feature, parts: string, count: number): string {
  const name = capital(parts);
  if (kind === 'equal' && a.what === b.what) return (alike[a.what] ?? alikeAtAll)(count, name);
  if (kind === 'equal') {
    const words = listed([sizeWord(a.what), sizeWord(b.what)]);
    return plural(count, '{0} is alike in {1}', '{0} are alike in {1}', name, words);
  }
  if (kind === 'coplanar') {
    if (side(a.what) === side(b.what)) return (flush[side(a.what)] ?? flushAtAll)(count, name);
    return plural(count, '{0} is end to end', '{0} are end to end', name);
  }
  return ((kind === 'coaxial' && inLine[axisOf(a.what)]) || atOnePoint)(count, name);
}

function betweenText(kind: Constraint['kind'], a: Feature, b: Feature, first: string, second: string): string {
  const [name, other] = [capital(first), second];
  if (kind === 'equal') {
    const [left, right] = [sizeWord(a.what), sizeWord(b.what)];
    return left === right
      ? t`${name} and ${other}: the same ${left}`
      : t`The ${left} of ${first} is the ${right} of ${second}`;
  }
  if (kind === 'coaxial') return t(betweenLines[axisOf(a.what)] ?? m`{0} and {1}: in line`, name, other);
  if (kind === 'coincident') return t`${name} and ${other} meet at a point`;
  if ((side(a.what) === side(b.what) && a.what[0] !== 'x') || a.what === b.what)
    return t(betweenFlush[side(a.what)] ?? m`{0} and {1}: flush`, name, other);
  if (a.what[0] === 'y') {
    const [upper, lower] = a.what === 'y-' ? [first, second] : [second, first];
    return t`${capital(upper)} on top of ${lower}`;
  }
  if (a.what[0] === 'z') {
    const [front, behind] = a.what === 'z-' ? [first, second] : [second, first];
    return t`${capital(front)} right in front of ${behind}`;
  }
  return t`${name} and ${other}: side by side`;
}
