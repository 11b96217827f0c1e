#include "core/cli/input.h"

#include "core/base/json.h"
#include "core/cli/model.h"
#include "core/cli/program_file.h"

namespace parsel::cli {

namespace {

Error at_path(Error error, const std::string& path) {
  if (error.place != path) error.place = path + (error.place.empty() ? "" : ", " + error.place);
  return error;
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

Result<nlohmann::json> read_json(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  Result<nlohmann::json> json = json_from_text(*text, "cli");
  if (!json) return at_path(json.error(), path);
  return json;
}

Result<Corrections> read_corrections(const Arguments& arguments) {
  if (!arguments.has("--corrections")) return Corrections{};
  const std::string path = arguments.option("--corrections");
  const Result<nlohmann::json> json = read_json(path);
  if (!json) return json.error();
  Result<Corrections> corrections = corrections_from_file(*json);
  if (!corrections) return at_path(corrections.error(), path);
  return corrections;
}

Result<Shape> read_shape(const std::string& path, const Corrections& corrections) {
  if (!ends_with(path, ".json")) {
    Result<Model> model = load_model(path, {}, corrections);
    if (!model) return model.error();
    return std::move(model->abstraction.shape);
  }
  if (!corrections.empty()) {
    return Error{"cli", path, "a shape that was written down cannot be corrected any more",
                 "give the model, or parsel inspect MODEL --corrections FILE -o SHAPE.json"};
  }
  const Result<nlohmann::json> json = read_json(path);
  if (!json) return json.error();
  Result<Shape> shape = shape_from_json(*json);
  if (!shape) return at_path(shape.error(), path);
  if (const Status valid = validate(*shape); !valid) return at_path(valid.error(), path);
  return shape;
}

Result<EditRequest> read_edit(const std::string& path) {
  const Result<nlohmann::json> json = read_json(path);
  if (!json) return json.error();
  Result<EditRequest> edit = edit_request_from_json(*json);
  if (!edit) return at_path(edit.error(), path);
  return edit;
}

Result<Program> read_program(const std::string& path, const Shape& shape) {
  Result<ProgramFile> file = load_program(path);
  if (!file) return at_path(file.error(), path);
  if (const Status valid = validate(file->program, shape); !valid) return at_path(valid.error(), path);
  return std::move(file->program);
}

}  // namespace parsel::cli
