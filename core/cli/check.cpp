// parsel check: the independent checker of programs and traces.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/check/check.h"
#include "core/cli/command.h"
#include "core/cli/input.h"

namespace parsel::cli {

namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("check takes a model and a program");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape) return refuse(shape.error());
  const Result<Program> program = read_program(arguments.positional[1], *shape);
  if (!program) return refuse(program.error());
  CheckReport report;
  if (arguments.has("--trace")) {
    const Result<nlohmann::json> trace = read_json(arguments.option("--trace"));
    if (!trace) return refuse(trace.error());
    if (program->layers.empty()) {
      return refuse({"check", "--trace", "the program has no layer that a trace could speak of", "leave --trace out"});
    }
    // A trace tells of the propagation that made the newest layer.
    report = check_program(*shape, *program, *trace, program->layers.size() - 1);
  } else {
    report = check_program(*shape, *program);
  }
  const int written = write_json(arguments, to_json(report));
  if (written != exit_done || report.accepted()) return written;
  for (const Finding& finding : report.findings)
    std::cerr << "check: " << finding.place << ": " << finding.text << "; " << finding.fix << ".\n";
  return exit_refused;
}

}  // namespace

extern const Command check_command;
const Command check_command = {"check",
                               "MODEL.glb|SHAPE.json PROGRAM [--trace TRACE.json] [-o REPORT.json]",
                               "Checks a program's claims, and those of its trace, by independent means.",
                               {"--trace", "-o"},
                               {},
                               run};

}  // namespace parsel::cli
