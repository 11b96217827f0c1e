// What is wrong with an edit, from its record (see evaluate.cpp), in one phrase; and how bad it is.

/** Below these nothing is seen: lengths relative to the half diagonal. A volume counts by the cube of its length. */
const visibleGap = 0.02;
const visibleOverlap = 0.03 ** 3;
const narrowRange = 0.1;

const worstOf = ({ ends = [] }, list) => ends.flatMap((end) => end[list]).toSorted((a, b) => b.amount - a.amount)[0];

/** 0 when nothing is; failures first. Who moves a part away wants a gap: those edits count half. */
export function severity(edit) {
  const { ends = [], broken = 0, relations = 0, range } = edit;
  const wanted = edit.edit.startsWith('move_end') ? 0.5 : 1;
  const seen = wanted * Math.max(0, ...ends.map(({ gap, overlap }) => gap + Math.cbrt(overlap)));
  const narrow = range !== undefined && range[1] - range[0] < narrowRange ? 0.5 : 0;
  return (edit.failure ? 10 : 0) + narrow + seen + (relations > 0 ? (0.1 * broken) / relations : 0);
}

const ties = {
  none: 'that nothing ties',
  held: 'though their attachment is held',
  broken: 'whose attachment is given up',
  disabled: 'of a group that is taken apart',
  group: 'of one group',
  inactive: 'whose attachment rests while their group stands',
};

export function causeOf(edit) {
  const { failure, range } = edit;
  if (failure)
    return `failure: ${failure.stage}: ${failure.cause.replace(/["“‘'].*?["”’']|[\d.e-]+/g, '…').slice(0, 90)}`;
  if (range[1] - range[0] < narrowRange) return 'the range collapses';
  const gap = worstOf(edit, 'gaps');
  const overlap = worstOf(edit, 'overlaps');
  const byGap = gap !== undefined && gap.amount > visibleGap;
  const byOverlap = overlap !== undefined && overlap.amount > visibleOverlap;
  if (byGap && (!byOverlap || gap.amount >= Math.cbrt(overlap.amount))) return `gap between parts ${ties[gap.tie]}`;
  if (byOverlap) return `overlap of parts ${ties[overlap.tie]}`;
  return edit.broken > 0 ? 'relations given up, nothing seen' : 'clean';
}

/** The numbers behind it, in a line. */
export function explain(edit) {
  if (edit.failure) return `${edit.failure.stage}: ${edit.failure.cause}`;
  const { held, relations, range, why, ms } = edit;
  const pair = (what, list, text) => {
    const worst = worstOf(edit, list);
    return worst === undefined || worst.amount < 1e-6
      ? []
      : [`${what} ${text(worst.amount)} ${worst.a} – ${worst.b} (${worst.tie})`];
  };
  return [
    `seed ${edit.seed.map(({ op, part, relation }) => `${op} ${part ?? relation}`).join(', ')}`,
    `${held} of ${relations} held`,
    `range ${range.map((x) => x.toFixed(2)).join(' … ')}`,
    Object.entries(why)
      .map(([kind, n]) => `${n} ${kind}`)
      .join(', '),
    ...pair('gap', 'gaps', (x) => x.toFixed(3)),
    ...pair('overlap', 'overlaps', (x) => x.toExponential(1)),
    `${ms.propagate.toFixed(1)} ms`,
  ].join(' · ');
}
