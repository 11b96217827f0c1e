#include "core/propagate/constraints.h"

#include <algorithm>
#include <cmath>

namespace parsel {

namespace {

Vec3 mirrored(const Vec3& v, const Vec3& normal) {
  return v - 2 * normal.dot(v) * normal;
}

Weights corner_weights(int corner) {
  Weights weights = Weights::Zero();
  weights[corner] = 1;
  return weights;
}

}  // namespace

Graph::Graph(const Shape& shape, const std::vector<RelationIndex>& dissolved, const std::set<RelationIndex>& disabled)
    : shape_(&shape), parts_(active_parts(shape, dissolved)), of_part_(shape.parts.size()) {
  for (const RelationIndex r : active_relations(shape, dissolved)) {
    const Relation& relation = shape.relations[r];
    // The floor pulls at no part: a ground relation has no other end.
    if (relation.is_group() || relation.kind == RelationKind::ground || disabled.count(r) > 0) continue;
    for (const PartIndex part : relation.parts) of_part_[part].push_back(r);
  }
}

PartIndex Graph::other(RelationIndex relation, PartIndex part) const {
  const auto& parts = shape_->relations[relation].parts;
  return parts[0] == part ? parts[1] : parts[0];
}

void add_constraints(const Graph& graph, RelationIndex relation, PartIndex part, const Edits& edits,
                     std::vector<PointConstraint>& constraints) {
  const Relation& r = graph.shape().relations[relation];
  const PartIndex other = graph.other(relation, part);
  PARSEL_ASSERT(edits[other] != nullptr, "only edited parts prescribe motions");
  const Motion& motion = edits[other]->motion;
  const bool is_first = r.parts[0] == part;
  const auto add = [&](const Weights& weights, const Weights& other_weights, const std::optional<Vec3>& mirror) {
    PointConstraint constraint{relation, weights, {}, other, other_weights, mirror};
    for (std::size_t s = 0; s < sample_count; ++s) {
      const Vec3 moved = interpolate(other_weights, motion[s]);
      constraint.goal[s] = mirror ? mirrored(moved, *mirror) : moved;
    }
    constraints.push_back(std::move(constraint));
  };
  if (r.kind == RelationKind::reflection) {
    const auto& reflection = std::get<Reflection>(r.detail);
    for (int k = 0; k < 8; ++k) {  // corner k of the second part is the image of corner_map[k] of the first
      const int image = reflection.corner_map[static_cast<std::size_t>(k)];
      add(corner_weights(is_first ? image : k), corner_weights(is_first ? k : image), reflection.normal);
    }
    return;
  }
  const auto& attachment = std::get<Attachment>(r.detail);
  for (std::size_t i = 0; i < attachment.points.size(); ++i) {
    const Weights a = trilinear_weights(attachment.local_a[i]);
    const Weights b = trilinear_weights(attachment.local_b[i]);
    add(is_first ? a : b, is_first ? b : a, std::nullopt);
  }
}

double residual(const PointConstraint& constraint, const Motion& motion) {
  double worst = 0;
  for (std::size_t s = 0; s < sample_count; ++s) {
    const Vec3 miss = interpolate(constraint.weights, motion[s]) - constraint.goal[s];
    worst = std::max(worst, miss.cwiseAbs().maxCoeff());
  }
  return worst;
}

RelationResiduals residuals(const std::vector<PointConstraint>& constraints, const Motion& motion) {
  RelationResiduals result;
  for (const PointConstraint& constraint : constraints) {
    if (result.empty() || result.back().first != constraint.relation) result.emplace_back(constraint.relation, 0.0);
    result.back().second = std::max(result.back().second, residual(constraint, motion));
  }
  return result;
}

GiNaC::ex SymbolicGoals::operator()(const PointConstraint& constraint, const Edits& edits, std::size_t coordinate) {
  const std::shared_ptr<const PartEdit>& edit = edits[constraint.other];
  auto found = known_.find(edit);
  if (found == known_.end())
    found = known_.emplace(edit, symbolic_motion(graph_->shape(), constraint.other, edit->steps)).first;
  const auto moved = [&](std::size_t c) {
    GiNaC::ex sum = 0;
    for (int k = 0; k < 8; ++k) {
      const double weight = constraint.other_weights[k];
      if (weight != 0) sum += number(weight) * found->second[static_cast<std::size_t>(k)][c];
    }
    return sum.expand();
  };
  if (!constraint.mirror) return moved(coordinate);
  // The planes of reflections are across global axes: mirroring changes the sign of one coordinate.
  const bool flips = std::abs((*constraint.mirror)[static_cast<int>(coordinate)]) > 0.5;
  return flips ? GiNaC::ex(-moved(coordinate)) : moved(coordinate);
}

}  // namespace parsel
