#include "core/prove/deviation.h"

#include <algorithm>
#include <cmath>

namespace parsel {

Constraint make_constraint(const Shape& shape, RelationIndex relation) {
  Constraint constraint{&shape.relations[relation], relation, {}, {}, {}, {}};
  if (!constraint.relation->is_group()) {
    for (const PartIndex p : constraint.relation->parts) {
      const Part& part = shape.parts[p];
      if (part.group && !part.is_virtual()) constraint.groups.push_back(*part.group);
    }
  }
  if (const auto* ground = std::get_if<Ground>(&constraint.relation->detail)) {
    const Corners& part = shape.parts[constraint.relation->parts[0]].hexahedron.corners;
    for (const Vec3& local : ground->local) {
      constraint.weights_a.push_back(trilinear_weights(local));
      constraint.at_rest.push_back(interpolate(constraint.weights_a.back(), part));
    }
  }
  const auto* attachment = std::get_if<Attachment>(&constraint.relation->detail);
  if (!attachment) return constraint;
  const Corners& a = shape.parts[constraint.relation->parts[0]].hexahedron.corners;
  const Corners& b = shape.parts[constraint.relation->parts[1]].hexahedron.corners;
  for (std::size_t i = 0; i < attachment->points.size(); ++i) {
    constraint.weights_a.push_back(trilinear_weights(attachment->local_a[i]));
    constraint.weights_b.push_back(trilinear_weights(attachment->local_b[i]));
    constraint.at_rest.push_back(interpolate(constraint.weights_a[i], a) - interpolate(constraint.weights_b[i], b));
  }
  return constraint;
}

double deviation(const Constraint& constraint, const State& state) {
  double worst = 0;
  for_each_deviation(constraint, state, [&](double value) { worst = std::max(worst, std::abs(value)); });
  return worst;
}

}  // namespace parsel
