// parsel family: what the variations of a CAD program share, and the few sliders that are left.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/base/sha256.h"
#include "core/cad/cad_mesh.h"
#include "core/cli/cad_model.h"
#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/family/family.h"
#include "core/family/family_program.h"
#include "core/family/family_scad.h"

namespace parsel::cli {
namespace {

/// Writes what options ask for besides the family itself.
Status write_more(const Arguments& arguments, const family::Family& family) {
  for (const char* option : {"--program", "--scad", "--sets"}) {
    if (!arguments.has(option)) continue;
    if (const Status allowed = may_write(arguments, option); !allowed) return allowed;
  }
  if (arguments.has("--program")) {
    const Result<Program> program =
        family::family_program(family, family.model.name, sha256_hex(cad::to_glb(family.model)));
    if (!program) return program.error();
    const Status written = write_file(arguments.option("--program"), to_json(*program).dump(1) + "\n");
    if (!written) return written;
  }
  if (arguments.has("--scad")) {
    const Status written = write_file(arguments.option("--scad"), family::family_scad(family));
    if (!written) return written;
  }
  if (arguments.has("--sets")) {
    return write_file(arguments.option("--sets"), family::parameter_sets(family).dump(1) + "\n");
  }
  return success();
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("family takes one CAD program");
  family::Options options;
  const std::string vocabulary = arguments.option("--vocabulary", "extended");
  if (vocabulary != "paper" && vocabulary != "extended") return misuse("--vocabulary is paper or extended");
  options.vocabulary = vocabulary == "paper" ? family::Vocabulary::paper : family::Vocabulary::extended;
  const std::string select = arguments.option("--select", "agreement");
  if (select == "ranking") {
    options.selection = family::Selection::ranking;
  } else if (select == "ranking_by_derivative") {
    options.selection = family::Selection::ranking_by_derivative;
  } else if (select == "none") {
    options.selection = family::Selection::none;
  } else if (select != "agreement") {
    return misuse("--select is agreement, ranking, ranking_by_derivative or none");
  }
  for (const auto& [name, value] : arguments.options) {
    if (name == "--keep") options.choices[value] = family::Choice::forced;
    if (name == "--drop") options.choices[value] = family::Choice::off;
  }
  const Result<cad::Model> model = read_cad(arguments.positional[0], "mm");
  if (!model) return refuse(model.error());
  std::vector<family::Variation> variations;
  if (arguments.has("--variations")) {
    const std::string path = arguments.option("--variations");
    auto read = read_json_as<std::vector<family::Variation>>(path, [&](const nlohmann::json& json) {
      return family::variations_from_json(json, family::layout_of(*model, options.vocabulary), *model);
    });
    if (!read) return refuse(read.error());
    variations = std::move(*read);
  }
  const Result<family::Family> family = make_family(*model, std::move(variations), options);
  if (!family) return refuse(family.error());
  for (const std::string& warning : family->warnings) std::cerr << "warning: " << warning << '\n';
  if (const Status written = write_more(arguments, *family); !written) return refuse(written.error());
  return write_json(arguments, to_json(*family));
}

}  // namespace

extern const Command family_command;
const Command family_command = {
    "family",
    "PROGRAM.scad|.csg|.json --variations V.json [-o FAMILY.json] [--program P.json] [--scad OUT.scad] [--sets S.json] "
    "[--vocabulary paper|extended] [--select agreement|ranking|ranking_by_derivative|none] [--keep ID] [--drop ID]",
    "Finds what the variations of a CAD program share and which sliders are left; writes them as a family, as an "
    "editing "
    "program, and as OpenSCAD with its Customizer's parameter sets.",
    {"-o", "--variations", "--program", "--scad", "--sets", "--vocabulary", "--select", "--keep", "--drop"},
    {},
    run};

}  // namespace parsel::cli
