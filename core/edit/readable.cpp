#include "core/edit/readable.h"

#include <nlohmann/json.hpp>

namespace parsel {

Status readable(const Program& program, const Shape& shape) {
  const Result<Program> read = program_from_json(to_json(program));
  if (!read.ok()) return read.error();
  return validate(*read, shape);
}

}  // namespace parsel
