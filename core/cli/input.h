// Reads what several commands take: a model's shape, a program for it, JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "core/base/result.h"
#include "core/cli/command.h"
#include "core/edit/program.h"
#include "core/propagate/edit_request.h"
#include "core/shape/corrections.h"
#include "core/shape/shape.h"

namespace parsel::cli {

/// The corrections in the file that the option --corrections names; none without it. Error places begin with the path.
Result<Corrections> read_corrections(const Arguments& arguments);

/// The shape of a .glb or .gltf model, or one that `parsel inspect` wrote (.json), which is corrected already.
Result<Shape> read_shape(const std::string& path, const Corrections& corrections = {});

Result<nlohmann::json> read_json(const std::string& path);

/// What `read` (JSON to Result<T>) makes of the JSON in a file. Error places begin with the path.
template <class T, class Read>
Result<T> read_json_as(const std::string& path, Read&& read) {
  const Result<nlohmann::json> json = read_json(path);
  if (!json) return json.error();
  Result<T> made = read(*json);
  if (!made) return within(made.error(), path);
  return made;
}

/// An edit request, format parsel/edit. Error places begin with the path.
Result<EditRequest> read_edit(const std::string& path);

/// A program (JSON or text) that passes validate() for the shape. Error places begin with the path.
Result<Program> read_program(const std::string& path, const Shape& shape);

}  // namespace parsel::cli
