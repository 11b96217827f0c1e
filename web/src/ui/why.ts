// "Why did this part move", "why did nothing happen": answers from the statements of the layers and, where propagation
// ran on this page, from its trace.

import { movedParts } from '../program/edited';
import {
  isGroup,
  type Layer,
  type RelationReport,
  type Shape,
  type ShapeRelation,
  type Statement,
} from '../program/types';
import { type Document, type LayerEntry, nameOf } from '../session/document';
import { activeLayers } from '../session/evaluation';
import { titleOf } from '../session/layers';
import { looseningOf } from '../session/loosening';
import { formatMeasure, larger } from '../session/measure';
import type { TraceStep } from '../session/trace';
import { listed, plural, t } from '../texts/texts';
import { capital, listWords, relationWords, statementWords, whyWords } from './words';

/** A clause of the core's, with the names of parts in place of their ids. */
export function inWords(document: Document, text: string): string {
  const shape = document.model?.shape;
  const named = text.replace(/\b[a-z]\w*\b/g, (word) => {
    if (shape?.parts.some(({ id }) => id === word)) return nameOf(document, word);
    return (
      {
        scale_1d: 'a stretch',
        scale_2d: 'a thickening',
        scale_3d: 'a growth',
        translate: 'a move',
        rotate: 'a turn',
        shear: 'a slant',
      }[word] ?? word
    );
  });
  return named.replace(/ \([rtoag]\d+\)/g, '');
}

export interface PartWhy {
  readonly layer: string;
  /** Sentences. */
  readonly text: readonly string[];
  /** What was tried, in numbers; empty when nothing was. */
  readonly search: string;
}

const sentence = (text: string) => `${capital(text)}.`;
const distance = ({ model, unit }: Document, by: number) => {
  const length = by * (model?.shape.frame.scale ?? 1);
  return formatMeasure('distance', length, length, unit);
};

/** What each active layer does with a part and why, in the order of the layers. */
export function whyPart(document: Document, id: string): readonly PartWhy[] {
  const shape = document.model?.shape;
  if (shape === undefined) return [];
  return activeLayers(document).map((entry) => ({
    layer: titleOf(entry.layer),
    ...whyInLayer(document, shape, entry, id),
  }));
}

function whyInLayer(
  document: Document,
  shape: Shape,
  { layer, trace }: LayerEntry,
  id: string,
): Omit<PartWhy, 'layer'> {
  const own = statementsOn(shape, layer, id);
  const step = trace?.steps.findLast((other) => other.part === id);
  if (own.length === 0) return { text: [stillWords(document, shape, layer, id, step)], search: '' };
  const text = own.map((statement) => {
    const why = whyWords(document, statement);
    return sentence(`${statementWords(document, statement)}${why ? `: ${why}` : ''}`);
  });
  const pulled = (step?.pulled_by ?? []).filter(({ by }) => by > 0.002).sort((a, b) => b.by - a.by);
  const [most] = pulled;
  const relation = shape.relations.find((other) => other.id === most?.relation);
  if (most && relation && step?.kind !== 'seed') {
    text.push(
      sentence(
        t`at rest, “${relationWords(document, relation, id)}” would be off by up to ${distance(document, most.by)}`,
      ),
    );
  }
  const lost = (step?.left_broken ?? []).flatMap(
    (lostId) => shape.relations.find((other) => other.id === lostId) ?? [],
  );
  if (lost.length > 0)
    text.push(sentence(t`given up for it: ${listWords(lost.map((other) => relationWords(document, other, id)))}`));
  return { text, search: step ? searchWords(document, step) : '' };
}

/** The statements that move a part: its own, else those on the row or ring that it stands in. */
function statementsOn(shape: Shape, { statements }: Layer, id: string): readonly Statement[] {
  const own = statements.filter((statement) => 'part' in statement && statement.part === id);
  if (own.length > 0) return own;
  const group = shape.relations.find((other) => isGroup(other) && (other.parent === id || other.parts.includes(id)));
  if (group === undefined || !isGroup(group)) return [];
  return statements.filter((statement) =>
    'relation' in statement ? statement.relation === group.id : statement.part === group.parent,
  );
}

/** Why a part stays where it is. */
function stillWords(document: Document, shape: Shape, layer: Layer, id: string, step: TraceStep | undefined): string {
  if (step && step.kind === 'left_alone') return sentence(t`stays: ${inWords(document, step.why)}`);
  const relations = shape.relations.filter(({ kind, parts }) => kind !== 'ground' && parts.includes(id));
  if (relations.length === 0) return t`Stays: nothing is joined to it, and nothing mirrors it.`;
  const moved = movedParts(shape, layer.statements);
  const near = relations.filter(({ parts }) => parts.some((other) => other !== id && moved.has(other)));
  if (near.length === 0) return t`Stays: no part that it is tied to is changed.`;
  const status = new Map(layer.relations.map((report) => [report.id, report.status]));
  // What has no report is said by another relation: of two rows that mirror each other, not each pair as well.
  const tied = near.filter((relation) => status.has(relation.id));
  if (tied.length === 0) return t`Stays: no statement is about it.`;
  const lost = tied.filter((relation) => status.get(relation.id) !== 'held');
  if (lost.length > 0) {
    return sentence(
      t`stays, and this is given up: ${listWords(lost.map((other) => relationWords(document, other, id)))}`,
    );
  }
  return sentence(
    plural(
      tied.length,
      'stays: its one relation to changed parts holds without it',
      'stays: all its {n} relations to changed parts hold without it',
    ),
  );
}

function searchWords(document: Document, { candidates, survivors = 0, why }: TraceStep): string {
  const tried = candidates ? candidates.own + candidates.neighbour + candidates.pairs : 0;
  if (tried === 0) return '';
  return `${t`${tried} ways tried, ${survivors} fitted.`} ${sentence(inWords(document, why))}`;
}

/** Why nothing but the seed moves, in a sentence; null when something follows it. */
export function whyNothingElse({ layer, trace }: LayerEntry): string | null {
  if (layer.statements.length === 0 || layer.statements.some(({ why }) => why?.kind !== 'seed')) return null;
  if (trace?.stop.startsWith('no relation ties'))
    return t`Nothing else moves: no other part is joined to this one or mirrors it.`;
  if (trace?.stop.startsWith('every part')) return null;
  return t`Nothing else moves: all that is joined to it stays joined without.`;
}

/** "comes loose beyond +18 cm": where on the slider a relation gives way. */
export function brokenWords(
  document: Document,
  layer: Layer,
  relation: ShapeRelation,
  { worst }: RelationReport,
): string {
  const shape = document.model?.shape;
  const found = shape === undefined ? null : looseningOf(shape, layer, relation);
  const off = distance(document, worst);
  if (found === null) return t`comes apart by up to ${off}`;
  const { below, above, rest, measure } = found;
  const at = (value: number | null) => {
    if (value === null) return [];
    const change = value - rest;
    const amount = formatMeasure(measure.what, Math.abs(change), larger(rest, value), document.unit);
    return [`${change < 0 ? '−' : '+'}${amount}`];
  };
  const where = listed([...at(below), ...at(above)]);
  if (relation.kind === 'reflection') return t`no longer mirrored beyond ${where}, by up to ${off}`;
  if (relation.kind === 'ground') return t`off the floor beyond ${where}, by up to ${off}`;
  return t`loose beyond ${where}, by up to ${off}`;
}
