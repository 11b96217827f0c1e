// The words of plain requests: what the lists of core/infer/words say, one list a language, compiled in like the prompts.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace parsel {

/// What a plain request changes of its parts.
enum class Change {
  none,
  width,    ///< along x
  height,   ///< along y
  depth,    ///< along z
  length,   ///< along the longest edge
  thick,    ///< along the shortest edge, or both short ones of a bar
  size,     ///< in all directions
  raise,    ///< up, by what it stands on or by its own height
  count,    ///< of a row or ring
  spacing,  ///< of a row or ring, or of two mirror images
  move,
  open,
  tilt,
  taper,
};

enum class WordKind {
  filler,     ///< says nothing
  whole,      ///< "it", "the table"
  part,       ///< names parts of the shape; only readings of a request have it, never a list
  change,     ///< "wider": change and sign
  adjective,  ///< "wide", "width": change; sign -1 for "low"
  more,
  less,
  many,
  side,    ///< "left": axis and sign; a side of something, or the way there
  middle,  ///< "the middle drawer"
  way,     ///< "upwards": axis and sign
  out,     ///< outwards (sign 1) or inwards (-1)
  number,  ///< value
  length,  ///< a unit: value in metres
  degrees,
  percent,
  factor,  ///< "twice": value
  only,
  keep,
  keep_size,  ///< "keep their size": of what was named before
  fixed,
  same_size,
  rest,          ///< "everything else"
  nothing_else,  ///< "nothing else changes": the rest stays
  too,           ///< "too wide": less of it is wanted
  negation,
  follow,       ///< "let the fence follow": what others do by themselves
  conjunction,  ///< "and", ","
  but,
  with,
  so,
  by,
  of,
  at,
  to,
  as,
  exactly,
  unknown,
};

struct Word {
  WordKind kind = WordKind::unknown;
  Change change = Change::none;
  int axis = 0;      ///< global: 0, 1, 2
  int sign = 1;      ///< 1 or -1
  double value = 0;  ///< of numbers, units and factors
  /// "raise", "remove": a verb that needs to be told of what. "pull", "recline": one that knows where to.
  bool needs_object = false, knows_way = false, removes = false;
  bool points = false;  ///< "it": what was pointed at, else the whole
  bool operator==(const Word&) const = default;
};

/// One language. Every key and word is as plain_tokens() writes it; phrases are tokens joined by single spaces.
struct WordList {
  std::string language;  ///< "en"
  std::map<std::string, std::vector<Word>> phrases;
  std::size_t longest = 1;  ///< tokens of the longest phrase
  /// Words that are one unit in count: "a shelf", "another leg".
  std::vector<std::string> one;
  /// Nouns for whole objects; each entry lists what one thing is called, the first of them in English.
  std::vector<std::vector<std::string>> objects;
  /// Nouns for parts; each entry lists what one kind of part is called. Beyond English the first is the English word,
  /// as labels of files mostly are.
  std::vector<std::vector<std::string>> synonyms;
  /// What something is made of when no part bears its name: "back" → "post", "crest".
  std::map<std::string, std::vector<std::string>> made_of;
  /// What a part may be called by another label alone, not the other way round: "top" → "table", of a table with legs.
  std::map<std::string, std::vector<std::string>> also;
  /// Nouns that say nothing beside another one: the "centre panel".
  std::vector<std::string> generic;
  /// What is around what it is called after: a "door frame" is no door.
  std::vector<std::string> frames;
  /// Nouns for what stands on the floor, whatever else is called so.
  std::vector<std::string> standing;
  std::map<std::string, std::string> singular;
  std::vector<std::pair<std::string, std::string>> plural_endings;

  /// The word itself, then what it may be the plural of.
  std::vector<std::string> singulars(const std::string& word) const;
};

std::span<const WordList> word_lists();

/// A word, a number or a sign of a request.
struct Token {
  std::string text;  ///< lower case, Latin letters without their marks, "10", "%", ","
  std::string said;  ///< as written
  bool is_number = false;
  double value = 0;
};

/// Any bytes → at most `most` tokens. Full stops, question and quotation marks at the end are left out; hyphens part
/// words, apostrophes join them; "1,5" and "1.5" are numbers.
std::vector<Token> plain_tokens(std::string_view text, std::size_t most = 60);

/// How far a word is from a known one: 0 the same, 1 a slip (two letters swapped, one too many or missing, within),
/// 2 a letter replaced in a word of six or more, 3 what may as well be another word; 4 for anything else.
int misspelling(const std::string& word, const std::string& known);

}  // namespace parsel
