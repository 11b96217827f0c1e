#include "core/shape/shape.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "core/base/result.h"

namespace parsel {
namespace {

constexpr std::array<std::string_view, 8> kind_names = {"reflection", "translation", "rotation", "point",
                                                        "line",       "face",        "volume",   "ground"};

/// The group that a part stands for or belongs to was dissolved.
bool is_dissolved(const Part& part, const std::vector<RelationIndex>& dissolved) {
  return part.group && std::find(dissolved.begin(), dissolved.end(), *part.group) != dissolved.end();
}

}  // namespace

PartIndex parent_of(const Relation& group) {
  if (const auto* translation = std::get_if<Translation>(&group.detail)) return translation->parent;
  return std::get<Rotation>(group.detail).parent;
}

std::optional<PartIndex> Shape::find_part(std::string_view id) const {
  for (const PartIndex p : parts.indices()) {
    if (parts[p].id == id) return p;
  }
  constexpr std::string_view prefix = "node:";
  if (!id.starts_with(prefix)) return std::nullopt;
  const std::string_view digits = id.substr(prefix.size());
  int node = -1;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), node);
  if (error != std::errc() || end != digits.data() + digits.size() || node < 0) return std::nullopt;
  for (const PartIndex p : parts.indices()) {
    if (parts[p].node == node) return p;
  }
  return std::nullopt;
}

std::optional<RelationIndex> Shape::find_relation(std::string_view id) const {
  for (const RelationIndex r : relations.indices()) {
    if (relations[r].id == id) return r;
  }
  return std::nullopt;
}

bool is_active(const Shape& shape, PartIndex part, const std::vector<RelationIndex>& dissolved) {
  const Part& p = shape.parts[part];
  if (!p.group) return true;
  return p.is_virtual() != is_dissolved(p, dissolved);
}

bool is_active(const Shape& shape, RelationIndex relation, const std::vector<RelationIndex>& dissolved) {
  const Relation& r = shape.relations[relation];
  if (r.is_group()) return std::find(dissolved.begin(), dissolved.end(), relation) == dissolved.end();
  return std::all_of(r.parts.begin(), r.parts.end(), [&](PartIndex p) { return is_active(shape, p, dissolved); });
}

std::vector<PartIndex> active_parts(const Shape& shape, const std::vector<RelationIndex>& dissolved) {
  std::vector<PartIndex> active = shape.parts.indices();
  std::erase_if(active, [&](PartIndex p) { return !is_active(shape, p, dissolved); });
  return active;
}

std::vector<RelationIndex> active_relations(const Shape& shape, const std::vector<RelationIndex>& dissolved) {
  std::vector<RelationIndex> active = shape.relations.indices();
  std::erase_if(active, [&](RelationIndex r) { return !is_active(shape, r, dissolved); });
  return active;
}

std::string_view to_string(RelationKind kind) {
  return kind_names[static_cast<std::size_t>(kind)];
}

std::optional<RelationKind> relation_kind(std::string_view text) {
  const auto found = std::find(kind_names.begin(), kind_names.end(), text);
  if (found == kind_names.end()) return std::nullopt;
  return static_cast<RelationKind>(found - kind_names.begin());
}

}  // namespace parsel
