#include "core/cli/cad_model.h"

#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/base/text.h"
#include "core/cad/scad_flatten.h"
#include "core/cli/command.h"
#include "core/cli/input.h"

namespace parsel::cli {

namespace {

void tell(const std::string& path, const char* kind, const std::vector<cad::Notice>& notices) {
  for (const cad::Notice& notice : notices) {
    std::cerr << kind << ": " << path << (notice.place.line > 0 ? ", " + cad::to_string(notice.place) : "") << ": "
              << notice.text << '\n';
  }
}

}  // namespace

Result<cad::Model> read_cad(const std::string& path, const std::string& unit) {
  if (path.ends_with(".json")) return read_json_as<cad::Model>(path, cad::model_from_json);
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  Result<cad::Model> model = cad::read_scad(*text, std::filesystem::path(path).stem().string());
  if (!model) return within(model.error(), path);
  model->unit = unit;
  tell(path, "echo", model->echoes);
  tell(path, "warning", model->warnings);
  return model;
}

}  // namespace parsel::cli
