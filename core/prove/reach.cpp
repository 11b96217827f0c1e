#include "core/prove/reach.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/prove/clearance.h"
#include "core/prove/deviation.h"
#include "core/prove/first_fault.h"
#include "core/prove/prove.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

constexpr int steps = 24;
constexpr int halvings = 14;
/// Where a relation is off by this share of what it may be it ends the range, so that the proof has room to close.
constexpr double near_limit = 0.98;
/// What is seen to be wrong this early ends nothing: it is what was asked for, or a slider would be of no use.
constexpr double least_seen = 0.1;
constexpr int most_cuts = 4, most_halvings = 3;

/// From `core`, where nothing counts as wrong yet, outwards to `end`: the last value before a fault.
RangeEnd cut(double core, const RangeEnd& end, const FaultAt& fault) {
  RangeEnd found = first_fault(core, end.x, steps, halvings, fault);
  if (found.reason.empty()) return end;
  const double rounded = shortened(found.x);
  return {std::abs(rounded) < std::abs(core) ? core : rounded, std::move(found.reason)};
}

void cut(Range& range, const Range& core, const FaultAt& fault) {
  const RangeEnd low = cut(core.min, {range.min, range.min_reason}, fault);
  const RangeEnd high = cut(core.max, {range.max, range.max_reason}, fault);
  range = {low.x, high.x, low.reason, high.reason};
}

/// Halves what lies beyond the core; all of it the last time.
void shrink(Range& range, const Range& core, bool all) {
  const auto nearer = [&](double x, double inner) { return all ? inner : shortened((x + inner) / 2); };
  const std::string reason = "what holds could not be proved any further";
  if (range.min < core.min) {
    range.min = std::min(core.min, nearer(range.min, core.min));
    range.min_reason = reason;
  }
  if (range.max > core.max) {
    range.max = std::max(core.max, nearer(range.max, core.max));
    range.max_reason = reason;
  }
}

std::string parting_words(const Shape& shape, const Relation& relation) {
  const std::string& first = shape.parts[relation.parts[0]].id;
  switch (relation.kind) {
    case RelationKind::reflection:
      return first + " and " + shape.parts[relation.parts[1]].id + " would be mirror images no longer";
    case RelationKind::translation:
    case RelationKind::rotation:
      return "the instances of " + shape.parts[relation.parts[0]].label + " would not be alike any more";
    case RelationKind::ground:
      return first + " would leave the floor";
    case RelationKind::point:
    case RelationKind::line:
    case RelationKind::face:
    case RelationKind::volume:
      return first + " and " + shape.parts[relation.parts[1]].id + " would come apart";
  }
  return "";
}

/// A relation, and how far it may be off beyond the core.
struct Kept {
  Constraint constraint;
  double most;
};

class Extension {
 public:
  Extension(const Shape& shape, const Program& program, std::size_t layer, const std::set<std::string>& disabled)
      : shape_(shape),
        program_(program),
        layer_(layer),
        disabled_(disabled),
        scope_(scope_of(shape, program, layer, disabled)) {
    program_.layers.resize(layer + 1);
  }

  SliderReach operator()(double least, double low, double high) {
    Range range = find_range(shape_, program_, layer_, low, high);
    cut_where_seen(range, least);
    core_ = range;
    core_.min = std::max(range.min, -least);
    core_.max = std::min(range.max, least);
    return keep_relations(std::move(range));
  }

 private:
  /// Ends the range where something is seen to go wrong. Parts that come apart from the start, as when a handle is pulled
  /// off, end nothing. Parts that run into each other from the start end that side where they do; but when they do so on
  /// both sides, a side goes as far as the search looked.
  void cut_where_seen(Range& range, double least) const {
    const auto is_tight = [&](double side) {
      return Clearance(shape_, program_, layer_, disabled_).accept_gaps(side * least_seen);
    };
    const bool is_tight_below = is_tight(-1), is_tight_above = is_tight(1);
    const auto end_of = [&](double side, RangeEnd end) {
      const bool tight = side < 0 ? is_tight_below : is_tight_above;
      if (!tight && std::abs(end.x) <= least_seen) return end;
      Clearance clearance(shape_, program_, layer_, disabled_);
      double start = side * least_seen;
      if (!tight) {
        clearance.accept(start);
      } else if (is_tight_below && is_tight_above) {
        const std::string reason = clearance.fault(start);
        clearance.accept(start);
        if (std::abs(end.x) > least) end = {side * least, reason};
      } else {
        clearance.accept_gaps(start);
        start = 0;
      }
      return cut(start, end, [&](double x) { return clearance.fault(x); });
    };
    const RangeEnd low = end_of(-1, {range.min, range.min_reason});
    const RangeEnd high = end_of(1, {range.max, range.max_reason});
    range = {low.x, high.x, low.reason, high.reason};
  }

  bool is_core(const Range& range) const { return range.min >= core_.min && range.max <= core_.max; }

  std::vector<RelationReport> prove(const Range& range) {
    Parameter& parameter = program_.layers[layer_].parameter;
    parameter.min = range.min;
    parameter.max = range.max;
    return prove_relations(shape_, program_, layer_, disabled_);
  }

  SliderReach keep_relations(Range range) {
    std::vector<RelationReport> reports = prove(range);
    const bool is_clean = std::all_of(reports.begin(), reports.end(), [](const RelationReport& report) {
      return report.status == RelationStatus::disabled ||
             (report.status == RelationStatus::held && report.proof == Proof::certified && report.worst <= clean_drift);
    });
    if (is_clean || is_core(range)) return {std::move(range), std::move(reports)};
    const std::vector<RelationReport> within = prove(core_);
    for (int cuts = 0, shrinks = 0; !is_core(range);) {
      const std::vector<Kept> lost = lost_in(reports, within);
      if (lost.empty()) return {std::move(range), std::move(reports)};
      const Range before = range;
      if (cuts++ < most_cuts) cut(range, core_, drifting(lost));
      if (range.min == before.min && range.max == before.max) shrink(range, core_, ++shrinks > most_halvings);
      if (!is_core(range)) reports = prove(range);
    }
    return {std::move(range), within};
  }

  /// What holds in the core, and does not as well over the whole range.
  std::vector<Kept> lost_in(const std::vector<RelationReport>& whole, const std::vector<RelationReport>& within) const {
    std::map<std::string, const RelationReport*> by_id;
    for (const RelationReport& report : within) by_id[report.id] = &report;
    std::vector<Kept> lost;
    for (const RelationReport& report : whole) {
      const RelationReport& inside = *by_id.at(report.id);
      if (inside.status != RelationStatus::held) continue;
      const RelationIndex relation = *shape_.find_relation(report.id);
      const double tolerance = tolerance_of(shape_.relations[relation], scope_);
      const double most =
          follows_group(relation) ? tolerance : std::min(tolerance, std::max(inside.worst, clean_drift));
      const bool is_kept = report.status == RelationStatus::held && report.worst <= most + noise;
      const bool is_proved = inside.proof == Proof::sampled || report.proof == Proof::certified;
      if (!is_kept || !is_proved) lost.push_back({make_constraint(shape_, relation), most});
    }
    return lost;
  }

  /// Whether a joint is that of an instance, which goes where its group takes it and may slide along its neighbour.
  bool follows_group(RelationIndex relation) const {
    const Relation& joint = shape_.relations[relation];
    return joint.is_attachment() && std::any_of(joint.parts.begin(), joint.parts.end(), [&](PartIndex p) {
             const Part& part = shape_.parts[p];
             return part.group && !part.is_virtual() &&
                    std::find(scope_.dissolved.begin(), scope_.dissolved.end(), *part.group) == scope_.dissolved.end();
           });
  }

  FaultAt drifting(const std::vector<Kept>& kept) const {
    std::vector<double> values;
    for (const Layer& layer : program_.layers) values.push_back(layer.parameter.value);
    return [this, &kept, values, evaluator = Evaluator(program_, shape_)](double x) mutable -> std::string {
      values[layer_] = x;
      const State state = evaluator(values);
      for (const Kept& one : kept) {
        if (deviation(one.constraint, state) > near_limit * one.most)
          return parting_words(shape_, *one.constraint.relation);
      }
      return "";
    };
  }

  const Shape& shape_;
  Program program_;
  std::size_t layer_;
  const std::set<std::string>& disabled_;
  Scope scope_;
  Range core_;
};

}  // namespace

SliderReach reach_of_layer(const Shape& shape, const Program& program, std::size_t layer,
                           const std::set<std::string>& disabled, double least, double low, double high) {
  PARSEL_ASSERT(least > 0 && low <= -least && high >= least, "the range that the search looked at is within");
  return Extension(shape, program, layer, disabled)(least, low, high);
}

}  // namespace parsel
