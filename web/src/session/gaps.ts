// What became of the gaps that an edit has opened, in sentences.

import type { Shape } from '../program/types';
import { t } from '../texts/texts';
import type { LengthUnit } from './document';
import { formatMeasure } from './measure';
import type { Exported } from './model_core';

const mostNamed = 3;

/** Without what is open still, and without a word where nothing became longer. */
export function withoutLeft(exported: Exported): Exported {
  const { gaps, ...rest } = exported;
  return gaps === undefined || gaps.closed.length === 0 ? rest : { ...rest, gaps: { ...gaps, left: [] } };
}

/** @param unit of lengths; absent: whichever suits each */
export function gapSentences({ gaps }: Exported, shape: Shape, unit: LengthUnit | undefined): string {
  if (gaps === undefined) return '';
  if (gaps.gaps === 0) return t`No parts have come apart: there was no gap to close.`;
  const name = (id: string) => shape.parts.find((part) => part.id === id)?.name ?? id;
  const length = (metres: number) => formatMeasure('distance', metres, metres, unit);
  const listed = (items: readonly string[]) =>
    [...items.slice(0, mostNamed), ...(items.length > mostNamed ? [t`${items.length - mostNamed} more`] : [])].join(
      ', ',
    );
  const longer = gaps.closed.map(({ part, longer }) => t`${name(part)} by ${length(longer)}`);
  const left = gaps.left.map(({ parts: [a, b], width }) => t`${name(a)} and ${name(b)} (${length(width)})`);
  return [
    longer.length > 0 ? t`Gaps are closed: longer are ${listed(longer)}.` : '',
    left.length > 0 ? t`Apart still, as no part could be made longer: ${listed(left)}.` : '',
  ]
    .filter(Boolean)
    .join(' ');
}
