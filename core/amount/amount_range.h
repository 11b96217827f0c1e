// Whether an amount is defined, real and bounded on a whole box of parameters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/amount/amount.h"

namespace parsel {

/// A closed interval, low ≤ high.
struct Interval {
  double low = 0, high = 0;
};

/// An enclosure of the amount's values on the box, to rounding; nothing when it cannot be seen that the amount is
/// defined on all of it. Not outward rounded: a screen for mistakes, not a proof.
std::optional<Interval> enclose(const CompiledAmount& amount, const std::vector<Interval>& box);

struct RangeFault {
  std::vector<double> at;  ///< values of the parameters
  std::string cause;       ///< "the square root of a negative number"
};

/// The first point found at which the amount is undefined or larger in magnitude than `limit`. Corners and centre are
/// evaluated; then the box is bisected where enclose() cannot decide, each time evaluating the centre, down to 2^-40 of
/// its size, so that poles are found by the growth towards them. At most `budget` boxes are looked at, and the number
/// is taken from it; what is undecided then counts as defined (the centre of every box has been evaluated).
std::optional<RangeFault> find_fault(const CompiledAmount& amount, const std::vector<Interval>& box, double limit,
                                     int& budget);

}  // namespace parsel
