// "Left", "right", "front" and "back" as they are said, by language: the words of each row take one another's place. A new
// language is a table more. The core's own lists are core/infer/words.

interface SideWords {
  /** Forms of one kind: [left, right, front, back]. */
  readonly rows: readonly (readonly [left: string, right: string, front: string, back: string])[];
  /** Words that are also the name of a part: alone, "the back" is the backrest. */
  readonly parts: readonly string[];
  /** After one of these they are a side all the same: "to the back". */
  readonly prepositions: readonly string[];
  /** May stand between the two. */
  readonly articles: readonly string[];
  /** What says something else. */
  readonly not: readonly string[];
}

export const sideWords: readonly SideWords[] = [
  {
    rows: [
      ['left', 'right', 'front', 'back'],
      ['left', 'right', 'front', 'rear'],
      ['left', 'right', 'front', 'hind'],
      ['left', 'right', 'forward', 'backward'],
      ['left', 'right', 'forwards', 'backwards'],
    ],
    parts: ['back', 'front'],
    prepositions: 'at from in to toward towards on more further farther'.split(' '),
    articles: ['the', 'its'],
    not: ['right angle', 'right angles', 'right away', 'right now', 'all right', 'back in', 'back to', 'left over'],
  },
  {
    rows: [
      ['links', 'rechts', 'vorne', 'hinten'],
      ['links', 'rechts', 'vorn', 'hinten'],
      ['linke', 'rechte', 'vordere', 'hintere'],
      ['linken', 'rechten', 'vorderen', 'hinteren'],
      ['linker', 'rechter', 'vorderer', 'hinterer'],
      ['linkes', 'rechtes', 'vorderes', 'hinteres'],
      ['linkem', 'rechtem', 'vorderem', 'hinterem'],
    ],
    parts: [],
    prepositions: [],
    articles: [],
    not: [],
  },
];
