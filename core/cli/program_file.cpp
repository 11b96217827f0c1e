#include "core/cli/program_file.h"

#include <cmath>
#include <cstdlib>

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

Result<std::vector<double>> parameter_values(const Program& program, const Arguments& arguments) {
  std::vector<double> values;
  for (const Layer& layer : program.layers) values.push_back(layer.parameter.value);
  const auto [first, last] = arguments.options.equal_range("--set");
  for (auto option = first; option != last; ++option) {
    const std::string& text = option->second;
    const std::size_t equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
    std::size_t found = 0;
    while (found < values.size() && program.layers[found].parameter.name != name) ++found;
    if (found == values.size())
      return Error{"cli", "--set " + text, "no layer has this parameter", "write --set x1=0.2"};
    char* end = nullptr;
    values[found] = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !std::isfinite(values[found])) {
      return Error{"cli", "--set " + text, "there should be a number after =", "write --set x1=0.2"};
    }
    const Parameter& p = program.layers[found].parameter;
    if (values[found] < p.min || values[found] > p.max) {
      return Error{"cli", "--set " + text, "the value is outside the parameter's range", "stay within min and max"};
    }
  }
  return values;
}

}  // namespace parsel::cli
