// Seed edits that make sense for any model, where nobody has written better ones.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/shape/shape.h"

namespace parsel::eval {

struct NamedEdit {
  std::string name;
  nlohmann::json edit;  ///< parsel/edit
};

/// widen, raise, deepen: the part that is longest along that axis, scaled along it (raised from its foot).
/// move_end: the part that lies farthest out, moved outwards along the axis on which it does.
/// count, spacing: of up to two groups. None for a shape with fewer than 4 real parts.
std::vector<NamedEdit> automatic_edits(const Shape& shape);

}  // namespace parsel::eval
