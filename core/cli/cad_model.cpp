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

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

Result<cad::Model> read_cad(const std::string& path, const std::string& unit) {
  const auto at_path = [&](Error error) {
    error.place = path + (error.place.empty() ? "" : ", " + error.place);
    return error;
  };
  if (ends_with(path, ".json")) {
    const Result<nlohmann::json> json = read_json(path);
    if (!json) return json.error();
    Result<cad::Model> model = cad::model_from_json(*json);
    if (!model) return at_path(model.error());
    return model;
  }
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  Result<cad::Model> model = cad::read_scad(*text, std::filesystem::path(path).stem().string());
  if (!model) return at_path(model.error());
  model->unit = unit;
  tell(path, "echo", model->echoes);
  tell(path, "warning", model->warnings);
  return model;
}

}  // namespace parsel::cli
