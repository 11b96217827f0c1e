#include "core/prove/scope.h"

#include <algorithm>

#include "core/prove/slack.h"

namespace parsel {

namespace {

bool touches(const Relation& relation, const std::set<PartIndex>& edited) {
  return std::any_of(relation.parts.begin(), relation.parts.end(), [&](PartIndex p) { return edited.count(p) > 0; });
}

/// The group that a part is an instance of, or stands for, unless it is dissolved.
std::optional<RelationIndex> standing_group(const Part& part, const std::vector<RelationIndex>& dissolved) {
  if (!part.group || std::find(dissolved.begin(), dissolved.end(), *part.group) != dissolved.end()) return std::nullopt;
  return part.group;
}

/// The active part that a part goes with: the parent of its standing group, or the part itself.
PartIndex carrier(const Shape& shape, PartIndex part, const std::vector<RelationIndex>& dissolved) {
  const auto group = standing_group(shape.parts[part], dissolved);
  return group ? parent_of(shape.relations[*group]) : part;
}

using Pair = std::pair<PartIndex, PartIndex>;
Pair unordered(PartIndex a, PartIndex b) {
  return std::minmax(a, b);
}

/// Pairs of active parts that mirror each other.
std::set<Pair> mirrored_pairs(const Shape& shape, const std::vector<RelationIndex>& dissolved) {
  std::set<Pair> pairs;
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    if (relation.kind == RelationKind::reflection && is_active(shape, r, dissolved))
      pairs.insert(unordered(relation.parts[0], relation.parts[1]));
  }
  return pairs;
}

bool is_judged(const Shape& shape, RelationIndex r, const std::vector<RelationIndex>& dissolved,
               const std::set<Pair>& mirrored) {
  if (is_active(shape, r, dissolved)) return true;
  const Relation& relation = shape.relations[r];
  if (relation.is_group()) return false;
  for (const PartIndex p : relation.parts) {
    if (shape.parts[p].is_virtual() && !standing_group(shape.parts[p], dissolved)) return false;
  }
  if (relation.kind == RelationKind::ground) return true;
  const PartIndex a = carrier(shape, relation.parts[0], dissolved);
  const PartIndex b = carrier(shape, relation.parts[1], dissolved);
  return a != b && (relation.is_attachment() || mirrored.count(unordered(a, b)) == 0);
}

}  // namespace

bool is_judged(const Shape& shape, RelationIndex relation, const std::vector<RelationIndex>& dissolved) {
  return is_judged(shape, relation, dissolved, mirrored_pairs(shape, dissolved));
}

std::set<std::string> disabled_in(const Layer& layer) {
  std::set<std::string> ids;
  for (const RelationReport& report : layer.relations) {
    if (report.status == RelationStatus::disabled) ids.insert(report.id);
  }
  return ids;
}

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
  const std::set<Pair> mirrored = mirrored_pairs(shape, scope.dissolved);
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    const bool group_disabled = relation.is_group() && is_disabled(relation, disabled);
    if (group_disabled || (touches(relation, scope.edited) && is_judged(shape, r, scope.dissolved, mirrored))) {
      scope.relations.push_back(r);
    }
  }
  return scope;
}

double tolerance_of(const Relation& relation, const Scope& scope) {
  return tolerance_of(relation, scope.edited.count(relation.parts[0]) > 0,
                      scope.edited.count(relation.parts.back()) > 0);
}

}  // namespace parsel
