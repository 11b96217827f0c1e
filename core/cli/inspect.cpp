// parsel inspect: a model's structured shape, as JSON or in words.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/model.h"
#include "core/shape/words.h"

namespace parsel::cli {
namespace {

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("inspect takes one model");
  const Result<Corrections> corrections = read_corrections(arguments);
  if (!corrections.ok()) return refuse(corrections.error());
  const Result<Model> model = load_model(arguments.positional[0], {}, *corrections);
  if (!model.ok()) return refuse(model.error());
  const Shape& shape = model->abstraction.shape;
  for (const Warning& warning : shape.warnings)
    std::cerr << "warning: " << warning.place << ": " << warning.text << '\n';
  if (!arguments.has("--words")) return write_json(arguments, to_json(shape));
  const std::string words = describe(shape) + describe_ground(shape);
  if (!arguments.has("-o")) {
    std::cout << words;
    return std::cout.flush() ? exit_done : exit_refused;
  }
  const Status written = write_file(arguments.option("-o"), words);
  return written.ok() ? exit_done : refuse(written.error());
}

}  // namespace

extern const Command inspect_command;
const Command inspect_command = {"inspect",
                                 "MODEL.glb [--corrections FILE.json] [-o SHAPE.json] [--words]",
                                 "Finds parts, hexahedra and relations of a GLB or glTF model (--words: in sentences; "
                                 "--corrections: with joints and mirror images as parsel/corrections declares them).",
                                 {"-o", "--corrections"},
                                 {"--words"},
                                 run};

}  // namespace parsel::cli
