// Edits of translation and rotation groups: top-down, when the parent is edited and its instances follow, and
// bottom-up, when the group is edited and its parent follows. The rules stand in evaluate.h. ParSEL supplement §3.2.
#pragma once

#include <vector>

#include "core/edit/program.h"
#include "core/edit/state.h"

namespace parsel {

/// What an evaluator keeps of a translation or rotation relation.
struct Group {
  RelationIndex relation;
  PartIndex parent;
  std::vector<PartIndex> members;
  bool ring = false;  ///< a rotation
  int axis = 0;       ///< line: local axis of the parent that the instances follow; ring: parent_axis
  int direction = 1;  ///< line: 1 when they run along +axis; ring: sign of the ring's axis along it at rest
  Vec3 rest_delta = Vec3::Zero();  ///< line: the spacing at rest
};

/// The translation and rotation groups of a shape, in the order of its relations.
std::vector<Group> groups_of(const Shape& shape);

/// A geometric operator on the parent: its corners and the group's instances and points.
void edit_parent(const Group& group, const ResolvedOperator& op, double amount, Corners& parent, GroupState& state);

/// change_count or change_delta.
void edit_group(const Group& group, Op op, double amount, Anchor anchor, Corners& parent, GroupState& state);

}  // namespace parsel
