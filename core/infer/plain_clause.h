// From the words of a plain request to its clauses: what shall change, of what, how much, where to. Words come in any
// order within a clause, but for what belongs together: a side and its part, a number and its unit.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/infer/plain_parts.h"

namespace parsel {

/// A word of a request in one of its meanings.
struct Item {
  Word word;
  std::vector<PartIndex> parts;      ///< kind part
  bool plural = false;               ///< kind part
  int distance = 0;                  ///< kind part: see NamedParts
  int slip = 0;                      ///< see misspelling()
  std::size_t first = 0, count = 1;  ///< tokens
};

/// All the ways to take the words of a request, those with fewer doubts first; at most some hundred.
std::vector<std::vector<Item>> ways_to_take(const std::vector<Token>& tokens, const WordList& list,
                                            const PartNames& names);

struct Side {
  int axis = 0, sign = 1;
  bool operator==(const Side&) const = default;
};

struct Noun {
  std::vector<PartIndex> parts;
  std::vector<Side> sides;  ///< "front left"
  bool middle = false, plural = false;
  bool is_made_of = false;  ///< several parts that make up one thing: the posts of a "back"
  std::size_t token = 0;
  bool stands = false;  ///< legs and feet: of what is called so, what is on the floor
};

/// How much: by a difference, to a size, or times what it is.
struct HowMuch {
  enum class Kind { by, to, times } kind = Kind::by;
  enum class Unit { metre, radian, piece, ratio, none } unit = Unit::none;
  double value = 0;
};

struct Clause {
  Change change = Change::none;
  int sign = 1;
  bool needs_object = false, knows_way = false, removes = false;
  bool compares = false;    ///< "wider", not "wide"
  bool counts_one = false;  ///< "add a shelf": one, if the noun is one
  std::vector<Noun> nouns;
  bool whole = false;         ///< it names the whole, or says "it"
  bool names_whole = false;   ///< by a noun
  bool follows = false;       ///< "let the fence follow"
  bool serves = false;        ///< it says by what another one comes about: "longer by moving the supports apart"
  std::optional<Side> where;  ///< "at the top", "to the left", "upwards"
  int out = 0;                ///< 1 outwards, -1 inwards
  std::optional<HowMuch> how_much;
  bool only = false;
  /// "keep the legs fixed": other clauses' edits leave the nouns be.
  bool keeps = false, same_size = false;
  bool named_before = false;     ///< what it keeps comes before the verb: "the legs stay", not "keep the legs"
  bool everything_else = false;  ///< "the rest": what no other clause names
  enum class Begins { first, conjunction, so, by, on } begins = Begins::first;
  /// What stands between it and the clause before it. `other`: "but", "while", "with" and what begins differently.
  enum class Link { sentence, comma, conjunction, comma_and_conjunction, other } link = Link::sentence;
  std::vector<std::size_t> fixed;  ///< tokens that say "as it is"
  std::string fault;               ///< why it cannot be read; empty when it can
};

struct Sentence {
  std::vector<Clause> clauses;
  std::vector<std::size_t> unused;  ///< tokens that say something which no clause takes up
  std::string fault;
};

/// Lets what is said to stay hold for every noun of its list: "the legs and the seat stay", "keep the legs and the seat".
/// A noun of which it is not clear whether it changes or stays gets a fault.
void spread_keeps(Sentence& sentence);

Sentence parse(const std::vector<Item>& items, const std::vector<Token>& tokens, const PartNames& names);

}  // namespace parsel
