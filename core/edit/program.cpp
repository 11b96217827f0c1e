#include "core/edit/program.h"

#include "core/shape/shape.h"

namespace parsel {

std::optional<PartIndex> part_of(const Shape& shape, const Statement& statement) {
  if (is_geometric(statement.op)) return shape.find_part(statement.part);
  const auto relation = shape.find_relation(statement.relation);
  if (!relation) return std::nullopt;
  if (!shape.relations[*relation].is_group()) return std::nullopt;
  return parent_of(shape.relations[*relation]);
}

}  // namespace parsel
