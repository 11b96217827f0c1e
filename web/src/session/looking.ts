// "Left" is the object's own left, unless a person says it from where they look. Then what they say is put into the
// object's own sides before it is read without a language model, and a language model is told from where it is said.
import { type Side, sides } from './document';
import { sideWords } from './side_words';

/** Columns of side_words.ts. */
const columns: readonly Side[] = ['left', 'right', 'front', 'back'];

/** By the side that faces a person: which side of the object they call left, right, front and back. */
const meant: Readonly<Record<Side, Readonly<Record<Side, Side>>>> = {
  front: { left: 'right', right: 'left', front: 'front', back: 'back' },
  back: { left: 'left', right: 'right', front: 'back', back: 'front' },
  left: { left: 'front', right: 'back', front: 'left', back: 'right' },
  right: { left: 'back', right: 'front', front: 'right', back: 'left' },
};

/** The side of the object that faces somebody who looks at it. @param azimuth radians about the vertical, 0 from its front */
export function sideFacing(azimuth: number): Side {
  const quarter = Math.round(azimuth / (Math.PI / 2));
  return sides[((quarter % 4) + 4) % 4] ?? 'front';
}

interface Token {
  readonly text: string;
  /** Lower case; empty for what is no word. */
  readonly word: string;
}

const tokensOf = (text: string): Token[] =>
  (text.match(/\p{L}+|[^\p{L}]+/gu) ?? []).map((part) => ({
    text: part,
    word: /^\p{L}/u.test(part) ? part.toLowerCase() : '',
  }));

/** The words of a text, without what stands between. */
const wordsOf = (text: string): string[] => tokensOf(text).flatMap(({ word }) => (word === '' ? [] : [word]));

const singular = (word: string) => (word.length > 3 ? word.replace(/s$/, '') : word);
const sameNoun = (a: string | undefined, b: string | undefined) =>
  a !== undefined && b !== undefined && singular(a) === singular(b);

/** Whether a name has two words next to each other: "back slat" in "back slat 3". */
const hasPair = (name: readonly string[], first: string, second: string) =>
  name.some((word, i) => word === first && sameNoun(name[i + 1], second));

/**
 * A request in the object's own sides.
 * @param seen the side of the object that faces whoever says it
 * @param names what the parts are called: "the back slats" have no front ones, and stay what they are
 */
export function inOwnSides(request: string, seen: Side, names: readonly string[]): string {
  const parts = names.map(wordsOf);
  const tokens = tokensOf(request);
  const places = tokens.flatMap(({ word }, i) => (word === '' ? [] : [i]));
  const words = places.map((i) => tokens[i]?.word ?? '');
  const said = tokens.map(({ text }) => text);
  for (const [at, word] of words.entries()) {
    for (const language of sideWords) {
      const row = language.rows.find((forms) => forms.includes(word));
      const side = row && columns[row.indexOf(word)];
      if (row === undefined || side === undefined || isSomethingElse(words, at, row, language, parts)) continue;
      const own = row[columns.indexOf(meant[seen][side])] ?? word;
      const place = places[at] ?? 0;
      const before = said[place] ?? '';
      said[place] =
        before.charAt(0) === before.charAt(0).toUpperCase() ? own.charAt(0).toUpperCase() + own.slice(1) : own;
      break;
    }
  }
  return said.join('');
}

function isSomethingElse(
  words: readonly string[],
  at: number,
  row: readonly string[],
  { not, parts: nouns, prepositions, articles }: (typeof sideWords)[number],
  names: readonly (readonly string[])[],
): boolean {
  const word = words[at] ?? '';
  const next = words[at + 1];
  const last = words[at - 1];
  if (not.some((phrase) => phrase === `${word} ${next}` || phrase === `${last} ${word}`)) return true;
  if (!nouns.includes(word)) return false;
  const isNoun = (other: string | undefined) => names.some((name) => name.some((part) => sameNoun(part, other)));
  if (next !== undefined && (row.includes(next) || isNoun(next))) {
    // "Back legs" are a side of the legs where there are others; "back slats" are what they are called where not.
    const others = row.filter((form) => form !== word);
    return (
      names.some((name) => hasPair(name, word, next)) &&
      !names.some((name) => others.some((other) => hasPair(name, other, next)))
    );
  }
  const before = articles.includes(last ?? '') ? words[at - 2] : last;
  return !prepositions.includes(before ?? '');
}

/** A request as it was typed, and what is read of it. */
export interface Said {
  readonly typed: string;
  /** In the object's own sides. */
  readonly own: string;
  /** What somebody is told who understands from where it is said. */
  readonly told: string;
  /** The side that faced whoever said it; null: the object's own sides are meant. */
  readonly seen: Side | null;
}

/** @param names what the parts of the model are called */
export function saidFrom(typed: string, seen: Side | null, names: readonly string[]): Said {
  if (seen === null) return { typed, own: typed, told: typed, seen };
  return { typed, own: inOwnSides(typed, seen, names), told: `${typed}\n${fromWhere(seen)}`, seen };
}

/** Whether a request says a side in words that are known here. */
export const saysSide = (request: string): boolean =>
  wordsOf(request).some((word) => sideWords.some(({ rows }) => rows.some((row) => row.includes(word))));

/** What a language model is told behind a request that is said from where a person looks. */
function fromWhere(seen: Side): string {
  const { left, right, front, back } = meant[seen];
  return (
    `(I say sides as I see them, looking at its ${seen}: my left is the model's own ${left}, my right its ${right}, ` +
    `what is nearest to me its ${front}, what is farthest its ${back}. Names of parts stay what they are.)`
  );
}
