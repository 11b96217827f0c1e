// parsel apply: an edited model, one that plays the edit, or one with a morph target for every slider, as GLB.
#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/model.h"
#include "core/cli/program_file.h"
#include "core/export/sliders.h"

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
  if (arguments.has("--morph") && arguments.has("--animate"))
    return misuse("apply takes --animate or --morph, not both");
  if (arguments.has("--repair") && (arguments.has("--animate") || arguments.has("--morph")))
    return misuse("apply takes --repair for one state of the sliders, not with --animate or --morph");
  if (const Status allowed = replaces_a_model(arguments); !allowed.ok()) return refuse(allowed.error());
  const Result<Corrections> corrections = read_corrections(arguments);
  if (!corrections) return refuse(corrections.error());
  const auto model = load_model(arguments.positional[0], {}, *corrections);
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
  options.repair = arguments.has("--repair");
  if (arguments.has("--only")) {
    auto parts = parts_of(shape, arguments.option("--only"));
    if (!parts) return refuse(parts.error());
    options.only_parts = std::move(parts).value();
  }

  SlidersApplied out;
  if (arguments.has("--morph")) {
    auto made = apply_sliders(model->bytes, shape, *program, *values, std::move(options));
    if (!made) return refuse(made.error());
    out = std::move(made).value();
  } else {
    auto applied = apply_program(model->bytes, shape, *program, *values, animate, std::move(options));
    if (!applied) return refuse(applied.error());
    out.applied = std::move(applied).value();
  }
  for (const Warning& warning : out.applied.warnings) {
    std::cerr << "warning: " << warning.place << ": " << warning.text << '\n';
  }
  const Status written = write_file(arguments.option("-o"), out.applied.glb);
  if (!written.ok()) return refuse(written.error());
  const bool repaired = arguments.has("--repair");
  if (!arguments.has("--morph") && !repaired) return exit_done;
  // -o names the model
  std::cout << (repaired ? to_json(shape, out.applied.gaps) : to_json(out)).dump(1) << '\n';
  return std::cout.flush() ? exit_done : exit_refused;
}

}  // namespace

extern const Command apply_command;
const Command apply_command = {
    "apply",
    "MODEL.glb PROGRAM [--corrections FILE.json] [--set x1=0.2]… [--animate x1 | --morph | --repair] [--only "
    "part,part] [--force] -o "
    "OUT.glb",
    "Writes the model as the program edits it (--animate: with an animation that plays the parameter; --morph: with a "
    "morph target for every slider, as other tools show them, and prints their names and errors in metres; --repair: "
    "with parts that the edit has pulled apart made longer until they meet, and prints which, and what is left; "
    "--force: "
    "over the model that it reads, or over a file that is no GLB).",
    {"--set", "--animate", "--only", "--corrections", "-o"},
    {"--force", "--morph", "--repair"},
    run};

}  // namespace parsel::cli
