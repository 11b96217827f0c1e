#include "core/prove/scope.h"

#include <algorithm>

#include "core/base/tolerance.h"

namespace parsel {

namespace {

bool touches(const Relation& relation, const std::set<PartIndex>& edited) {
  return std::any_of(relation.parts.begin(), relation.parts.end(), [&](PartIndex p) { return edited.count(p) > 0; });
}

}  // namespace

bool is_disabled(const Relation& relation, const std::set<std::string>& disabled) {
  return disabled.count(relation.id) > 0 || disabled.count("kind:" + std::string(to_string(relation.kind))) > 0;
}

Scope scope_of(const Shape& shape, const Program& program, std::size_t layer, const std::set<std::string>& disabled) {
  PARSEL_ASSERT(layer < program.layers.size(), "the layer exists");
  Scope scope;
  std::set<RelationIndex> dissolved;
  for (std::size_t l = 0; l <= layer; ++l) {
    for (const Statement& statement : program.layers[l].statements) {
      std::vector<PartIndex> moved;
      if (!is_geometric(statement.op)) {
        const auto group = shape.find_relation(statement.relation);
        PARSEL_ASSERT(group, "a validated program names relations of the shape");
        moved = shape.relations[*group].parts;
        moved.push_back(parent_of(shape.relations[*group]));
      } else {
        const auto part = shape.find_part(statement.part);
        PARSEL_ASSERT(part, "a validated program names parts of the shape");
        moved = shape.parts[*part].members;
        moved.push_back(*part);
        if (!shape.parts[*part].is_virtual() && shape.parts[*part].group) dissolved.insert(*shape.parts[*part].group);
      }
      if (statement.op == Op::keep_fixed) continue;
      scope.edited.insert(moved.begin(), moved.end());
    }
  }
  for (const RelationIndex r : shape.relations.indices()) {
    if (shape.relations[r].is_group() && is_disabled(shape.relations[r], disabled)) dissolved.insert(r);
  }
  scope.dissolved.assign(dissolved.begin(), dissolved.end());
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    const bool group_disabled = relation.is_group() && is_disabled(relation, disabled);
    if (group_disabled || (is_active(shape, r, scope.dissolved) && touches(relation, scope.edited))) {
      scope.relations.push_back(r);
    }
  }
  return scope;
}

double tolerance_of(const Relation& relation, const Scope& scope) {
  const bool all =
      std::all_of(relation.parts.begin(), relation.parts.end(), [&](PartIndex p) { return scope.edited.count(p) > 0; });
  if (relation.kind == RelationKind::ground) return delta_one_edited;
  return all || relation.is_group() ? delta_both_edited : delta_one_edited;
}

}  // namespace parsel
