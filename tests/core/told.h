// Which joints a program tears without saying so, by a plain look at the corners.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/tolerance.h"
#include "core/edit/evaluate.h"
#include "core/shape/shape.h"

namespace parsel::test {

/// Ids of the attachments of two real parts, not instances of one group, that are further apart than any tolerance at
/// one of 17 values of the first layer's parameter, and that the layer neither calls broken nor disabled. Joints of
/// instances whose number has changed are passed over: their parts are no more.
inline std::vector<std::string> untold_gaps(const Shape& shape, const Program& program) {
  const Layer& layer = program.layers[0];
  const Evaluator evaluate(program, shape);
  std::vector<State> states;
  for (int i = 0; i <= 16; ++i) {
    states.push_back(evaluate({layer.parameter.min + (layer.parameter.max - layer.parameter.min) * i / 16}));
  }
  std::vector<std::string> untold;
  for (const Relation& relation : shape.relations) {
    const auto* joint = std::get_if<Attachment>(&relation.detail);
    if (joint == nullptr) continue;
    const PartIndex a = relation.parts[0], b = relation.parts[1];
    const Part &part_a = shape.parts[a], &part_b = shape.parts[b];
    if (part_a.is_virtual() || part_b.is_virtual() || (part_a.group && part_a.group == part_b.group)) continue;
    const auto is_told = [&](const RelationReport& report) {
      return report.id == relation.id && report.status != RelationStatus::held;
    };
    if (std::any_of(layer.relations.begin(), layer.relations.end(), is_told)) continue;
    double worst = 0;
    for (const State& state : states) {
      const auto is_gone = [&](const Part& part) { return part.group && state.groups[*part.group].count_changed; };
      if (is_gone(part_a) || is_gone(part_b)) continue;
      for (std::size_t i = 0; i < joint->points.size(); ++i) {
        const Weights in_a = trilinear_weights(joint->local_a[i]), in_b = trilinear_weights(joint->local_b[i]);
        const Vec3 by_a = interpolate(in_a, state.parts[a] - part_a.hexahedron.corners);
        const Vec3 by_b = interpolate(in_b, state.parts[b] - part_b.hexahedron.corners);
        worst = std::max(worst, (by_a - by_b).cwiseAbs().maxCoeff());
      }
    }
    if (worst > delta_both_edited) untold.push_back(relation.id);
  }
  return untold;
}

}  // namespace parsel::test
