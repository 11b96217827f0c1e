// parsel evaluate: the corners that a program gives a shape, for tests and other tools.
#include <nlohmann/json.hpp>

#include "core/cli/command.h"
#include "core/cli/input.h"
#include "core/cli/program_file.h"
#include "core/edit/evaluate.h"

namespace parsel::cli {
namespace {

using nlohmann::json;

json corners_json(const Corners& corners) {
  json out = json::array();
  for (int k = 0; k < 8; ++k) out.push_back({corners(k, 0), corners(k, 1), corners(k, 2)});
  return out;
}

json vector_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

json group_json(const Relation& relation, const GroupState& group) {
  json out = {{"instances", json::array()}, {"source", group.source}};
  for (const Corners& instance : group.instances) out["instances"].push_back(corners_json(instance));
  if (relation.kind == RelationKind::translation) {
    out["start"] = vector_json(group.start);
    out["end"] = vector_json(group.end);
  } else {
    out["centre"] = vector_json(group.centre);
    out["axis"] = vector_json(group.axis);
    out["radius"] = group.radius;
  }
  return out;
}

int run(const Arguments& arguments) {
  if (arguments.positional.size() != 2) return misuse("evaluate takes a model and a program");
  const Result<Shape> shape = read_shape(arguments.positional[0]);
  if (!shape.ok()) return refuse(shape.error());
  const Result<Program> program = read_program(arguments.positional[1], *shape);
  if (!program.ok()) return refuse(program.error());
  const Result<std::vector<double>> values = parameter_values(*program, arguments);
  if (!values.ok()) return refuse(values.error());
  const State state = Evaluator(*program, *shape)(*values);
  json out = {{"parts", json::object()}, {"groups", json::object()}};
  for (const PartIndex p : shape->parts.indices()) out["parts"][shape->parts[p].id] = corners_json(state.parts[p]);
  for (const RelationIndex r : shape->relations.indices()) {
    const Relation& relation = shape->relations[r];
    if (relation.is_group()) out["groups"][relation.id] = group_json(relation, state.groups[r]);
  }
  return write_json(arguments, out);
}

}  // namespace

extern const Command evaluate_command;
const Command evaluate_command = {"evaluate",
                                  "MODEL.glb|SHAPE.json PROGRAM [--set x1=0.2]… [-o STATE.json]",
                                  "Prints the corners of all parts and group instances under a program.",
                                  {"--set", "-o"},
                                  {},
                                  run};

}  // namespace parsel::cli
