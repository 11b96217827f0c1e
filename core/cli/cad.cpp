// parsel cad: an OpenSCAD program down to its parts, as JSON, as GLB or as flat OpenSCAD.
#include <iostream>
#include <nlohmann/json.hpp>

#include "core/cad/cad_mesh.h"
#include "core/cli/cad_model.h"
#include "core/cli/command.h"

namespace parsel::cli {
namespace {

int write_bytes(const std::string& path, const std::string& bytes) {
  const Status written = write_file(path, bytes);
  return written.ok() ? exit_done : refuse(written.error());
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 1) return misuse("cad takes one program");
  const std::string unit = arguments.option("--unit", "mm");
  if (unit != "mm" && unit != "cm" && unit != "m" && unit != "in") return misuse("--unit is one of mm, cm, m and in");
  const Result<cad::Model> model = read_cad(arguments.positional[0], unit);
  if (!model) return refuse(model.error());
  const std::string out = arguments.option("-o");
  if (out.ends_with(".scad")) return write_bytes(out, cad::to_scad(*model));
  if (!out.ends_with(".glb")) return write_json(arguments, cad::to_json(*model));
  std::size_t undrawn = 0;
  for (const cad::Part& part : model->parts) undrawn += part.role != cad::Role::add;
  if (undrawn > 0) {
    std::cerr << "warning: " << out << ": " << undrawn
              << " parts take material away or limit it; they stand in the JSON, what they change is drawn whole\n";
  }
  return write_bytes(out, cad::to_glb(*model));
}

}  // namespace

extern const Command cad_command;
const Command cad_command = {
    "cad",
    "PROGRAM.scad|.csg|.json [-o CAD.json|OUT.glb|OUT.scad] [--unit mm|cm|m|in]",
    "Runs an OpenSCAD program down to its parts: as JSON, as a labelled model, or as flat text.",
    {"-o", "--unit"},
    {},
    run};

}  // namespace parsel::cli
