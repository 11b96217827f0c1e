#include "core/prove/range.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>

#include "core/edit/evaluate.h"
#include "core/prove/enclosure.h"
#include "core/prove/first_fault.h"
#include "core/prove/scope.h"
#include "core/prove/stack_failure.h"

namespace parsel {

namespace {

constexpr int steps = 48;
constexpr double precision = 1e-6;  ///< of the limit
/// Pieces of a side's range that are looked at to show that nothing goes wrong between the steps, and how narrow they
/// may become, as a share of the limit. Fewer, and a spike beside a smooth collapse is not reached; an end that was
/// found by bisection alone takes some ten.
constexpr int most_pieces = 160;
constexpr double narrowest = 1e-9;
constexpr std::size_t most_cases = 8;
/// Instances of a row that stand nearer than this at rest, in their own thicknesses, may overlap: they touch already.
constexpr double least_room = 0.1;

/// Six times the volume at a corner: the determinant of the edges that meet there.
double corner_volume(const Corners& corners, int k) {
  Mat3 edges;
  for (int axis = 0; axis < 3; ++axis) edges.row(axis) = corners.row(k | 1 << axis) - corners.row(k & ~(1 << axis));
  return edges.determinant();
}
Jet corner_volume(const JetCorners& corners, int k) {
  std::array<JetPoint, 3> edges;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t c = 0; c < 3; ++c) {
      edges[static_cast<std::size_t>(axis)][c] =
          corners[static_cast<std::size_t>(k | 1 << axis)][c] - corners[static_cast<std::size_t>(k & ~(1 << axis))][c];
    }
  }
  const auto& [a, b, d] = edges;
  return a[0] * (b[1] * d[2] - b[2] * d[1]) + a[1] * (b[2] * d[0] - b[0] * d[2]) + a[2] * (b[0] * d[1] - b[1] * d[0]);
}

class Limits {
 public:
  Limits(const Shape& shape, const Program& program, std::size_t layer) : Limits(shape, program, layer, layer) {}
  /// Of the amounts those from layer `first` to `layer` are looked at.
  Limits(const Shape& shape, const Program& program, std::size_t first, std::size_t layer)
      : shape_(shape), layer_(layer), evaluator_(program, shape), enclosure_(shape, program, layer) {
    std::vector<std::string> names;
    for (const Layer& l : program.layers) {
      names.push_back(l.parameter.name);
      values_.push_back(l.parameter.value);
    }
    for (std::size_t l = first; l <= layer; ++l) {
      for (const Statement& statement : program.layers[l].statements) {
        if (statement.op == Op::keep_fixed) continue;
        amounts_.push_back(statement.amount.compile(names));
        largest_.push_back(statement.op == Op::change_count ? ProgramLimits::instances : largest_amount);
        targets_.push_back(is_geometric(statement.op) ? statement.part : statement.relation);
      }
    }
    const Scope scope = scope_of(shape, program, layer, {});
    dissolved_ = scope.dissolved;
    edited_ = scope.edited;
  }

  /// Whether it is shown that nothing goes wrong on a piece of the range: amounts, and every cage, from jets.
  bool is_proven(const Interval& x) const {
    if (!enclosure_.amounts_below(largest_amount, ProgramLimits::instances, x)) return false;
    const auto cases = enclosure_.cases_over(x, most_cases);
    return !cases.empty() && std::all_of(cases.begin(), cases.end(),
                                         [&](const std::vector<Case>& given) { return keeps_cages(x, given); });
  }

  /// What goes wrong at x; empty when nothing does.
  std::string failure(double x) {
    values_[layer_] = x;
    return failure_at(values_, evaluator_(values_));
  }

  std::string failure_at(const std::vector<double>& values, const State& state) const {
    for (std::size_t i = 0; i < amounts_.size(); ++i) {
      const double amount = amounts_[i](values.data());
      if (std::isnan(amount)) return "the amount of " + targets_[i] + " would be undefined";
      if (!(std::abs(amount) < largest_[i])) return "the amount of " + targets_[i] + " would be too large";
    }
    for (const PartIndex p : shape_.parts.indices()) {
      if (edited_.count(p) == 0 || !is_active(shape_, p, dissolved_)) continue;
      const Part& part = shape_.parts[p];
      std::string fault = judge(state.parts[p], part.hexahedron.corners, part.id);
      if (!fault.empty()) return fault;
    }
    for (const RelationIndex r : shape_.relations.indices()) {
      if (!is_watched(r)) continue;
      const Relation& relation = shape_.relations[r];
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
  bool keeps_cages(const Interval& x, const std::vector<Case>& given) const {
    const double middle = x.low + (x.high - x.low) / 2;
    const double radius = detail::up(std::max(x.high - middle, middle - x.low));
    const JetState at_middle = enclosure_(Interval(middle), given);
    const JetState over = enclosure_(x, given);
    const auto keeps = [&](const JetCorners& mid, const JetCorners& all, const Corners& rest) {
      for (int k = 0; k < 8; ++k) {
        const double at_rest = corner_volume(rest, k);
        const Jet centre = (1 / at_rest) * corner_volume(mid, k);
        const double here = (centre.c[0].low + centre.c[0].high) / 2;
        // The ratio stays within what it may lose from the middle of the piece.
        const double change = bound(centre - Jet(here), (1 / at_rest) * corner_volume(all, k) - Jet(here), radius);
        if (!(change <= here - collapse_ratio)) return false;
      }
      return true;
    };
    for (const PartIndex p : shape_.parts.indices()) {
      if (edited_.count(p) == 0 || !is_active(shape_, p, dissolved_)) continue;
      if (!keeps(at_middle.parts[p], over.parts[p], shape_.parts[p].hexahedron.corners)) return false;
    }
    for (const RelationIndex r : shape_.relations.indices()) {
      if (!is_watched(r)) continue;
      const auto& members = shape_.relations[r].parts;
      const std::vector<JetCorners>& instances = over.groups[r].instances;
      for (std::size_t k = 0; k < instances.size(); ++k) {
        // Instances of a group have one size.
        const Corners& rest = shape_.parts[members[std::min(k, members.size() - 1)]].hexahedron.corners;
        if (k >= at_middle.groups[r].instances.size()) return false;
        if (!keeps(at_middle.groups[r].instances[k], instances[k], rest)) return false;
      }
    }
    return true;
  }

  bool is_watched(RelationIndex r) const {
    const Relation& relation = shape_.relations[r];
    return relation.is_group() && edited_.count(relation.parts[0]) > 0 &&
           std::count(dissolved_.begin(), dissolved_.end(), r) == 0;
  }

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
  Enclosure enclosure_;
  std::vector<CompiledAmount> amounts_;
  std::vector<double> largest_;  ///< what each amount must be below
  std::vector<std::string> targets_;
  std::vector<RelationIndex> dissolved_;
  std::set<PartIndex> edited_;
  std::vector<double> values_;
};

/// Where it goes wrong between `good`, where it does not, and `bad`, where it does for `reason`.
RangeEnd bisect(Limits& limits, double good, double bad, std::string reason, double limit) {
  RangeEnd end = bisect_fault(good, bad, std::move(reason), halvings_to(std::abs(bad - good), limit * precision),
                              [&](double x) { return limits.failure(x); });
  end.x = shortened(end.x);
  return end;
}

/// The last good value from 0 towards `end` as far as steps show, and why no further.
RangeEnd search(Limits& limits, double end) {
  RangeEnd found =
      first_fault(0, end, steps, halvings_to(1.0 / steps, precision), [&](double x) { return limits.failure(x); });
  if (found.reason.empty()) return {end, "limit"};
  found.x = shortened(found.x);
  return found;
}

/// Looks between the steps: pieces that cannot be shown to be good are halved, the widest first, and end the range
/// where their middle fails.
RangeEnd refine(Limits& limits, RangeEnd found, double limit) {
  const double sign = found.x < 0 ? -1 : 1;
  std::deque<Interval> waiting = {{0, std::abs(found.x)}};  // distances from 0
  for (int looked = 0; !waiting.empty() && looked < most_pieces; ++looked) {
    const Interval piece = waiting.front();
    waiting.pop_front();
    if (piece.low >= std::abs(found.x)) continue;
    if (limits.is_proven(sign < 0 ? -piece : piece)) continue;
    const double middle = piece.low + (piece.high - piece.low) / 2;
    std::string reason = limits.failure(sign * middle);
    if (!reason.empty()) {
      const double good = limits.failure(sign * piece.low).empty() ? piece.low : 0;
      found = bisect(limits, sign * good, sign * middle, std::move(reason), limit);
    }
    if (piece.high - piece.low <= limit * narrowest) continue;
    waiting.push_back({piece.low, middle});
    waiting.push_back({middle, piece.high});
  }
  return found;
}

}  // namespace

Range find_range(const Shape& shape, const Program& program, std::size_t layer, double low_limit, double high_limit) {
  PARSEL_ASSERT(low_limit < 0 && high_limit > 0, "the range has an inside");
  PARSEL_ASSERT(layer < program.layers.size(), "the layer exists");
  Program applied = program;
  applied.layers.resize(layer + 1);
  Limits limits(shape, applied, layer);
  Range range;
  const std::string at_rest = limits.failure(0);
  if (!at_rest.empty()) {
    range.min_reason = range.max_reason = at_rest;
    return range;
  }
  const RangeEnd low = refine(limits, search(limits, low_limit), -low_limit);
  const RangeEnd high = refine(limits, search(limits, high_limit), high_limit);
  return {low.x, high.x, low.reason, high.reason};
}

struct StackFailure::Implementation {
  Implementation(const Shape& shape, const Program& program) : limits(shape, program, 0, program.layers.size() - 1) {}
  Limits limits;
};

StackFailure::StackFailure(const Shape& shape, const Program& program) {
  PARSEL_ASSERT(!program.layers.empty(), "a stack has a layer");
  implementation_ = std::make_shared<const Implementation>(shape, program);
}

std::string StackFailure::operator()(const std::vector<double>& values, const State& state) const {
  return implementation_->limits.failure_at(values, state);
}

}  // namespace parsel
