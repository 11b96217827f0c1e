// What several answers about one kind of thing come to: which parts it has, and what they measure.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/family/layout.h"
#include "core/family/variation.h"

namespace parsel::family {

struct VoteLimits {
  static constexpr std::size_t parts = 64;  ///< as many as a family may have
};

/// What one answer says of a kind.
struct Ballot {
  Values values;             ///< in the layout's order; of absent parts anything
  std::vector<bool> absent;  ///< by part

  bool has(std::size_t part) const { return !absent[part]; }
};

struct Voted {
  Variation variation;
  /// Constraints of the base of which most answers that have both parts say that they hold, and those of which all do.
  std::size_t agreed = 0, unanimous = 0;
  std::size_t constraints = 0;  ///< of the base, between parts that the kind has
};

/// A part is absent when more than half say so. Each bound is the median over the answers that have the part, laid over
/// each other at the middle and the ground of what they share: the numbers of one that slipped do not count. Medians
/// may tear what each answer holds together ("as wide as deep"), so they are then moved, as little as possible (least
/// squares), to where every constraint of the base holds that more than half of the answers hold; where that leaves a
/// size that is not positive, to where those hold of which more answers say so. Error: without answers, when no part is
/// left, or when they contradict each other even so. `layout` in the extended vocabulary; `ballots` have positive
/// sizes.
Result<Voted> count_votes(const cad::Model& model, const Layout& layout, const std::string& name,
                          const std::vector<Ballot>& ballots);

}  // namespace parsel::family
