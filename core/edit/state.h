// The state of a shape under edit: what evaluate.h computes.
#pragma once

#include <vector>

#include "core/shape/shape.h"

namespace parsel {

/// A translation or rotation group under edit.
struct GroupState {
  std::vector<Corners> instances;  ///< in order; as many as the relation has parts until a change_count
  bool count_changed = false;      ///< a change_count has changed the number at least once
  int source = -1;                 ///< the member that all instances are copies of once count_changed, else -1
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();    ///< translation
  Vec3 centre = Vec3::Zero(), axis = Vec3::Zero();  ///< rotation
  double radius = 0;                                ///< rotation
};

struct State {
  PartData<Corners> parts;          ///< member k of a group: its instance min(k, n - 1)
  RelationData<GroupState> groups;  ///< empty for relations that are no group
};

}  // namespace parsel
