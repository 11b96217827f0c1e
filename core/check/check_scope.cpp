#include "core/check/check_scope.h"

namespace parsel::replay {

namespace {

bool part_counts(const Shape& shape, const Part& part, const std::set<std::string>& dissolved) {
  if (!part.group) return true;
  const bool stands = dissolved.count(shape.relations[*part.group].id) == 0;
  return stands == part.is_virtual();
}

std::vector<const Part*> all_parts(const Shape& shape, const Relation& group) {
  std::vector<const Part*> parts;
  for (const Part& part : shape.parts) {
    if (part.group && shape.relations[*part.group].id == group.id) parts.push_back(&part);
  }
  return parts;
}

}  // namespace

bool counts(const Shape& shape, const Relation& relation, const std::set<std::string>& dissolved) {
  if (relation.is_group()) return dissolved.count(relation.id) == 0;
  for (const PartIndex p : relation.parts) {
    if (!part_counts(shape, shape.parts[p], dissolved)) return false;
  }
  return true;
}

Ties ties_of(const Shape& shape, const Program& program, std::size_t layers, const std::set<std::string>& disabled) {
  Ties ties;
  for (const Relation& relation : shape.relations) {
    if (relation.is_group() && disabled.count(relation.id) > 0) ties.dissolved.insert(relation.id);
  }
  for (std::size_t l = 0; l < layers; ++l) {
    for (const Statement& s : program.layers[l].statements) {
      const bool moves = s.op != Op::keep_fixed;
      const Relation* group = nullptr;
      if (s.op == Op::change_count || s.op == Op::change_delta) {
        group = &shape.relations[*shape.find_relation(s.relation)];
      } else {
        const Part& part = shape.parts[*shape.find_part(s.part)];
        if (moves) ties.moved.insert(part.id);
        if (part.is_virtual()) group = &shape.relations[*part.group];
        if (part.group && !part.is_virtual()) ties.dissolved.insert(shape.relations[*part.group].id);
      }
      if (group == nullptr || !moves) continue;
      for (const Part* part : all_parts(shape, *group)) ties.moved.insert(part->id);
    }
  }
  for (const Relation& relation : shape.relations) {
    bool touched = false;
    for (const PartIndex p : relation.parts) touched = touched || ties.moved.count(shape.parts[p].id) > 0;
    const bool disabled_group = relation.is_group() && disabled.count(relation.id) > 0;
    if (disabled_group || (touched && counts(shape, relation, ties.dissolved))) ties.due.insert(relation.id);
  }
  return ties;
}

double tolerance(const Shape& shape, const Relation& relation, const std::set<std::string>& moved) {
  if (relation.kind == RelationKind::ground) return 0.0144;
  bool all = true;
  for (const PartIndex p : relation.parts) all = all && moved.count(shape.parts[p].id) > 0;
  return relation.is_group() || all ? 0.0433 : 0.0144;
}

}  // namespace parsel::replay
