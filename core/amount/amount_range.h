// Whether an amount is defined, real and bounded on a whole box of parameters: the one rule of what is accepted.
//
// web/src/program/domain.ts has the same rule, operation by operation and box by box, so that the page accepts what the
// tools accept: an amount is accepted when interval arithmetic shows on every piece of the box that no operation is
// undefined and no value leaves the limit. Where it cannot exclude a pole, the amount is refused. Roots alone are
// forgiven: an expanded square that touches 0 is noise below it, so pieces where nothing but the sign under a root is
// open count as defined when their middle is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/amount/amount.h"
#include "core/amount/interval.h"

namespace parsel {

/// An enclosure of the amount's values on the box; nothing when it cannot be seen that the amount is defined on all of
/// it. It holds the exact values and those that doubles give.
std::optional<Interval> enclose(const CompiledAmount& amount, const std::vector<Interval>& box);

struct RangeFault {
  std::vector<double> at;  ///< values of the parameters
  std::string cause;       ///< "the square root of a negative number"
};

/// Operations that all amounts of a program may take together to be judged, and boxes that one may take.
inline constexpr int judging_budget = 2'000'000;
inline constexpr int boxes_per_amount = 2'000;

/// Why the amount is refused on the box, by the rule above: undefined, or larger in magnitude than `limit`, or not
/// shown to be neither. The box's two extreme corners are looked at, then the box is halved where the enclosure does
/// not decide, first in first out, across the side that is widest relative to the whole, down to 1e-9 of it. Every look
/// at a box takes the length of the code from `budget`; when that is spent, nothing is found and the budget is
/// negative.
std::optional<RangeFault> find_fault(const CompiledAmount& amount, const std::vector<Interval>& box, double limit,
                                     int& budget);

}  // namespace parsel
