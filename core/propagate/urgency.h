// Which part a search decides upon next. ParSEL §5.2: the one with the most broken relations.
#pragma once

#include <tuple>
#include <vector>

#include "core/propagate/constraints.h"

namespace parsel {

/// The greater is decided upon first; ties by id.
struct Urgency {
  bool mirror = false;  ///< an image of it, or its row, has been edited: it has the least choice
  bool hinted = false;  ///< a hint says what it is to do
  int broken = 0;       ///< relations with edited parts that do not hold if it stays at rest

  friend bool operator==(const Urgency& a, const Urgency& b) { return a.tied() == b.tied(); }
  friend bool operator>(const Urgency& a, const Urgency& b) { return a.tied() > b.tied(); }

 private:
  std::tuple<bool, bool, int> tied() const { return {mirror, hinted, broken}; }
};

/// Of an unedited part, by its constraints. Mirror images one above the other count as a relation like any other: what
/// stands on the floor grows away from it, and its upper half is seldom asked to do the opposite of the lower one.
Urgency urgency_of(const Shape& shape, const std::vector<PointConstraint>& constraints, bool hinted);

}  // namespace parsel
