// parsel compose: programs on programs, so that their sliders can be moved together.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/edit/readable.h"
#include "core/propagate/compose.h"
#include "core/prove/stack.h"

namespace parsel::cli {
namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() < 2) return misuse("compose takes a model and one or more programs");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  std::vector<Program> programs;
  for (std::size_t i = 1; i < arguments.positional.size(); ++i) {
    const Result<Program> program = read_program(arguments.positional[i], *shape);
    if (!program.ok()) return refuse(program.error());
    programs.push_back(*program);
  }
  Result<Program> composed = stack_programs(*shape, programs);
  if (!composed.ok()) return refuse(composed.error());
  const StackVerdict verdict = judge_stack(*shape, *composed);
  std::cerr << in_words(verdict) << '\n';
  prove_anew(*shape, *composed);
  if (const Status ready = readable(*composed, *shape); !ready.ok()) return refuse(ready.error());
  return write_json(arguments, to_json(*composed));
}

}  // namespace

extern const Command compose_command;
const Command compose_command = {
    "compose",
    "MODEL.glb|SHAPE.json PROGRAM... [-o PROGRAM.json]",
    "Puts programs onto each other as the layers of one, each worked out on what those before it leave, and says what "
    "they keep together.",
    {"-o"},
    {},
    run};

}  // namespace parsel::cli
