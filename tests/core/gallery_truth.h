// How far an edited model is from the one that its generator builds with the edited parameters.
#pragma once

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/gallery/gallery.h"
#include "core/shape/abstraction.h"

namespace parsel::test {

struct LabelledBox {
  int node, primitive;
  std::string label;
  Corners corners;  ///< metres
};

/// Hausdorff distance of two sets of 8 corners: the order of corners does not matter.
inline double box_distance(const Corners& a, const Corners& b) {
  double worst = 0;
  for (int i = 0; i < 8; ++i) {
    worst = std::max(worst, (b.rowwise() - a.row(i)).rowwise().norm().minCoeff());
    worst = std::max(worst, (a.rowwise() - b.row(i)).rowwise().norm().minCoeff());
  }
  return worst;
}

/// Where an edit takes the corners of the generator's own boxes, as points of the cages that the abstraction found: the
/// two boxes of a part need not be equal. Instances of a group with a changed count have node -1.
inline std::vector<LabelledBox> edited_boxes(const Shape& shape, const State& state,
                                             const std::vector<GalleryPart>& at_rest) {
  std::vector<LabelledBox> boxes;
  const auto add = [&](const Part& part, int node, const Corners& cage) {
    for (const GalleryPart& truth : at_rest) {
      if (truth.node != part.node || truth.primitive != part.primitive) continue;
      Corners metres;
      for (int k = 0; k < 8; ++k) {
        const Vec3 local = part.hexahedron.local(shape.frame.to_normalised(truth.corners.row(k).transpose()));
        metres.row(k) = shape.frame.to_model(interpolate(trilinear_weights(local), cage)).transpose();
      }
      boxes.push_back({node, part.primitive, part.label, metres});
    }
  };
  for (const PartIndex p : shape.parts.indices()) {
    const Part& part = shape.parts[p];
    if (part.is_virtual()) continue;
    if (part.group && state.groups[*part.group].count_changed) continue;
    add(part, part.node, state.parts[p]);
  }
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    const GroupState& group = state.groups[r];
    if (!relation.is_group() || !group.count_changed) continue;
    const PartIndex source = relation.parts[static_cast<std::size_t>(std::max(group.source, 0))];
    for (const Corners& cage : group.instances) add(shape.parts[source], -1, cage);
  }
  return boxes;
}

/// Largest distance of a corner, as a share of `half_diagonal`, and the label of its part. Parts correspond by node
/// where the number of parts is that of the truth, else by label and place.
inline std::pair<double, std::string> distance_from_truth(const std::vector<LabelledBox>& edited,
                                                          const std::vector<GalleryPart>& truth, double half_diagonal) {
  std::pair<double, std::string> worst{0, ""};
  const auto note = [&](double distance, const std::string& label) {
    if (distance / half_diagonal > worst.first) worst = {distance / half_diagonal, label};
  };
  const bool by_node = edited.size() == truth.size() &&
                       std::all_of(edited.begin(), edited.end(), [](const LabelledBox& b) { return b.node >= 0; });
  const auto nearest = [&](const std::string& label, const Corners& corners, const auto& list) {
    double best = std::numeric_limits<double>::infinity();
    for (const auto& other : list) {
      if (other.label == label) best = std::min(best, box_distance(corners, other.corners));
    }
    return best;
  };
  for (const LabelledBox& box : edited) {
    if (!by_node) {
      note(nearest(box.label, box.corners, truth), box.label);
      continue;
    }
    double distance = std::numeric_limits<double>::infinity();
    for (const GalleryPart& part : truth) {
      if (part.node == box.node && part.primitive == box.primitive) distance = box_distance(box.corners, part.corners);
    }
    note(distance, box.label);
  }
  if (!by_node) {
    for (const GalleryPart& part : truth) note(nearest(part.label, part.corners, edited), part.label);
  }
  return worst;
}

}  // namespace parsel::test
