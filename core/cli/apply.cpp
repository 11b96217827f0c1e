// parsel apply: an edited model, or one that plays the edit, as GLB.
#include "core/export/apply.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/model.h"
#include "core/cli/program_file.h"

namespace parsel::cli {
namespace {

Result<std::vector<PartIndex>> parts_of(const Shape& shape, const std::string& list) {
  std::vector<PartIndex> parts;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    const std::string id = list.substr(at, comma - at);
    const auto part = shape.find_part(id);
    if (!part) return Error{"cli", "--only " + id, "the model has no such part", "parsel inspect lists them"};
    parts.push_back(*part);
    at = comma + 1;
  }
  return parts;
}

/// A model may replace an older one, but nothing else: a slip of the hand would cost somebody's program or notes.
Status replaces_a_model(const Arguments& arguments) {
  const std::string path = arguments.option("-o");
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4> magic{};
  if (arguments.has("--force") || !file.read(magic.data(), 1)) return success();  // not there, or empty
  file.read(magic.data() + 1, magic.size() - 1);
  if (std::string_view(magic.data(), magic.size()) == "glTF") return success();
  return Error{"cli", "-o " + path, "the file is there and is no GLB", "name another file, or add --force"};
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("apply takes a model and a program");
  if (!arguments.has("-o")) return misuse("apply needs -o for the file that it writes");
  if (const Status allowed = replaces_a_model(arguments); !allowed.ok()) return refuse(allowed.error());
  const auto model = load_model(arguments.positional[0]);
  if (!model) return refuse(model.error());
  const Shape& shape = model->abstraction.shape;
  const auto program = read_program(arguments.positional[1], shape);
  if (!program) return refuse(program.error());
  const auto values = parameter_values(*program, arguments);
  if (!values) return refuse(values.error());
  std::optional<Animate> animate;
  if (arguments.has("--animate")) animate = Animate{arguments.option("--animate")};
  ApplyOptions options;
  options.external = model->buffers;
  if (arguments.has("--only")) {
    auto parts = parts_of(shape, arguments.option("--only"));
    if (!parts) return refuse(parts.error());
    options.only_parts = std::move(parts).value();
  }

  const auto applied = apply_program(model->bytes, shape, *program, *values, animate, std::move(options));
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
    "MODEL.glb PROGRAM [--set x1=0.2]… [--animate x1] [--only part,part] [--force] -o OUT.glb",
    "Writes the model as the program edits it (--animate: with an animation that plays the parameter; --force: over "
    "the model that it reads, or over a file that is no GLB).",
    {"--set", "--animate", "--only", "-o"},
    {"--force"},
    run};

}  // namespace parsel::cli
