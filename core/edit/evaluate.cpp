#include "core/edit/evaluate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/edit/group_edit.h"

namespace parsel {

namespace {

constexpr double degenerate_axis = 1e-12;

/// The centre, face centre, edge centre or corner that the triple names: the mean of the corners that it selects.
Vec3 feature_point(const Corners& corners, const LocalTriple& at) {
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (int k = 0; k < 8; ++k) {
    if (!selects(at, k)) continue;
    sum += corners.row(k).transpose();
    ++count;
  }
  return sum / count;
}

struct CompiledPoint {
  std::optional<PartIndex> part;  ///< none: a literal
  LocalTriple at{0, 0, 0};
  Vec3 literal = Vec3::Zero();

  Vec3 resolve(const State& state) const { return part ? feature_point(state.parts[*part], at) : literal; }
};

struct CompiledDirection {
  std::optional<PartIndex> part;  ///< none: a literal
  int axis = 0;
  Vec3 literal = Vec3::Zero();

  std::optional<Vec3> resolve(const State& state) const {
    return part ? axis_direction(state.parts[*part], axis) : literal;
  }
};

PartIndex part_of(const Shape& shape, const std::string& id) {
  const auto part = shape.find_part(id);
  PARSEL_ASSERT(part, "a program is validated before it is evaluated");
  return *part;
}

CompiledPoint compile_point(const std::optional<PointReference>& reference, const Shape& shape) {
  CompiledPoint compiled;
  if (!reference) return compiled;
  if (const auto* point = std::get_if<PartPoint>(&*reference)) {
    compiled.part = part_of(shape, point->part);
    compiled.at = point->at;
  } else {
    compiled.literal = std::get<Vec3>(*reference);
  }
  return compiled;
}

CompiledDirection compile_direction(const std::optional<DirectionReference>& reference, const Shape& shape) {
  CompiledDirection compiled;
  if (!reference) return compiled;
  if (const auto* axis = std::get_if<PartAxis>(&*reference)) {
    compiled.part = part_of(shape, axis->part);
    compiled.axis = axis->axis;
  } else {
    compiled.literal = std::get<Vec3>(*reference).normalized();
  }
  return compiled;
}

struct CompiledStatement {
  Op op;
  LocalTriple feature;
  CompiledPoint origin;
  CompiledDirection direction, normal;
  Anchor anchor;
  CompiledAmount amount;
  std::optional<PartIndex> part;      ///< geometric operators
  std::optional<std::size_t> group;   ///< of the part (member or parent), or the one under edit
  std::optional<std::size_t> member;  ///< the part's number in the group

  /// The operator at the start of the layer; nothing when a part's axis that it names is degenerate there.
  std::optional<ResolvedOperator> resolve(const State& state) const {
    const auto d = direction.resolve(state);
    const auto n = normal.resolve(state);
    if (!d || !n) return std::nullopt;
    return ResolvedOperator{op, feature, origin.resolve(state), *d, *n};
  }
};

void operate_on_part(const CompiledStatement& statement, const ResolvedOperator& op, double amount,
                     const std::vector<Group>& groups, State& state) {
  Corners& corners = state.parts[*statement.part];
  if (!statement.group) return apply_operator(op, amount, corners);
  const Group& group = groups[*statement.group];
  GroupState& under_edit = state.groups[group.relation];
  if (!statement.member) return edit_parent(group, op, amount, corners, under_edit);
  if (*statement.member < under_edit.instances.size())
    apply_operator(op, amount, under_edit.instances[*statement.member]);
}

void run(const CompiledStatement& statement, const std::optional<ResolvedOperator>& op, double amount,
         const std::vector<Group>& groups, State& state) {
  if (statement.op == Op::keep_fixed) return;
  if (!is_geometric(statement.op)) {
    const Group& group = groups[*statement.group];
    edit_group(group, statement.op, amount, statement.anchor, state.parts[group.parent], state.groups[group.relation]);
  } else if (op) {
    operate_on_part(statement, *op, amount, groups, state);
  }
  if (!statement.group) return;
  const Group& group = groups[*statement.group];
  const std::vector<Corners>& instances = state.groups[group.relation].instances;
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    state.parts[group.members[k]] = instances[std::min(k, instances.size() - 1)];
  }
}

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
  std::vector<std::vector<CompiledStatement>> layers;

  CompiledStatement compile(const Statement& statement, const std::vector<std::string>& names,
                            const Shape& shape) const {
    CompiledStatement compiled{statement.op,
                               statement.feature,
                               compile_point(statement.origin, shape),
                               compile_direction(statement.direction, shape),
                               compile_direction(statement.normal, shape),
                               statement.anchor,
                               statement.amount.compile(names),
                               {},
                               {},
                               {}};
    if (is_geometric(statement.op)) compiled.part = part_of(shape, statement.part);
    const auto relation = shape.find_relation(statement.relation);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!compiled.part) {
        if (relation == groups[g].relation) compiled.group = g;
        continue;
      }
      const auto& members = groups[g].members;
      const auto member = std::find(members.begin(), members.end(), *compiled.part);
      if (member != members.end()) compiled.member = static_cast<std::size_t>(member - members.begin());
      if (member != members.end() || groups[g].parent == *compiled.part) compiled.group = g;
    }
    PARSEL_ASSERT(compiled.part || compiled.group, "a program is validated before it is evaluated");
    return compiled;
  }
};

Evaluator::Evaluator(const Program& program, const Shape& shape) {
  auto implementation = std::make_shared<Implementation>();
  implementation->rest = rest_state(shape);
  implementation->groups = groups_of(shape);
  std::vector<std::string> names;
  for (const Layer& layer : program.layers) names.push_back(layer.parameter.name);
  for (const Layer& layer : program.layers) {
    std::vector<CompiledStatement>& compiled = implementation->layers.emplace_back();
    for (const Statement& statement : layer.statements) {
      compiled.push_back(implementation->compile(statement, names, shape));
    }
  }
  implementation_ = std::move(implementation);
}

State Evaluator::operator()(const std::vector<double>& values) const {
  const Implementation& program = *implementation_;
  PARSEL_ASSERT(values.size() == program.layers.size(), "one value a layer");
  State state = program.rest;
  std::vector<std::optional<ResolvedOperator>> operators;
  for (const std::vector<CompiledStatement>& layer : program.layers) {
    // All references of a layer are read before any of its statements runs.
    operators.clear();
    for (const CompiledStatement& statement : layer) operators.push_back(statement.resolve(state));
    for (std::size_t i = 0; i < layer.size(); ++i) {
      const double amount = layer[i].amount(values.data());
      run(layer[i], operators[i], std::isfinite(amount) ? amount : 0, program.groups, state);
    }
  }
  return state;
}

}  // namespace parsel
