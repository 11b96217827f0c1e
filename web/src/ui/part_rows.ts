// The rows of the parts list: which parts are listed, in what order, and which of them are in sight.
import type { ShapePart } from '../program/types';

export interface PartRow {
  readonly part: ShapePart;
  /** An instance, below its row or ring. */
  readonly inner: boolean;
  /** Of what stands for instances: whether they are listed below it; null for other parts. */
  readonly open: boolean | null;
}

interface Wanted {
  /** What to look for, in names and labels; all words have to be there. Empty: everything. */
  readonly query: string;
  readonly nameOf: (part: ShapePart) => string;
  readonly isOpen: (group: ShapePart) => boolean;
}

/** Instances are listed below what stands for them when that is open, or when only they are what is looked for. */
export function partRows(parts: readonly ShapePart[], { query, nameOf, isOpen }: Wanted): PartRow[] {
  const words = query.toLowerCase().split(/\s+/).filter(Boolean);
  const matches = (part: ShapePart) => {
    const text = `${nameOf(part)} ${part.label}`.toLowerCase();
    return words.every((word) => text.includes(word));
  };
  const byId = new Map(parts.map((part) => [part.id, part]));
  const inner = new Set(parts.flatMap(({ members }) => members));
  return parts
    .filter(({ id }) => !inner.has(id))
    .flatMap((part): PartRow[] => {
      if (!part.virtual) return matches(part) ? [{ part, inner: false, open: null }] : [];
      const all = part.members.flatMap((id) => byId.get(id) ?? []);
      const members = matches(part) ? all : all.filter(matches);
      if (members.length === 0) return [];
      const open = isOpen(part) || members.length < all.length;
      const below = open ? members.map((member) => ({ part: member, inner: true, open: null })) : [];
      return [{ part, inner: false, open }, ...below];
    });
}

/** Lists up to here are drawn whole. */
const mostWhole = 100;
const spare = 12;

/** Rows to draw of a long list, from `first` up to but not `end`: those in sight and some more on both sides. */
export function rowsInSight(
  count: number,
  rowHeight: number,
  top: number,
  height: number,
): [first: number, end: number] {
  if (count <= mostWhole) return [0, count];
  const first = Math.max(0, Math.min(count - 1, Math.floor(top / rowHeight)) - spare);
  return [first, Math.min(count, first + Math.ceil(height / rowHeight) + 2 * spare)];
}
