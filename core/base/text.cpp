#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>

namespace parsel {

namespace {

struct CodeRange {
  char32_t first, last;
};

// Made from the categories Mn, Mc and Me of Unicode 14; what lies between two marks of one block may be in a range as
// well: a cut then comes one character earlier.
constexpr std::array<CodeRange, 117> joining = {
    {{0x0300, 0x036f}, {0x0483, 0x0489},   {0x0591, 0x05c7},  {0x0610, 0x061a}, {0x064b, 0x065f}, {0x0670, 0x0670},
     {0x06d6, 0x06ed}, {0x0711, 0x0711},   {0x0730, 0x074a},  {0x07a6, 0x07b0}, {0x07eb, 0x07f3}, {0x07fd, 0x07fd},
     {0x0816, 0x082d}, {0x0859, 0x085b},   {0x0898, 0x089f},  {0x08ca, 0x0903}, {0x093a, 0x0957}, {0x0962, 0x0963},
     {0x0981, 0x0983}, {0x09bc, 0x09d7},   {0x09e2, 0x09e3},  {0x09fe, 0x0a03}, {0x0a3c, 0x0a51}, {0x0a70, 0x0a83},
     {0x0abc, 0x0acd}, {0x0ae2, 0x0ae3},   {0x0afa, 0x0b03},  {0x0b3c, 0x0b57}, {0x0b62, 0x0b63}, {0x0b82, 0x0b82},
     {0x0bbe, 0x0bd7}, {0x0c00, 0x0c04},   {0x0c3c, 0x0c56},  {0x0c62, 0x0c63}, {0x0c81, 0x0c83}, {0x0cbc, 0x0cd6},
     {0x0ce2, 0x0ce3}, {0x0d00, 0x0d03},   {0x0d3b, 0x0d4d},  {0x0d57, 0x0d57}, {0x0d62, 0x0d63}, {0x0d81, 0x0d83},
     {0x0dca, 0x0ddf}, {0x0df2, 0x0df3},   {0x0e31, 0x0e3a},  {0x0e47, 0x0e4e}, {0x0eb1, 0x0ebc}, {0x0ec8, 0x0ecd},
     {0x0f18, 0x0f19}, {0x0f35, 0x0f3f},   {0x0f71, 0x0f87},  {0x0f8d, 0x0fbc}, {0x0fc6, 0x0fc6}, {0x102b, 0x103e},
     {0x1056, 0x1074}, {0x1082, 0x108f},   {0x109a, 0x109d},  {0x1160, 0x11ff}, {0x135d, 0x135f}, {0x1712, 0x1715},
     {0x1732, 0x1734}, {0x1752, 0x1753},   {0x1772, 0x1773},  {0x17b4, 0x17d3}, {0x17dd, 0x17dd}, {0x180b, 0x180f},
     {0x1885, 0x1886}, {0x18a9, 0x18a9},   {0x1920, 0x193b},  {0x1a17, 0x1a1b}, {0x1a55, 0x1a7f}, {0x1ab0, 0x1ace},
     {0x1b00, 0x1b04}, {0x1b34, 0x1b44},   {0x1b6b, 0x1b73},  {0x1b80, 0x1b82}, {0x1ba1, 0x1bad}, {0x1be6, 0x1bf3},
     {0x1c24, 0x1c37}, {0x1cd0, 0x1ced},   {0x1cf4, 0x1cf9},  {0x1dc0, 0x1dff}, {0x200c, 0x200d}, {0x20d0, 0x20f0},
     {0x2cef, 0x2cf1}, {0x2d7f, 0x2d7f},   {0x2de0, 0x2dff},  {0x302a, 0x302f}, {0x3099, 0x309a}, {0xa66f, 0xa67d},
     {0xa69e, 0xa69f}, {0xa6f0, 0xa6f1},   {0xa802, 0xa80b},  {0xa823, 0xa82c}, {0xa880, 0xa881}, {0xa8b4, 0xa8c5},
     {0xa8e0, 0xa8f1}, {0xa8ff, 0xa8ff},   {0xa926, 0xa92d},  {0xa947, 0xa953}, {0xa980, 0xa983}, {0xa9b3, 0xa9c0},
     {0xa9e5, 0xa9e5}, {0xaa29, 0xaa36},   {0xaa43, 0xaa43},  {0xaa4c, 0xaa4d}, {0xaa7b, 0xaa7d}, {0xaab0, 0xaab8},
     {0xaabe, 0xaac1}, {0xaaeb, 0xaaef},   {0xaaf5, 0xaaf6},  {0xabe3, 0xabed}, {0xfb1e, 0xfb1e}, {0xfe00, 0xfe0f},
     {0xfe20, 0xfe2f}, {0x1f3fb, 0x1f3ff}, {0xe0100, 0xe01ef}}};

constexpr char32_t zero_width_non_joiner = 0x200c, zero_width_joiner = 0x200d;

bool is_flag_letter(char32_t code) {
  return code >= 0x1f1e6 && code <= 0x1f1ff;
}

/// Unicode's spaces, and the letters that are drawn as nothing (Hangul fillers, the empty Braille pattern).
bool is_space(char32_t code) {
  return code == ' ' || code == 0xa0 || code == 0x115f || code == 0x1680 || (code >= 0x2000 && code <= 0x200a) ||
         code == 0x202f || code == 0x205f || code == 0x2800 || code == 0x3000 || code == 0x3164 || code == 0xffa0;
}

/// C0 and C1 controls, and what reorders or hides text: soft hyphen, Arabic letter mark, Mongolian vowel separator,
/// zero width marks, line separators, bidirectional controls, the byte order mark, and the tags, which spell unseen
/// text.
bool is_hidden(char32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || code == 0xad || code == 0x61c || code == 0x180e ||
         (code >= 0x200b && code <= 0x200f) || (code >= 0x2028 && code <= 0x202e) ||
         (code >= 0x2060 && code <= 0x206f) || code == 0xfeff || (code >= 0xe0000 && code <= 0xe0fff);
}

// U+00C0 … U+017F, one word each; "." for the signs of multiplication and division.
constexpr std::string_view latin_words =
    "a a a a a a ae c e e e e i i i i d n o o o o o . o u u u u y th ss a a a a a a ae c e e e e i i i i d n o o o o o "
    ". o u u u u y th y a a a a a a c c c c c c c c d d d d e e e e e e e e e e g g g g g g g g h h h h i i i i i i i "
    "i "
    "i i ij ij j j k k k l l l l l l l l l l n n n n n n n n n o o o o o o oe oe r r r r r r s s s s s s s s t t t t t "
    "t u u u u u u u u u u u u w w y y y z z z z z z s ";
constexpr char32_t latin_first = 0xc0, latin_last = 0x17f;

struct LatinRange {
  char32_t first, last;
  std::string_view letter;
};
// Vietnamese, Romanian, capital sharp s.
constexpr std::array<LatinRange, 12> more_latin = {{{0x1a0, 0x1a1, "o"},
                                                    {0x1af, 0x1b0, "u"},
                                                    {0x218, 0x219, "s"},
                                                    {0x21a, 0x21b, "t"},
                                                    {0x1e9e, 0x1e9e, "ss"},
                                                    {0x1ea0, 0x1eb7, "a"},
                                                    {0x1eb8, 0x1ec7, "e"},
                                                    {0x1ec8, 0x1ecb, "i"},
                                                    {0x1ecc, 0x1ee3, "o"},
                                                    {0x1ee4, 0x1ef1, "u"},
                                                    {0x1ef2, 0x1ef9, "y"},
                                                    {0x1e80, 0x1e85, "w"}}};

}  // namespace

Character character_at(std::string_view text, std::size_t at) {
  const auto lead = static_cast<std::uint8_t>(text[at]);
  if (lead < 0x80) return {lead, 1, true};
  const Character broken{0xfffd, 1, false};
  const std::size_t more = lead >= 0xf0 ? 3 : lead >= 0xe0 ? 2 : 1;
  if (lead < 0xc2 || lead > 0xf4 || more >= text.size() - at) return broken;
  char32_t code = lead & (0x3fU >> more);
  for (std::size_t k = 1; k <= more; ++k) {
    const auto next = static_cast<std::uint8_t>(text[at + k]);
    if ((next & 0xc0) != 0x80) return broken;
    code = code << 6 | (next & 0x3fU);
  }
  constexpr std::array<char32_t, 4> least = {0, 0x80, 0x800, 0x10000};
  if (code < least[more] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) return broken;
  return {code, more + 1, true};
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character character = character_at(text, at);
    if (!character.whole) return false;
    at += character.size;
  }
  return true;
}

std::size_t count_characters(std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); at += character_at(text, at).size) ++count;
  return count;
}

bool joins_previous(char32_t code) {
  const auto after = std::upper_bound(joining.begin(), joining.end(), code,
                                      [](char32_t value, const CodeRange& range) { return value < range.first; });
  return after != joining.begin() && code <= std::prev(after)->last;
}

std::string_view cut(std::string_view text, std::size_t limit) {
  if (text.size() <= limit) return text;
  std::size_t whole = 0;    // the end of the last code point that fits
  std::size_t between = 0;  // the end of the last character as people see it that fits
  char32_t previous = 0;
  bool half_flag = false;
  for (std::size_t at = 0; at <= limit;) {
    const Character character = character_at(text, at);
    const bool second = half_flag && is_flag_letter(character.code);
    if (!second && !joins_previous(character.code) && previous != zero_width_joiner) between = at;
    whole = at;
    half_flag = is_flag_letter(character.code) && !second;
    previous = character.code;
    at += character.size;
  }
  return text.substr(0, between > 0 ? between : whole);
}

bool is_blank(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const Character character = character_at(text, at);
    const char32_t code = character.code;
    if (character.whole && !is_space(code) && !is_hidden(code) && !joins_previous(code)) return false;
    at += character.size;
  }
  return true;
}

std::string printable(std::string_view text, std::size_t limit) {
  std::string out;
  bool after_letter = false;  // the last character of `out` is one that a joiner may join to the next
  for (std::size_t at = 0; at < text.size() && out.size() <= limit;) {
    const Character character = character_at(text, at);
    const std::size_t next = at + character.size;
    const char32_t code = character.code;
    bool hidden = !character.whole || is_hidden(code);
    if (code == zero_width_joiner || code == zero_width_non_joiner) {
      const Character follower = next < text.size() ? character_at(text, next) : Character{};
      hidden = !after_letter || !follower.whole || follower.code < 0x80 || is_hidden(follower.code);
      after_letter = false;
    } else {
      after_letter = !hidden && code >= 0x80;
    }
    if (hidden) {
      if (!out.empty() && out.back() != ' ') out += ' ';
    } else if (!out.empty() || !joins_previous(code)) {  // else it would join the quotation mark before the name
      out += text.substr(at, character.size);
    }
    at = next;
  }
  out.resize(cut(out, limit).size());
  // A joiner at the end, of a character that is longer than the limit, joins nothing.
  constexpr std::string_view joiners[] = {"\u200c", "\u200d"};
  for (;;) {
    if (out.ends_with(' ')) {
      out.pop_back();
    } else if (out.ends_with(joiners[0]) || out.ends_with(joiners[1])) {
      out.resize(out.size() - joiners[0].size());
    } else {
      return out;
    }
  }
}

std::string_view plain_latin(char32_t code) {
  if (code >= latin_first && code <= latin_last) {
    std::size_t start = 0;
    for (char32_t skip = latin_first; skip < code; ++skip) start = latin_words.find(' ', start) + 1;
    const std::string_view word = latin_words.substr(start, latin_words.find(' ', start) - start);
    return word == "." ? std::string_view() : word;
  }
  for (const LatinRange& range : more_latin) {
    if (code >= range.first && code <= range.last) return range.letter;
  }
  return {};
}

}  // namespace parsel
