// Shapes of test models, checked, and their relations as lines of text that tests can compare.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/shape/abstraction.h"
#include "tests/core/glb_fixture.h"

namespace parsel::fixture {

inline Abstraction abstraction(const std::string& glb, const std::string& name = "test") {
  Result<Abstraction> result = abstract_shape(glb, name);
  REQUIRE_MESSAGE(result.ok(), (result.ok() ? "" : result.error().message()));
  const Status sound = validate(result->shape);
  CHECK_MESSAGE(sound.ok(), (sound.ok() ? "" : sound.error().message()));
  return std::move(*result);
}

inline Shape shape(const std::vector<Named>& parts) {
  return abstraction(model(parts)).shape;
}

/// "reflection leg_back_left leg_front_left", sorted; the parts of a pair in the order of their names.
inline std::vector<std::string> relations(const Shape& shape, bool active_only = false) {
  std::vector<std::string> lines;
  for (const RelationIndex r : active_only ? active_relations(shape) : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    std::vector<std::string> ids;
    for (const PartIndex p : relation.parts) ids.push_back(shape.parts[p].id);
    if (!relation.is_group()) std::sort(ids.begin(), ids.end());
    std::string line(to_string(relation.kind));
    for (const std::string& id : ids) line += " " + id;
    lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

inline std::size_t count(const Shape& shape, RelationKind kind) {
  return static_cast<std::size_t>(
      std::count_if(shape.relations.begin(), shape.relations.end(), [&](const Relation& r) { return r.kind == kind; }));
}

/// The kind of the attachment between two parts, "" when there is none.
inline std::string attached(const Shape& shape, const std::string& a, const std::string& b) {
  const auto pa = shape.find_part(a), pb = shape.find_part(b);
  REQUIRE_MESSAGE((pa && pb), a << " " << b);
  for (const Relation& r : shape.relations) {
    if (!r.is_attachment()) continue;
    if ((r.parts[0] == *pa && r.parts[1] == *pb) || (r.parts[0] == *pb && r.parts[1] == *pa)) {
      return std::string(to_string(r.kind));
    }
  }
  return "";
}

}  // namespace parsel::fixture
