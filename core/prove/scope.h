// What a layer of a program touches: which parts it and the layers before it edit, which groups they dissolve, and
// which relations its report must name.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "core/edit/program.h"
#include "core/shape/shape.h"

namespace parsel {

struct Scope {
  /// Parts that a statement other than keep_fixed moves, in this layer or before it. A statement on a virtual part or
  /// on a group counts for the parent and for every instance.
  std::set<PartIndex> edited;
  /// Groups with a statement on one of their instances (keep_fixed too: it treats the instance as a part of its own),
  /// and disabled groups: an instance of a group whose relation is not to be kept is a part like any other.
  std::vector<RelationIndex> dissolved;
  /// In the shape's order: the active relations that touch an edited part, and every disabled group. The latter are
  /// listed even when nothing near them moves, because which relations are active depends on them.
  std::vector<RelationIndex> relations;
};

/// Whether `disabled` holds the relation's id, or "kind:" and its kind.
bool is_disabled(const Relation& relation, const std::set<std::string>& disabled);

/// `program` passed validate() for `shape`; layer < number of layers.
Scope scope_of(const Shape& shape, const Program& program, std::size_t layer, const std::set<std::string>& disabled);

/// How far a coordinate of the relation's constraint may be off: delta_one_edited (0.025/√3: a distance of 0.025 in
/// all) when one of its parts is edited, delta_both_edited (0.075/√3) when both are. A part that stays where it is
/// shows a gap at once and leaves its neighbour no say in it; two parts that move share the error of both edits. A
/// group and its parent always move together, so they count as both; the floor never moves.
double tolerance_of(const Relation& relation, const Scope& scope);

}  // namespace parsel
