// What the sliders of a program do together. Each layer was found and bounded with the others at rest; where all stand
// anywhere in their ranges, parts may turn inside out and relations break that every single layer keeps. Here such
// states are told from sound ones, and sound ones are drawn at random: the siblings of the model (ParSEL §8.1).
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/prove/deviation.h"
#include "core/prove/stack_failure.h"
#include "core/shape/shape.h"

namespace parsel {

class Together {
 public:
  /// How it is known what a layer keeps alone: `proven` here, with the others at 0; or `as_reported` by the layer itself,
  /// and proven where it reports nothing.
  enum class Alone { proven, as_reported };
  /// `program` passed validate() for `shape`, which must live as long, and has at least one layer.
  Together(const Shape& shape, const Program& program, Alone alone = Alone::proven);

  /// What is seen at one setting, which is evaluated once.
  struct Look {
    std::string failure;            ///< of cages, rows and amounts (stack_failure.h); empty when there is none
    std::vector<std::size_t> lost;  ///< of kept_alone(), ascending, those beyond their tolerance
    int kept = 0;                   ///< of all relations that the program touches, those within
  };
  Look look(const std::vector<double>& values) const;
  /// Ids of the relations that each layer keeps alone, in the shape's order.
  const std::vector<std::string>& kept_alone() const { return kept_alone_; }

  /// What is wrong with the state where layer i stands at values[i], a clause for people: a part that is inside out or
  /// collapsed, instances that run into each other, a relation beyond its tolerance (slack.h) that each layer alone
  /// keeps. Empty when it is sound.
  std::string fault(const std::vector<double>& values) const;

  struct Count {
    int kept = 0, of = 0;
  };
  /// How many of the relations that the program touches, those included that a layer breaks by itself, are kept there.
  Count relations(const std::vector<double>& values) const;

 private:
  struct Judged {
    Constraint constraint;
    double tolerance;
    bool is_kept_alone;
  };
  const Shape& shape_;
  Evaluator evaluate_;
  StackFailure failure_;
  std::vector<Judged> judged_;
  std::vector<std::string> kept_alone_;
};

inline constexpr int most_siblings = 10'000;
/// Settings that are tried for one sibling before the stack is given up.
inline constexpr int sibling_tries = 500;

struct Siblings {
  std::vector<std::vector<double>> values;  ///< of each sibling, one a layer
  int rejected = 0;                         ///< settings that were drawn and not sound
  std::map<std::string, int> reasons;       ///< why, by fault(); the settings of each
};

/// `count` settings that are sound, each parameter drawn evenly from its range, rounded to four decimals (which is what a
/// program's text shows, too). The same for the same program and seed on every machine. Error: a count outside
/// 1 … most_siblings, a program without layers, a stack of which sibling_tries settings one after the other are not
/// sound.
Result<Siblings> draw_siblings(const Shape& shape, const Program& program, int count, std::uint64_t seed);

/// {"siblings": [[values]], "rejected": n, "reasons": [{"reason", "count"}], the most frequent first}
nlohmann::json to_json(const Siblings& siblings);

}  // namespace parsel
