// parsel score: the paper's three measures of a program against the true one.
#include <nlohmann/json.hpp>

#include "core/check/score.h"
#include "core/cli/command.h"
#include "core/cli/input.h"

namespace parsel::cli {

namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("score takes one model");
  if (!arguments.has("--truth")) return misuse("score needs --truth PROGRAM.json");
  if (!arguments.has("--program")) return misuse("score needs --program PROGRAM.json");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape) return refuse(shape.error());
  const Result<Program> truth = read_program(arguments.option("--truth"), *shape);
  if (!truth) return refuse(truth.error());
  const Result<Program> program = read_program(arguments.option("--program"), *shape);
  if (!program) return refuse(program.error());
  return write_json(arguments, to_json(score_program(*shape, *truth, *program)));
}

}  // namespace

extern const Command score_command;
const Command score_command = {"score",
                               "MODEL.glb|SHAPE.json --truth PROGRAM.json --program PROGRAM.json [-o SCORE.json]",
                               "Compares a program with the true one: operators, geometry, relations.",
                               {"--truth", "--program", "-o"},
                               {},
                               run};

}  // namespace parsel::cli
