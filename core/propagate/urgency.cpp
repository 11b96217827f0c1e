#include "core/propagate/urgency.h"

#include <variant>

#include "core/base/tolerance.h"

namespace parsel {

Urgency urgency_of(const Shape& shape, const std::vector<PointConstraint>& constraints, bool hinted) {
  Urgency urgency;
  urgency.hinted = hinted;
  for (const auto& [index, by] : residuals(constraints, still())) {
    if (by <= exact) continue;
    const Relation& relation = shape.relations[index];
    const auto* mirror = std::get_if<Reflection>(&relation.detail);
    urgency.mirror = urgency.mirror || (relation.is_symmetry() && !(mirror != nullptr && mirror->stacked));
    ++urgency.broken;
  }
  return urgency;
}

}  // namespace parsel
