#include "tests/eval/seeds.h"

#include <cmath>

namespace parsel::eval {
namespace {

using nlohmann::json;

json edit_of(const json& statement) {
  return {{"format", "parsel/edit"}, {"version", 1}, {"seed", json::array({statement})}};
}

json unit(int axis) {
  json direction = {0, 0, 0};
  direction[static_cast<std::size_t>(axis)] = 1;
  return direction;
}

}  // namespace

std::vector<NamedEdit> automatic_edits(const Shape& shape) {
  std::vector<PartIndex> parts;
  std::size_t real = 0;
  for (const Part& part : shape.parts) real += !part.is_virtual();
  if (real < 4) return {};
  for (const PartIndex p : active_parts(shape)) {
    if (!shape.parts[p].is_virtual()) parts.push_back(p);
  }
  if (parts.empty()) parts = active_parts(shape);  // nothing but groups

  std::vector<NamedEdit> edits;
  constexpr const char* names[] = {"widen", "raise", "deepen"};
  for (const int axis : {0, 1, 2}) {
    const auto extent = [&](PartIndex p) {
      const auto column = shape.parts[p].hexahedron.corners.col(axis);
      return column.maxCoeff() - column.minCoeff();
    };
    PartIndex longest = parts[0];
    for (const PartIndex p : parts) {
      if (extent(p) > extent(longest) + 1e-9) longest = p;
    }
    const std::string& id = shape.parts[longest].id;
    const json at = {0, axis == 1 ? -1 : 0, 0};
    edits.push_back({names[axis], edit_of({{"op", "scale_1d"},
                                           {"part", id},
                                           {"origin", {{"part", id}, {"at", at}}},
                                           {"direction", unit(axis)},
                                           {"amount", "x"}})});
  }

  PartIndex end = parts[0];
  int end_axis = 0;
  double farthest = -1;
  for (const PartIndex p : parts) {
    const Vec3 centre = shape.parts[p].hexahedron.corners.colwise().mean().transpose();
    for (const int axis : {0, 1, 2}) {
      if (std::abs(centre[axis]) <= farthest + 1e-9) continue;
      farthest = std::abs(centre[axis]);
      end = p;
      end_axis = axis;
    }
  }
  edits.push_back(
      {"move_end",
       edit_of({{"op", "translate"}, {"part", shape.parts[end].id}, {"direction", unit(end_axis)}, {"amount", "x"}})});

  int groups = 0;
  for (const Relation& relation : shape.relations) {
    if (!relation.is_group() || ++groups > 2) continue;
    const std::string suffix = groups == 1 ? "" : "_2";
    edits.push_back(
        {"count" + suffix,
         edit_of({{"op", "change_count"}, {"relation", relation.id}, {"anchor", "fit"}, {"amount", "8*x"}})});
    edits.push_back(
        {"spacing" + suffix, edit_of({{"op", "change_delta"}, {"relation", relation.id}, {"amount", "x"}})});
  }
  return edits;
}

}  // namespace parsel::eval
