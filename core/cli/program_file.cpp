#include "core/cli/program_file.h"

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "core/base/json.h"

namespace parsel::cli {

Result<ProgramFile> load_program(const std::string& path) {
  const Result<std::string> bytes = read_file(path);
  if (!bytes.ok()) return bytes.error();
  const std::size_t first = bytes->find_first_not_of(" \t\r\n");
  if (first == std::string::npos || (*bytes)[first] != '{') {
    Result<Program> program = program_from_text(*bytes);
    if (!program.ok()) return program.error();
    return ProgramFile{std::move(*program), ProgramForm::text};
  }
  const Result<nlohmann::json> json = json_from_text(*bytes, "cli");
  if (!json.ok()) return json.error();
  Result<Program> program = program_from_json(*json);
  if (!program.ok()) return program.error();
  return ProgramFile{std::move(*program), ProgramForm::json};
}

Status set_value(const Program& program, const std::string& parameter, double value, const std::string& place,
                 std::vector<double>& values) {
  std::string known;
  for (std::size_t i = 0; i < program.layers.size(); ++i) {
    const Parameter& p = program.layers[i].parameter;
    known += (known.empty() ? "" : ", ") + p.name;
    if (p.name != parameter) continue;
    if (!(value >= p.min && value <= p.max)) {
      std::ostringstream range;
      range << "stay within " << p.min << " and " << p.max;
      return Error{"cli", place, "the value is outside the parameter's range", range.str()};
    }
    values[i] = value;
    return success();
  }
  return Error{"cli", place, "no layer has this parameter", known.empty() ? "leave it out" : "name one of " + known};
}

Result<std::vector<double>> parameter_values(const Program& program, const Arguments& arguments) {
  std::vector<double> values;
  for (const Layer& layer : program.layers) values.push_back(layer.parameter.value);
  const auto [first, last] = arguments.options.equal_range("--set");
  for (auto option = first; option != last; ++option) {
    const std::string& text = option->second;
    const std::size_t equals = text.find('=');
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !std::isfinite(value)) {
      return Error{"cli", "--set " + text, "there should be a number after =", "write --set x1=0.2"};
    }
    if (const Status set = set_value(program, text.substr(0, equals), value, "--set " + text, values); !set) {
      return set.error();
    }
  }
  return values;
}

}  // namespace parsel::cli
