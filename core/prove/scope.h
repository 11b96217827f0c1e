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
  /// In the shape's order: the judged relations (see is_judged()) that touch an edited part, and every disabled group.
  /// The latter are listed even when nothing near them moves, because which relations are judged depends on them.
  std::vector<RelationIndex> relations;
};

/// Whether a relation rests on parts that are there, and says something that no other does. Every joint that holds at
/// rest is judged at the end, whoever carried its parts there, so these are more than the relations that are active
/// (shape.h), which the search follows:
///   * a group while it stands, and what ties its parent, as long as it stands;
///   * every attachment of a real part. An instance of a standing group goes where the group takes it, and may leave a
///     neighbour that only the parent's own joint, at the corners of the parent's box, keeps up with;
///   * the ground of a real part, for the same reason: a foot that its group lifts has left the floor;
///   * a reflection of instances unless their groups (or a group and the part itself) have one already: that and the
///     groups say it all.
/// But for the relations of two instances of one standing group: their place in it is what the group says.
bool is_judged(const Shape& shape, RelationIndex relation, const std::vector<RelationIndex>& dissolved);

/// What the layer's report calls disabled: ids of relations.
std::set<std::string> disabled_in(const Layer& layer);

/// Whether `disabled` holds the relation's id, or "kind:" and its kind.
bool is_disabled(const Relation& relation, const std::set<std::string>& disabled);

/// `program` passed validate() for `shape`; layer < number of layers.
Scope scope_of(const Shape& shape, const Program& program, std::size_t layer, const std::set<std::string>& disabled);

/// The tolerance of slack.h, where the edited parts are those that move.
double tolerance_of(const Relation& relation, const Scope& scope);

}  // namespace parsel
