// parsel convert: an editing program from JSON to text and back.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/program_file.h"

namespace parsel::cli {
namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("convert takes one program");
  const Result<ProgramFile> file = load_program(arguments.positional[0]);
  if (!file.ok()) return refuse(file.error());
  if (file->form == ProgramForm::text) return write_json(arguments, to_json(file->program));
  const std::string text = to_text(file->program);
  if (!arguments.has("-o")) {
    std::cout << text;
    return std::cout.flush() ? exit_done : exit_refused;
  }
  const Status written = write_file(arguments.option("-o"), text);
  return written.ok() ? exit_done : refuse(written.error());
}

}  // namespace

extern const Command convert_command;
const Command convert_command = {"convert",
                                 "PROGRAM.json|PROGRAM.txt [-o OUT]",
                                 "Turns an editing program from JSON into text that can be edited by hand, or back.",
                                 {"-o"},
                                 {},
                                 run};

}  // namespace parsel::cli
