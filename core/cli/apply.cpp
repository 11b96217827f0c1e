// parsel apply: an edited model, or one that plays the edit, as GLB.
#include "core/edit/apply.h"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/model.h"

namespace parsel::cli {
namespace {

Error refusal(std::string place, std::string cause, std::string fix) {
  return {"cli/apply", std::move(place), std::move(cause), std::move(fix)};
}

/// The program in either of its forms.
Result<Program> read_program(const std::string& path) {
  const auto text = read_file(path);
  if (!text) return text.error();
  const std::size_t first = text->find_first_not_of(" \t\r\n");
  if (first == std::string::npos || (*text)[first] != '{') return program_from_text(*text);
  const nlohmann::json json = nlohmann::json::parse(*text, nullptr, false);
  if (json.is_discarded()) return refusal(path, "this is not valid JSON", "check that the file is complete");
  return program_from_json(json);
}

std::string number_text(double value) {
  return nlohmann::json(value).dump();
}

/// `name=number` for a parameter of the program.
Status set_value(const Program& program, const std::string& setting, std::vector<double>& values) {
  const std::size_t equals = setting.find('=');
  const std::string name = setting.substr(0, equals);
  const std::string text = equals == std::string::npos ? "" : setting.substr(equals + 1);
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !std::isfinite(value)) {
    return refusal("--set " + setting, "this is not name=number", "write it like --set x1=0.2");
  }
  for (std::size_t i = 0; i < program.layers.size(); ++i) {
    const Parameter& parameter = program.layers[i].parameter;
    if (parameter.name != name) continue;
    if (value < parameter.min || value > parameter.max) {
      return refusal("--set " + setting, "the value is outside of the parameter's range",
                     "choose one from " + number_text(parameter.min) + " to " + number_text(parameter.max));
    }
    values[i] = value;
    return success();
  }
  return refusal("--set " + setting, "the program has no such parameter", "set one that it has");
}

Result<std::vector<PartIndex>> parts_of(const Shape& shape, const std::string& list) {
  std::vector<PartIndex> parts;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    const std::string id = list.substr(at, comma - at);
    const auto part = shape.find_part(id);
    if (!part) return refusal("--only " + id, "the model has no such part", "parsel inspect lists them");
    parts.push_back(*part);
    at = comma + 1;
  }
  return parts;
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("apply takes a model and a program");
  if (!arguments.has("-o")) return misuse("apply needs -o for the file that it writes");
  const auto model = load_model(arguments.positional[0]);
  if (!model) return refuse(model.error());
  const Shape& shape = model->abstraction.shape;
  const auto program = read_program(arguments.positional[1]);
  if (!program) return refuse(program.error());
  if (const Status valid = validate(*program, shape); !valid.ok()) return refuse(valid.error());

  std::vector<double> values;
  for (const Layer& layer : program->layers) values.push_back(layer.parameter.value);
  const auto [first, last] = arguments.options.equal_range("--set");
  for (auto setting = first; setting != last; ++setting) {
    if (const Status set = set_value(*program, setting->second, values); !set.ok()) return refuse(set.error());
  }
  std::optional<Animate> animate;
  if (arguments.has("--animate")) animate = Animate{arguments.option("--animate")};
  ApplyOptions options;
  options.external = model->buffers;
  if (arguments.has("--only")) {
    auto parts = parts_of(shape, arguments.option("--only"));
    if (!parts) return refuse(parts.error());
    options.only_parts = std::move(parts).value();
  }

  const auto applied = apply_program(model->bytes, shape, *program, values, animate, std::move(options));
  if (!applied) return refuse(applied.error());
  for (const Warning& warning : applied->warnings) {
    std::cerr << "warning: " << warning.place << ": " << warning.text << '\n';
  }
  const Status written = write_file(arguments.option("-o"), applied->glb);
  return written.ok() ? exit_done : refuse(written.error());
}

}  // namespace

extern const Command apply_command;
const Command apply_command = {
    "apply",
    "MODEL.glb PROGRAM.json [--set x1=0.2 …] [--animate x1] [--only part,part] -o OUT.glb",
    "Writes the model as the program edits it (--animate: with an animation that plays the parameter).",
    {"--set", "--animate", "--only", "-o"},
    {},
    run};

}  // namespace parsel::cli
