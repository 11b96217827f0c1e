// Text cut to a length between characters as people see them: never inside a surrogate pair, before a combining mark or
// within an emoji that is joined of several. The core's counterpart is core/base/text.h.

const characters = new Intl.Segmenter('en', { granularity: 'grapheme' });
const encoder = new TextEncoder();

/** The longest beginning of at most `limit` UTF-16 units (what `length` counts); empty when its first character is longer. */
export const cut = (text: string, limit: number): string => longest(text, limit, (part) => part.length);

/** The longest beginning of at most `limit` bytes of UTF-8, in which programs and sessions measure names. */
export const cutBytes = (text: string, limit: number): string =>
  longest(text, limit, (part) => encoder.encode(part).length);

/** `text`, or its beginning and an ellipsis. */
export const shortened = (text: string, limit: number): string => (text.length > limit ? `${cut(text, limit)}…` : text);

function longest(text: string, limit: number, size: (part: string) => number): string {
  if (size(text) <= limit) return text;
  let end = 0;
  let sum = 0;
  // No character has fewer units than its bytes allow: what lies beyond `limit` units need not be looked at.
  for (const { segment } of characters.segment(text.slice(0, limit + 64))) {
    sum += size(segment);
    if (sum > limit) break;
    end += segment.length;
  }
  return text.slice(0, end);
}
