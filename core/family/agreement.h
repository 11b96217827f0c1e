// Which of a model's constraints its variations share.
//
// A constraint is common when it holds in every variation that has its parts, to a tolerance; near when all but one
// hold it, which is then named; else it is an accident of the base. What no variation shows is kept as the base has it.
// No ranking and no jump in a curve is needed, since variations are exact or moved by hand with snapping; the paper's own
// selection, for noisy ones, is in ranking.h.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/family/candidates.h"
#include "core/family/variation.h"

namespace parsel::family {

enum class Agreement { common, near, accidental };
std::string_view to_string(Agreement agreement);

/// What people may say against the evidence: that a constraint is meant, or that it is not.
enum class Choice { forced, off };
using Choices = std::map<std::string, Choice, std::less<>>;  ///< by Constraint::id

struct Evidence {
  Agreement agreement = Agreement::accidental;
  std::size_t seen = 0;                ///< variations that have its parts
  std::vector<std::size_t> broken_by;  ///< of those, which do not hold it
  bool is_kept = false;                ///< common and not off, or forced
};

/// One an entry of `constraints`.
std::vector<Evidence> find_agreement(const std::vector<Constraint>& constraints,
                                     const std::vector<Variation>& variations, double tolerance,
                                     const Choices& choices = {});

/// Indices of the kept constraints that raise the rank of those before them, in order.
std::vector<std::size_t> independent(const std::vector<Constraint>& constraints, const std::vector<Evidence>& evidence,
                                     std::size_t parameters);

/// Parts that are absent from the same variations, of at least one; groups in order of their first part.
struct OptionalGroup {
  std::vector<std::size_t> parts;
  std::vector<std::size_t> absent_from;  ///< variations
};
std::vector<OptionalGroup> optional_groups(const std::vector<Variation>& variations, std::size_t parts);

}  // namespace parsel::family
