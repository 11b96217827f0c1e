#include "core/edit/statement_run.h"

#include <algorithm>
#include <cmath>

#include "core/edit/cage.h"

namespace parsel {

namespace {

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

}  // namespace

struct StatementRun::Compiled {
  Op op;
  LocalTriple feature;
  CompiledPoint origin;
  CompiledDirection direction, normal;
  Anchor anchor;
  CompiledAmount amount;
  std::optional<PartIndex> part;      ///< geometric operators
  std::optional<std::size_t> group;   ///< of the part (member or parent), or the one under edit
  std::optional<std::size_t> member;  ///< the part's number in the group

  void operate_on_part(const ResolvedOperator& what, double by, const std::vector<Group>& groups, State& state) const {
    Corners& corners = state.parts[*part];
    if (!group) return apply_operator(what, by, corners);
    const Group& of = groups[*group];
    GroupState& under_edit = state.groups[of.relation];
    if (!member) return edit_parent(of, what, by, corners, under_edit);
    if (*member < under_edit.instances.size()) apply_operator(what, by, under_edit.instances[*member]);
  }
};

StatementRun::StatementRun(const Statement& statement, const std::vector<std::string>& parameters, const Shape& shape,
                           const std::vector<Group>& groups) {
  Compiled compiled{statement.op,
                    statement.feature,
                    compile_point(statement.origin, shape),
                    compile_direction(statement.direction, shape),
                    compile_direction(statement.normal, shape),
                    statement.anchor,
                    statement.amount.compile(parameters),
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
  compiled_ = std::make_shared<const Compiled>(std::move(compiled));
}

std::optional<ResolvedOperator> StatementRun::resolve(const State& start) const {
  const auto d = compiled_->direction.resolve(start);
  const auto n = compiled_->normal.resolve(start);
  if (!d || !n) return std::nullopt;
  return ResolvedOperator{compiled_->op, compiled_->feature, compiled_->origin.resolve(start), *d, *n};
}

double StatementRun::amount(const double* values) const {
  const double amount = compiled_->amount(values);
  return std::isfinite(amount) ? amount : 0;
}

void StatementRun::run(const std::optional<ResolvedOperator>& what, double amount, const std::vector<Group>& groups,
                       State& state) const {
  const Compiled& statement = *compiled_;
  if (statement.op == Op::keep_fixed) return;
  if (!is_geometric(statement.op)) {
    const Group& group = groups[*statement.group];
    edit_group(group, statement.op, amount, statement.anchor, state.parts[group.parent], state.groups[group.relation]);
  } else if (what) {
    statement.operate_on_part(*what, amount, groups, state);
  }
  if (!statement.group) return;
  const Group& group = groups[*statement.group];
  const std::vector<Corners>& instances = state.groups[group.relation].instances;
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    state.parts[group.members[k]] = instances[std::min(k, instances.size() - 1)];
  }
}

}  // namespace parsel
