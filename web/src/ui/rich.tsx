// Sentences with marks in them, so that a translation can put them where its grammar wants them.
import type { ComponentChild } from 'preact';

/**
 * Puts elements for the marks of a sentence: "After <a>ParSEL</a>, 2024" with `a` for what is between.
 * @param marks by name; what looks like another mark stays text
 */
export function rich(
  sentence: string,
  marks: Readonly<Record<string, (text: string) => ComponentChild>>,
): ComponentChild[] {
  // Every third piece is a name, and the one behind it what was marked.
  const pieces = sentence.split(new RegExp(`<(${Object.keys(marks).join('|')})>(.*?)</\\1>`));
  return pieces.map((piece, i) => (i % 3 === 0 ? piece : i % 3 === 1 ? null : marks[pieces[i - 1] ?? '']?.(piece)));
}
