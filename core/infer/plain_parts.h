// Which parts of a shape a noun of a plain request means: labels, exact or without direction words, one or many, by
// another name, by what it is made of, or written with a slip.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/infer/plain_words.h"
#include "core/shape/shape.h"

namespace parsel {

/// Active parts (a group stands for its instances), in the shape's order.
struct NamedParts {
  std::vector<PartIndex> parts;  ///< empty: the noun names none
  bool plural = false;
  /// 0 the parts bear the name, or it ends theirs; 1 they do without direction words, or it is another word for it; 2 it is only a word within theirs; 3 what it
  /// is made of.
  int distance = 0;
};

class PartNames {
 public:
  PartNames(const Shape& shape, const WordList& list);

  /// The phrase is one to three tokens without fillers.
  NamedParts called(std::span<const Token> phrase) const;
  /// Whether it names the whole: what the file's name calls it, or, where that says nothing, any such thing.
  bool is_whole(std::span<const Token> phrase) const;
  /// "a", "ein": one unit in count.
  bool is_one(const std::string& word) const;
  /// Whether it is a noun for what stands on the floor.
  bool is_standing(const std::string& word) const;
  /// Whether a label of the part has this word.
  bool has_word(PartIndex part, const std::string& word) const;
  /// Every single word that can name a part, for slips.
  const std::vector<std::string>& known_words() const { return known_; }

 private:
  struct Named {
    PartIndex part;
    std::vector<std::string> words;  ///< of the label
    /// The label as one word, its last word, and it without direction words: as they are, and what they may be plurals of.
    std::vector<std::string> glued, last, key;
  };
  std::vector<PartIndex> bearing(const std::vector<std::string>& forms, bool by_key = true) const;
  NamedParts named(std::span<const Token> phrase) const;

  /// Behind the middle of the parts: of what a "back" is made of, only what is there.
  bool is_behind(PartIndex part) const;

  const Shape& shape_;
  const WordList& list_;
  std::vector<Named> named_;
  std::vector<std::string> known_;
  std::vector<std::string> shape_words_;
};

}  // namespace parsel
