#include "core/edit/evaluate.h"

#include "core/edit/group_edit.h"
#include "core/edit/statement_run.h"

namespace parsel {

State rest_state(const Shape& shape) {
  State state;
  for (const Part& part : shape.parts) state.parts.push_back(part.hexahedron.corners);
  for (const Relation& relation : shape.relations) {
    GroupState group;
    if (relation.is_group()) {
      for (const PartIndex member : relation.parts) group.instances.push_back(shape.parts[member].hexahedron.corners);
    }
    if (const auto* line = std::get_if<Translation>(&relation.detail)) {
      group.start = line->start;
      group.end = line->end;
    } else if (const auto* ring = std::get_if<Rotation>(&relation.detail)) {
      group.centre = ring->centre;
      group.axis = ring->axis;
      group.radius = ring->radius;
    }
    state.groups.push_back(std::move(group));
  }
  return state;
}

struct Evaluator::Implementation {
  State rest;
  std::vector<Group> groups;
  std::vector<std::vector<StatementRun>> layers;
};

Evaluator::Evaluator(const Program& program, const Shape& shape) {
  auto implementation = std::make_shared<Implementation>();
  implementation->rest = rest_state(shape);
  implementation->groups = groups_of(shape);
  std::vector<std::string> names;
  for (const Layer& layer : program.layers) names.push_back(layer.parameter.name);
  for (const Layer& layer : program.layers) {
    std::vector<StatementRun>& compiled = implementation->layers.emplace_back();
    for (const Statement& statement : layer.statements) {
      compiled.emplace_back(statement, names, shape, implementation->groups);
    }
  }
  implementation_ = std::move(implementation);
}

State Evaluator::operator()(const std::vector<double>& values) const {
  const Implementation& program = *implementation_;
  PARSEL_ASSERT(values.size() == program.layers.size(), "one value a layer");
  State state = program.rest;
  std::vector<std::optional<ResolvedOperator>> operators;
  for (const std::vector<StatementRun>& layer : program.layers) {
    // All references of a layer are read before any of its statements runs.
    operators.clear();
    for (const StatementRun& statement : layer) operators.push_back(statement.resolve(state));
    for (std::size_t i = 0; i < layer.size(); ++i) {
      layer[i].run(operators[i], layer[i].amount(values.data()), program.groups, state);
    }
  }
  return state;
}

}  // namespace parsel
