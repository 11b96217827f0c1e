#include "core/cli/program_file.h"

#include <nlohmann/json.hpp>

#include "core/cli/command.h"

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
  const nlohmann::json json = nlohmann::json::parse(*bytes, nullptr, false);
  if (json.is_discarded())
    return Error{"cli", path, "it is not valid JSON", "check it for missing commas and brackets"};
  Result<Program> program = program_from_json(json);
  if (!program.ok()) return program.error();
  return ProgramFile{std::move(*program), ProgramForm::json};
}

}  // namespace parsel::cli
