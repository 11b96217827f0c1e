#include "core/check/check_scope.h"

#include <algorithm>

#include "core/base/random.h"

namespace parsel::replay {

namespace {

constexpr int even_values = 201;
constexpr int random_values = 40;

PartIndex parent(const Relation& group) {
  const auto* line = std::get_if<Translation>(&group.detail);
  return line != nullptr ? line->parent : std::get<Rotation>(group.detail).parent;
}

/// Who takes a part along: its group while it stands, else the part goes alone.
PartIndex taken_by(const Shape& shape, PartIndex p, const std::set<RelationIndex>& dissolved) {
  const Part& part = shape.parts[p];
  return part.group && dissolved.count(*part.group) == 0 ? parent(shape.relations[*part.group]) : p;
}

using Pair = std::pair<PartIndex, PartIndex>;

Pair takers(const Shape& shape, const Relation& relation, const std::set<RelationIndex>& dissolved) {
  const PartIndex a = taken_by(shape, relation.parts[0], dissolved);
  const PartIndex b = taken_by(shape, relation.parts[1], dissolved);
  return a < b ? Pair(a, b) : Pair(b, a);
}

/// Whether a program must say what becomes of a relation. `mirrored`: pairs of parts that count and mirror each other.
bool is_told(const Shape& shape, RelationIndex r, const std::set<RelationIndex>& dissolved,
             const std::set<Pair>& mirrored) {
  const Relation& relation = shape.relations[r];
  if (counts(shape, r, dissolved)) return true;
  if (relation.is_group()) return false;
  for (const PartIndex p : relation.parts) {
    const Part& part = shape.parts[p];
    if (part.is_virtual() && !counts(part, dissolved)) return false;
  }
  if (relation.kind == RelationKind::ground) return true;
  const Pair pair = takers(shape, relation, dissolved);
  if (pair.first == pair.second) return false;  // within one group: the group says it
  return relation.is_attachment() || mirrored.count(pair) == 0;
}

}  // namespace

bool counts(const Part& part, const std::set<RelationIndex>& dissolved) {
  return !part.group || (dissolved.count(*part.group) == 0) == part.is_virtual();
}

bool counts(const Shape& shape, RelationIndex r, const std::set<RelationIndex>& dissolved) {
  const Relation& relation = shape.relations[r];
  if (relation.is_group()) return dissolved.count(r) == 0;
  return std::all_of(relation.parts.begin(), relation.parts.end(),
                     [&](PartIndex p) { return counts(shape.parts[p], dissolved); });
}

Ties ties_of(const Replay& replay, std::size_t layers, const std::set<RelationIndex>& disabled) {
  const Shape& shape = replay.shape();
  Ties ties;
  for (const RelationIndex r : disabled) {
    if (shape.relations[r].is_group()) ties.dissolved.insert(r);
  }
  for (std::size_t l = 0; l < layers; ++l) {
    for (const Statement& s : replay.program().layers[l].statements) {
      const bool moves = s.op != Op::keep_fixed;
      std::optional<RelationIndex> group;
      if (s.op == Op::change_count || s.op == Op::change_delta) {
        group = replay.relation(s.relation);
      } else {
        const PartIndex p = *replay.part(s.part);
        const Part& part = shape.parts[p];
        if (moves) ties.moved.insert(p);
        if (part.is_virtual()) group = part.group;
        if (part.group && !part.is_virtual()) ties.dissolved.insert(*part.group);
      }
      if (!group || !moves) continue;
      const Relation& relation = shape.relations[*group];
      ties.moved.insert(relation.parts.begin(), relation.parts.end());
      ties.moved.insert(parent(relation));
    }
  }
  std::set<Pair> mirrored;
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    if (relation.kind == RelationKind::reflection && counts(shape, r, ties.dissolved))
      mirrored.insert(takers(shape, relation, ties.dissolved));
  }
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    const bool touched =
        std::any_of(relation.parts.begin(), relation.parts.end(), [&](PartIndex p) { return ties.moved.count(p) > 0; });
    const bool disabled_group = relation.is_group() && disabled.count(r) > 0;
    if (disabled_group || (touched && is_told(shape, r, ties.dissolved, mirrored))) ties.due.insert(r);
  }
  return ties;
}

std::set<RelationIndex> disabled_in(const Replay& replay, const Layer& layer) {
  std::set<RelationIndex> disabled;
  for (const RelationReport& report : layer.relations) {
    const auto relation = replay.relation(report.id);
    if (relation && report.status == RelationStatus::disabled) disabled.insert(*relation);
  }
  return disabled;
}

double tolerance(const Relation& relation, const std::set<PartIndex>& moved) {
  if (relation.kind == RelationKind::ground) return 0.0144;  // the floor stays
  const bool all =
      std::all_of(relation.parts.begin(), relation.parts.end(), [&](PartIndex p) { return moved.count(p) > 0; });
  return relation.is_group() || all ? 0.0433 : 0.0144;
}

std::vector<double> looked_at(const Parameter& parameter, std::size_t layer) {
  std::vector<double> values = {parameter.min, parameter.max};
  for (int i = 1; i + 1 < even_values; ++i) {
    values.push_back(parameter.min + (parameter.max - parameter.min) * i / (even_values - 1));
  }
  Random random(layer + 1);
  for (int i = 0; i < random_values; ++i) values.push_back(random.uniform(parameter.min, parameter.max));
  return values;
}

Values values_of(const Program& program) {
  Values values;
  for (const Layer& layer : program.layers) values[layer.parameter.name] = layer.parameter.value;
  return values;
}

}  // namespace parsel::replay
