// Which kinds of a thing there are, as a language model names them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/cad/model.h"

namespace parsel {

inline constexpr int most_kinds = 12;
inline constexpr int usual_kinds = 7;
/// Characters that the words about a kind may have.
inline constexpr std::size_t longest_kind_words = 200;

struct Kind {
  std::string name;                 ///< for people: not blank, at most VariationLimits::name_bytes
  std::string words;                ///< about its proportions; may be empty
  std::vector<std::string> absent;  ///< ids of the parts that it lacks, never all
  int votes = 1;
};

struct DroppedKind {
  std::string name;    ///< as far as it can be shown
  std::string reason;  ///< a clause without a full stop
};

struct Kinds {
  std::vector<Kind> kinds;
  std::vector<DroppedKind> dropped;
};

/// {"kinds": [{"name", "absent": [part ids], "words"}, …]}; a reply that names none is refused. Dropped, each with its
/// reason: what has no name or too long a one, lacks parts that the model does not have or all of them, is named twice,
/// or comes after the twelfth.
Result<Kinds> read_kinds_reply(const cad::Model& model, std::string_view reply);

/// Those that most replies name first, of equally many those that stand further ahead in them. Names count as the same
/// that differ in capitals, articles, hyphens and a plural's s. A part is absent when most of those who name the kind
/// say so; the words are the first one's.
Kinds count_kinds(const std::vector<Kinds>& replies);

/// {"kinds": [{"name", "words", "absent": [ids], "votes"}], "dropped": [{"name", "reason"}]}
nlohmann::json to_json(const Kinds& kinds);

}  // namespace parsel
