// parsel propagate: from seed edits to a whole editing program.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/edit/readable.h"
#include "core/propagate/compose.h"
#include "core/propagate/propagate.h"
#include "core/prove/stack.h"

namespace parsel::cli {
namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("propagate takes a model and an edit");
  if (const Status allowed = may_write(arguments, "--trace"); !allowed.ok()) return refuse(allowed.error());
  const Result<Corrections> corrections = read_corrections(arguments);
  if (!corrections.ok()) return refuse(corrections.error());
  const Result<Shape> shape = read_shape(arguments.positional[0], *corrections);
  if (!shape.ok()) return refuse(shape.error());
  const Result<EditRequest> request = read_edit(arguments.positional[1]);
  if (!request.ok()) return refuse(request.error());
  PropagateOptions options;
  options.request = arguments.option("--request");
  options.neighbour_edits = !arguments.has("--no-neighbour-edits");
  options.breaking_edits = !arguments.has("--no-breaking-edits");
  const Result<Propagation> found = propagate(*shape, *request, options);
  if (!found.ok()) return refuse(found.error());
  if (arguments.has("--trace")) {
    const std::string trace =
        to_json(found->trace).dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    if (const Status written = write_file(arguments.option("--trace"), trace); !written.ok())
      return refuse(written.error());
  }
  for (const std::string& note : found->trace.notes) std::cerr << "note: " << note << '\n';
  if (!arguments.has("--onto")) return write_json(arguments, to_json(found->program));
  const Result<Program> there = read_program(arguments.option("--onto"), *shape);
  if (!there.ok()) return refuse(there.error());
  Result<Program> both = stack_programs(*shape, {*there, found->program});
  if (!both.ok()) return refuse(both.error());
  std::cerr << "note: " << in_words(judge_stack(*shape, *both)) << '\n';
  prove_anew(*shape, *both);
  if (const Status ready = readable(*both, *shape); !ready.ok()) return refuse(ready.error());
  return write_json(arguments, to_json(*both));
}

}  // namespace

extern const Command propagate_command;
const Command propagate_command = {
    "propagate",
    "MODEL.glb|SHAPE.json EDIT.json [--corrections FILE.json] [--onto PROGRAM] [-o PROGRAM.json] [--trace TRACE.json] "
    "[--request TEXT] "
    "[--no-neighbour-edits] [--no-breaking-edits]",
    "Finds the edits that follow from seed edits, as a program (--trace: and why; --onto: as the last layer of a "
    "program, "
    "worked out on what its other layers leave).",
    {"-o", "--trace", "--request", "--onto", "--corrections"},
    {"--no-neighbour-edits", "--no-breaking-edits"},
    run};

}  // namespace parsel::cli
