// A part that passes through another one: a column through a ring or through the spokes around it, a post through a shelf.
// They slide along each other, until one comes off.
#pragma once

#include <array>
#include <optional>

#include "core/base/geometry.h"

namespace parsel {

struct Passage {
  bool first_passes = true;  ///< through the second
  int axis = 0;              ///< local axis of the part that passes, along which it does
  int outer_axis = 0;        ///< of the other one
  /// The corners of what the boxes have in common: their weights in either box.
  std::array<Weights, 8> inner, outer;
};

/// Nothing where neither passes through the other. Boxes at rest.
std::optional<Passage> passage_of(const Corners& first, const Corners& second);

/// What has become of a passage.
struct PassageChange {
  double apart = 0;  ///< the farthest that a corner of what they had in common has moved across the axis, ≥ 0
  double lost = 0;   ///< share of the outer part's length that the inner one no longer passes through, 0 … 1
};
PassageChange change_of(const Passage& passage, const Corners& first, const Corners& second);

}  // namespace parsel
