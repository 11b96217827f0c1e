// How far a layer's slider may go before a part turns inside out or a row runs into itself.
#pragma once

#include <string>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

/// A cage counts as collapsed when the volume at one of its corners falls below this share of that at rest: thin enough
/// to be of no use, and far enough from 0 that normals, which divide by it, stay accurate.
inline constexpr double collapse_ratio = 0.05;

/// Amounts reach no further than this: supplement §4's candidates are bounded so, and a larger one is no edit. Those of
/// change_count are instances, and may reach ProgramLimits::instances.
inline constexpr double largest_amount = 5;

struct Range {
  double min = 0, max = 0;             ///< min <= 0 <= max
  std::string min_reason, max_reason;  ///< why not further, for people: "seat would turn inside out", "limit"
};

/// The widest [min, max] within [low, high] on which, going outward from 0, no hexahedron of an active part or of an
/// instance inverts or collapses (see collapse_ratio, at the corners of the cage), no instances of a row run into each
/// other that stood apart at rest, and every amount of the layer is defined and below largest_amount in size (see
/// there). The layers before it stand at their values, later ones are not applied.
///
/// low < 0 < high. On each side, 48 steps to its limit (low or high) find the first failure, bisection its place to
/// 1e-6 of the limit; ends short of it are rounded towards 0 to four decimals. What lies between the steps is then
/// bounded with jets, in pieces down to 1e-9 of the limit: a cage that inverts within one step is found unless its
/// pieces are more than are looked at. That instances of a row run into each other between two steps is not seen. When
/// the shape fails at 0 already (an earlier layer collapsed a part), the range is [0, 0].
Range find_range(const Shape& shape, const Program& program, std::size_t layer, double low, double high);

}  // namespace parsel
