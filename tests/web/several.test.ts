// Several parts at once: what is like what, what stands for a selection, and the rows of the parts list.
import { describe, expect, it } from 'vitest';
import type { Shape, ShapePart } from '../../web/src/program/types';
import { createSession } from '../../web/src/session/session';
import { alike, realParts, standIns } from '../../web/src/session/several';
import { partRows, rowsInSight } from '../../web/src/ui/part_rows';
import { box, oneBox } from './box_shapes';

const part = (id: string, label = id): ShapePart => ({ ...box(id, 0, [0, 0, 0], [1, 1, 1]), label, name: id });

/** Arms that mirror each other under labels of their own, three slats in a row, and a foot. */
const shape: Shape = {
  ...oneBox,
  parts: [
    part('left arm', 'armleft'),
    part('right arm', 'armright'),
    ...['a', 'b', 'c'].map((id) => part(`slat ${id}`, 'slat')),
    { ...part('slats', 'slat'), virtual: true, members: ['slat a', 'slat b', 'slat c'] },
    part('foot'),
  ],
  relations: [
    {
      id: 'r1',
      kind: 'reflection',
      parts: ['left arm', 'right arm'],
      origin: [0, 0, 0],
      normal: [1, 0, 0],
      axis: 0,
      corner_map: [1, 0, 3, 2, 5, 4, 7, 6],
    } as unknown as Shape['relations'][number],
    {
      id: 't1',
      kind: 'translation',
      parts: ['slat a', 'slat b', 'slat c'],
      parent: 'slats',
      start: [0, 0, 0],
      end: [1, 0, 0],
      axis: 0,
      direction: 1,
    },
  ],
};

describe('parts that are alike', () => {
  it('are mirror images under other labels, and the instances of a row', () => {
    expect(alike(shape, 'right arm')).toEqual(['left arm', 'right arm']);
    expect(alike(shape, 'slat b')).toEqual(['slat a', 'slat b', 'slat c']);
    expect(alike(shape, 'slats')).toEqual(['slat a', 'slat b', 'slat c']);
    expect(alike(shape, 'foot')).toEqual(['foot']);
  });
});

describe('what stands for a selection', () => {
  it('is the row where all of it is selected, and else each part', () => {
    expect(standIns(shape, ['slat c', 'foot', 'slat a', 'slat b'])).toEqual(['slats', 'foot']);
    expect(standIns(shape, ['slat c', 'foot'])).toEqual(['slat c', 'foot']);
    expect(standIns(shape, ['slats', 'slat a'])).toEqual(['slats']);
    expect(realParts(shape, ['foot', 'slats'])).toEqual(['slat a', 'slat b', 'slat c', 'foot']);
  });
});

describe('the selection', () => {
  it('keeps the first part, grows and shrinks, and ends with the last', () => {
    const { select, selectAlso, selectAll, selected, selection } = createSession();
    selectAlso('foot');
    selectAlso('slats');
    expect(selected.value).toEqual(['foot', 'slats']);
    selectAlso('foot');
    expect(selected.value).toEqual(['slats']);
    selectAlso('slats');
    expect(selection.value).toBeNull();
    selectAll(['foot', 'slats']);
    select('slats', [1, 0, 0]);
    expect(selected.value).toEqual(['slats']);
    selectAlso('foot');
    expect(selection.value).toEqual({ part: 'slats', feature: [1, 0, 0] }); // what is grabbed of it stays
  });
});

describe('the rows of the list', () => {
  const rows = (query: string, open = false) =>
    partRows(shape.parts, { query, nameOf: ({ name }) => name, isOpen: () => open }).map(({ part: { id }, inner }) =>
      inner ? `  ${id}` : id,
    );
  it('list instances below their row once it is open', () => {
    expect(rows('')).toEqual(['left arm', 'right arm', 'slats', 'foot']);
    expect(rows('', true)).toEqual(['left arm', 'right arm', 'slats', '  slat a', '  slat b', '  slat c', 'foot']);
  });
  it('are those with all words of the query, whatever their case', () => {
    expect(rows('ARM le')).toEqual(['left arm']);
    expect(rows('slat b')).toEqual(['slats', '  slat b']);
    expect(rows('sofa')).toEqual([]);
  });
  it('of a long list are drawn around what is in sight', () => {
    expect(rowsInSight(80, 28, 500, 300)).toEqual([0, 80]);
    const [first, end] = rowsInSight(1000, 28, 500 * 28, 280);
    expect(first).toBeLessThan(500);
    expect(end).toBeGreaterThanOrEqual(510);
    expect(end - first).toBeLessThan(60);
    expect(rowsInSight(1000, 28, 999 * 28, 280)[1]).toBe(1000);
    expect(rowsInSight(150, 28, 5000 * 28, 280)[1]).toBe(150); // scrolled farther than a search leaves rows
  });
});
