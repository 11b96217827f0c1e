#include "core/prove/range.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/edit/evaluate.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

constexpr int steps = 48;
constexpr double precision = 1e-6;  ///< of the limit
constexpr double decimals = 1e4;
/// Instances of a row that stand nearer than this at rest, in their own thicknesses, may overlap: they touch already.
constexpr double least_room = 0.1;

class Limits {
 public:
  Limits(const Shape& shape, Program program, std::size_t layer)
      : shape_(shape), layer_(layer), evaluator_(program, shape) {
    std::vector<std::string> names;
    for (const Layer& l : program.layers) {
      names.push_back(l.parameter.name);
      values_.push_back(l.parameter.value);
    }
    for (const Statement& statement : program.layers[layer].statements) {
      if (statement.op == Op::keep_fixed) continue;
      amounts_.push_back(statement.amount.compile(names));
      targets_.push_back(is_geometric(statement.op) ? statement.part : statement.relation);
    }
    const Scope scope = scope_of(shape, program, layer, {});
    dissolved_ = scope.dissolved;
    edited_ = scope.edited;
  }

  /// What goes wrong at x; empty when nothing does.
  std::string failure(double x) {
    values_[layer_] = x;
    for (std::size_t i = 0; i < amounts_.size(); ++i) {
      const double amount = amounts_[i](values_.data());
      if (std::isnan(amount)) return "the amount of " + targets_[i] + " would be undefined";
      if (!(std::abs(amount) < largest_amount)) return "the amount of " + targets_[i] + " would be too large";
    }
    const State state = evaluator_(values_);
    for (const PartIndex p : shape_.parts.indices()) {
      if (edited_.count(p) == 0 || !is_active(shape_, p, dissolved_)) continue;
      const Part& part = shape_.parts[p];
      std::string fault = judge(state.parts[p], part.hexahedron.corners, part.id);
      if (!fault.empty()) return fault;
    }
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      if (!relation.is_group() || edited_.count(relation.parts[0]) == 0) continue;
      if (std::count(dissolved_.begin(), dissolved_.end(), r) > 0) continue;
      const GroupState& group = state.groups[r];
      for (std::size_t k = 0; k < group.instances.size(); ++k) {
        const std::size_t member = group.source >= 0 ? static_cast<std::size_t>(group.source) : k;
        const Part& part = shape_.parts[relation.parts[member]];
        std::string fault = judge(group.instances[k], part.hexahedron.corners, part.id);
        if (!fault.empty()) return fault;
      }
      if (relation.kind == RelationKind::translation && run_together(relation, group))
        return shape_.parts[relation.parts[0]].label + " instances would run into each other";
    }
    return "";
  }

 private:
  static std::string judge(const Corners& corners, const Corners& rest, const std::string& id) {
    const double least = relative_jacobians(corners, rest).minCoeff();
    if (least >= collapse_ratio) return "";
    return id + (least < 0 ? " would turn inside out" : " would collapse");
  }

  /// Room between neighbours of a row, in thicknesses of an instance; negative when they overlap.
  static double room(const Vec3& start, const Vec3& end, std::size_t count, const Corners& instance) {
    const Vec3 along = (end - start).normalized();
    const Eigen::Matrix<double, 8, 1> extent = instance * along;
    const double thickness = extent.maxCoeff() - extent.minCoeff();
    return (end - start).norm() / static_cast<double>(count - 1) / thickness - 1;
  }

  bool run_together(const Relation& relation, const GroupState& now) const {
    if (now.instances.size() < 2) return false;
    const auto& rest = std::get<Translation>(relation.detail);
    const Corners& first = shape_.parts[relation.parts[0]].hexahedron.corners;
    if (room(rest.start, rest.end, relation.parts.size(), first) < least_room) return false;
    return room(now.start, now.end, now.instances.size(), now.instances[0]) < 0;
  }

  const Shape& shape_;
  std::size_t layer_;
  Evaluator evaluator_;
  std::vector<CompiledAmount> amounts_;
  std::vector<std::string> targets_;
  std::vector<RelationIndex> dissolved_;
  std::set<PartIndex> edited_;
  std::vector<double> values_;
};

/// The last good value from 0 towards `end`, and why no further.
std::pair<double, std::string> search(Limits& limits, double end) {
  double good = 0;
  for (int i = 1; i <= steps; ++i) {
    double bad = i == steps ? end : end * i / steps;
    std::string reason = limits.failure(bad);
    if (reason.empty()) {
      good = bad;
      continue;
    }
    while (std::abs(bad - good) > std::abs(end) * precision) {
      const double middle = (good + bad) / 2;
      std::string here = limits.failure(middle);
      if (here.empty()) {
        good = middle;
      } else {
        bad = middle;
        reason = std::move(here);
      }
    }
    return {std::trunc(good * decimals) / decimals, std::move(reason)};
  }
  return {end, "limit"};
}

}  // namespace

Range find_range(const Shape& shape, const Program& program, std::size_t layer, double limit) {
  PARSEL_ASSERT(limit > 0, "the range has an inside");
  PARSEL_ASSERT(layer < program.layers.size(), "the layer exists");
  Program applied = program;
  applied.layers.resize(layer + 1);
  Limits limits(shape, std::move(applied), layer);
  Range range;
  const std::string at_rest = limits.failure(0);
  if (!at_rest.empty()) {
    range.min_reason = range.max_reason = at_rest;
    return range;
  }
  std::tie(range.min, range.min_reason) = search(limits, -limit);
  std::tie(range.max, range.max_reason) = search(limits, limit);
  return range;
}

}  // namespace parsel
