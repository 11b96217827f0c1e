// Text from outside, made fit for people and messages. Lengths are bytes of UTF-8, as in every limit of ours; what is
// cut is cut between characters as people see them, never inside one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace parsel {

/// Well-formed UTF-8 without overlong forms, surrogates or code points beyond U+10FFFF.
bool is_utf8(std::string_view text);

struct Character {
  char32_t code = 0;     ///< U+FFFD for a byte that is not UTF-8
  std::size_t size = 1;  ///< bytes
  bool whole = false;    ///< well-formed
};
/// The code point that starts at byte `at`, which is inside the text.
Character character_at(std::string_view text, std::size_t at);

/// Code points; a byte that is not UTF-8 counts as one.
std::size_t count_characters(std::string_view text);

/// Whether it belongs to the character before it: combining marks and vowel signs, joiners, variation selectors, skin
/// tones, the second and third letter of a Hangul syllable (Unicode UAX #29, a little coarser within Indic blocks).
bool joins_previous(char32_t code);

/// The longest beginning of at most `limit` bytes that ends between two characters as people see them: not before what
/// joins_previous(), not after a zero-width joiner, not within a flag. When the first such character alone is longer,
/// the longest that is whole UTF-8.
std::string_view cut(std::string_view text, std::size_t limit);

/// Whether there is nothing to see in it: blanks, controls and hidden marks, or nothing at all.
bool is_blank(std::string_view text);

/// A name or a sentence from outside for people and messages, cut() to `limit` bytes. A blank stands for runs of what
/// must not reach them: broken UTF-8, controls, and marks that hide or reorder text (bidirectional controls, tags).
/// Joiners stay between letters that are not ASCII, where Persian, the scripts of India and emoji need them.
std::string printable(std::string_view text, std::size_t limit = 64);

/// The letters of ASCII that a Latin letter with marks is written with without them, in lower case: é → e, ß → ss.
/// Empty for every other character.
std::string_view plain_latin(char32_t code);

}  // namespace parsel
