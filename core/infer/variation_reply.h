// What the parts of a thing measure in one of its kinds, as a language model gives it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/family/vote.h"

namespace parsel {

/// {"parts": {part id: [[x0, x1], [y0, y1], [z0, z1]], or with a fourth number, a cone's top, or "absent"}}, in the
/// model's frame and unit. Refused, by the part's name: one that is missing or unknown, bounds that are no three pairs
/// of numbers, a lower bound that is not below its upper one, numbers beyond cad::Limits::coordinate, a cone without
/// its top and another part with one, a top that is negative; and a reply that leaves no part. `layout` in the extended
/// vocabulary.
Result<family::Ballot> read_variation_reply(const cad::Model& model, const family::Layout& layout,
                                            std::string_view reply);

/// What replies to one prompt of a CAD task mean, counted: {"kinds", "dropped", "refused"} or {"variation":
/// parsel/variations of one, "agreed", "unanimous", "constraints", "refused"} (core/family/vote.h). "refused":
/// [{"vote", "error": {"stage", "place", "cause", "fix"}}]. Error: when none can be read, the first one's.
Result<nlohmann::json> read_kinds(const cad::Model& model, const std::vector<std::string>& texts);
Result<nlohmann::json> read_variation(const cad::Model& model, const std::string& kind,
                                      const std::vector<std::string>& texts);

}  // namespace parsel
