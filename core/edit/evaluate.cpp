#include "core/edit/evaluate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/edit/group_edit.h"
#include "core/edit/statement_run.h"

namespace parsel {

namespace {

constexpr double degenerate_axis = 1e-12;

}  // namespace

std::optional<Vec3> axis_direction(const Corners& corners, int axis) {
  Vec3 direction = Vec3::Zero();
  for (int k = 0; k < 8; ++k) direction += corner_sign(k, axis) * corners.row(k).transpose() / 4;
  const double length = direction.norm();
  if (!(length >= degenerate_axis)) return std::nullopt;
  return Vec3(direction / length);
}

Vec3 local_coordinates(const Corners& corners, const Vec3& world) {
  constexpr int steps = 32;
  constexpr double converged = 1e-12;
  constexpr double singular = 1e-18;
  Mat3 half;  // columns: from the centre to the + face centres, in the mean
  for (int axis = 0; axis < 3; ++axis) {
    half.col(axis).setZero();
    for (int k = 0; k < 8; ++k) half.col(axis) += corner_sign(k, axis) * corners.row(k).transpose() / 8;
  }
  if (std::abs(half.determinant()) <= singular) return Vec3::Zero();
  const Vec3 guess = half.inverse() * (world - corners.colwise().mean().transpose());
  Vec3 local = guess;
  for (int step = 0; step < steps; ++step) {
    Mat3 jacobian = Mat3::Zero();
    for (int k = 0; k < 8; ++k) {
      Vec3 factor;
      for (int axis = 0; axis < 3; ++axis) factor[axis] = (1 + corner_sign(k, axis) * local[axis]) / 2;
      for (int axis = 0; axis < 3; ++axis) {
        const double derivative = 0.5 * corner_sign(k, axis) * factor[(axis + 1) % 3] * factor[(axis + 2) % 3];
        jacobian.col(axis) += derivative * corners.row(k).transpose();
      }
    }
    if (!(std::abs(jacobian.determinant()) > singular)) return guess;
    const Vec3 move = jacobian.inverse() * (world - interpolate(trilinear_weights(local), corners));
    local += move;
    if (move.cwiseAbs().maxCoeff() <= converged) return local;
  }
  return guess;
}

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
