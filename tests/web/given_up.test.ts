// What the card of a request says of the relations that a reading keeps and gives up.
import { describe, expect, it } from 'vitest';
import type { Shape } from '../../web/src/program/types';
import { givenUpWords } from '../../web/src/ui/words';
import { twoBoxes } from './box_shapes';

const joint = twoBoxes.relations[0] as Shape['relations'][number];
const mirror = (id: string) =>
  ({
    id,
    kind: 'reflection',
    parts: ['left', 'right'],
    normal: [1, 0, 0],
    origin: [0, 0, 0],
    corner_map: [1, 0, 3, 2, 5, 4, 7, 6],
  }) as const;
const shape: Shape = { ...twoBoxes, relations: [joint, { ...joint, id: 'a2' }, mirror('r1'), mirror('r2')] };
const said = (listed: readonly string[], disabled: readonly string[]) =>
  givenUpWords(
    shape,
    listed.map((relation) => ({ relation })),
    disabled,
  );

describe('the relations of a reading', () => {
  it('are mirror images that are kept or may break, as for a language model’s', () => {
    expect(said(['r1', 'r2'], [])).toBe('All 2 symmetries are kept');
    expect(said(['r1'], [])).toBe('Its symmetry is kept');
    expect(said(['r1', 'r2'], ['r2'])).toBe('1 of 2 symmetries may break');
  });

  it('are joints that give way, told apart from mirror images', () => {
    expect(said(['a1', 'r1'], ['a1'])).toBe('Its symmetry is kept. A joint gives way');
    expect(said(['a1', 'a2', 'r1', 'r2'], ['a1', 'a2', 'r1'])).toBe('1 of 2 symmetries may break. 2 joints give way');
    expect(said(['a1'], ['a1'])).toBe('A joint gives way');
  });

  it('are joints again once they are kept by hand', () => {
    expect(said(['a1'], [])).toBe('All joints are kept');
    expect(said(['a1', 'r1'], [])).toBe('Its symmetry is kept');
  });
});
