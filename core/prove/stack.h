// The verdict on a stack of layers: which relations that each layer keeps alone are kept wherever all sliders stand, and
// how far each slider may go where the others stand now. Sampled, not proven: a product of ranges has too many corners.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/prove/together.h"

namespace parsel {

/// How far a slider may go with the others at their values: min <= its value <= max, unless nothing is sound there.
struct SliderStop {
  double min = 0, max = 0;
  std::string min_reason, max_reason;  ///< what goes wrong beyond, by Together::fault(); empty at the end of the range
};

struct StackVerdict {
  int of = 0;                     ///< relations that each layer keeps alone
  std::vector<std::string> lost;  ///< ids of those that are not kept at some setting, in the shape's order
  int settings = 0;               ///< that were looked at
  int failed = 0;                 ///< settings at which cages or rows fail (stack_failure.h)
  std::string failure;            ///< of the first of these
  std::vector<SliderStop> stops;  ///< of each layer
};

/// Settings: all corners of the product of ranges, or most_corners of them at random; every slider at its ends, its
/// middle and its quarters with the others at 0 and at random; random ones. `program` passed validate() for `shape`. What
/// layers keep alone is taken from their reports; a layer without any is proven here. Deterministic. A stop is found in
/// stop_steps steps and bisected to 1/2000 of the range.
StackVerdict judge_stack(const Shape& shape, const Program& program);

inline constexpr int most_corners = 64;
inline constexpr int stop_steps = 16;

/// Every layer's reports anew: what it keeps behind the others, where these stand at their values (prove.h).
void prove_anew(const Shape& shape, Program& program);

/// One sentence for people.
std::string in_words(const StackVerdict& verdict);

/// {"of", "lost": [ids], "settings", "failed", "failure", "stops": [{"min", "max", "minReason", "maxReason"}]}
nlohmann::json to_json(const StackVerdict& verdict);

}  // namespace parsel
