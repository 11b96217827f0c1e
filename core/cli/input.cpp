#include "core/cli/input.h"

#include "core/base/json.h"
#include "core/cli/model.h"
#include "core/cli/program_file.h"

namespace parsel::cli {

Result<nlohmann::json> read_json(const std::string& path) {
  const Result<std::string> text = read_file(path);
  if (!text) return text.error();
  Result<nlohmann::json> json = json_from_text(*text, "cli");
  if (!json) return within(json.error(), path);
  return json;
}

Result<Corrections> read_corrections(const Arguments& arguments) {
  if (!arguments.has("--corrections")) return Corrections{};
  return read_json_as<Corrections>(arguments.option("--corrections"), corrections_from_file);
}

Result<Shape> read_shape(const std::string& path, const Corrections& corrections) {
  if (!path.ends_with(".json")) {
    Result<Model> model = load_model(path, {}, corrections);
    if (!model) return model.error();
    return std::move(model->abstraction.shape);
  }
  if (!corrections.empty()) {
    return Error{"cli", path, "a shape that was written down cannot be corrected any more",
                 "give the model, or parsel inspect MODEL --corrections FILE -o SHAPE.json"};
  }
  return read_json_as<Shape>(path, [](const nlohmann::json& json) -> Result<Shape> {
    Result<Shape> shape = shape_from_json(json);
    if (!shape) return shape;
    if (const Status valid = validate(*shape); !valid) return valid.error();
    return shape;
  });
}

Result<EditRequest> read_edit(const std::string& path) {
  return read_json_as<EditRequest>(path, edit_request_from_json);
}

Result<Program> read_program(const std::string& path, const Shape& shape) {
  Result<ProgramFile> file = load_program(path);
  if (!file) return within(file.error(), path);
  if (const Status valid = validate(file->program, shape); !valid) return within(valid.error(), path);
  return std::move(file->program);
}

}  // namespace parsel::cli
