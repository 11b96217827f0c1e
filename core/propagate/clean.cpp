#include "core/propagate/clean.h"

#include <algorithm>
#include <cmath>

#include "core/prove/deviation.h"
#include "core/prove/first_fault.h"
#include "core/prove/prove.h"
#include "core/prove/range.h"
#include "core/prove/scope.h"

namespace parsel {

namespace {

constexpr int steps = 96;       ///< of a scan for the first place where something comes apart
constexpr int halvings = 24;    ///< of the step in which it does
constexpr int most_rounds = 8;  ///< of a proof that finds something between the steps
constexpr double step_back = 0.97;

/// Whether relations of a program's layer keep their tolerance, by numbers at single places.
class Watch {
 public:
  /// Those for which `watched` answers true.
  template <class Watched>
  Watch(const Shape& shape, const Program& program, std::size_t layer, Watched&& watched)
      : evaluate_(program, shape), layer_(layer) {
    const std::set<std::string> disabled = disabled_in(program.layers[layer]);
    const Scope scope = scope_of(shape, program, layer, disabled);
    for (const RelationIndex r : scope.relations) {
      const Relation& relation = shape.relations[r];
      if (is_disabled(relation, disabled) || !watched(relation.id)) continue;
      watched_.push_back({make_constraint(shape, r), tolerance_of(relation, scope)});
    }
    // Later layers are not applied: at 0 they do nothing.
    for (std::size_t i = 0; i < program.layers.size(); ++i)
      values_.push_back(i < layer ? program.layers[i].parameter.value : 0);
  }

  /// How far from `from`, where all is kept, towards `to` it stays so.
  double reach(double from, double to) {
    return first_fault(from, to, steps, halvings, [&](double x) { return keeps(x) ? "" : "a relation breaks"; }).x;
  }

 private:
  struct Watched {
    Constraint constraint;
    double tolerance;
  };
  bool keeps(double x) {
    values_[layer_] = x;
    const State state = evaluate_(values_);
    return std::all_of(watched_.begin(), watched_.end(),
                       [&](const Watched& w) { return deviation(w.constraint, state) <= w.tolerance; });
  }

  Evaluator evaluate_;
  std::size_t layer_;
  std::vector<Watched> watched_;
  std::vector<double> values_;
};

bool any_broken(const Layer& layer, const std::set<std::string>* among = nullptr) {
  return std::any_of(layer.relations.begin(), layer.relations.end(), [&](const RelationReport& report) {
    return report.status == RelationStatus::broken && (among == nullptr || among->count(report.id) > 0);
  });
}

bool does_something(const Shape& shape, const Program& program) {
  const Evaluator evaluate(program, shape);
  const State rest = evaluate({0});
  const Parameter& range = program.layers[0].parameter;
  for (const double end : {range.min, range.max}) {
    const State state = evaluate({end});
    for (const PartIndex p : shape.parts.indices()) {
      if ((state.parts[p] - rest.parts[p]).cwiseAbs().maxCoeff() >= least_move) return true;
    }
    for (const RelationIndex r : shape.relations.indices()) {
      if (state.groups[r].instances.size() != rest.groups[r].instances.size()) return true;
    }
  }
  return false;
}

}  // namespace

void cut_to_clean(const Shape& shape, Program& program, std::size_t layer) {
  Layer& cut = program.layers[layer];
  if (!any_broken(cut)) return;
  Parameter& range = cut.parameter;
  const std::set<std::string> disabled = disabled_in(cut);
  Watch watch(shape, program, layer, [](const std::string&) { return true; });
  range.min = shortened(watch.reach(0, range.min));
  range.max = shortened(watch.reach(0, range.max));
  for (int round = 0; round <= most_rounds; ++round) {
    if (round == most_rounds) range.min = range.max = 0;
    range.value = std::clamp(range.value, range.min, range.max);
    cut.relations = prove_relations(shape, program, layer, disabled);
    if (!any_broken(cut)) return;
    range.min = shortened(range.min * step_back);
    range.max = shortened(range.max * step_back);
  }
}

void extend_range(const Shape& shape, Program& program, std::size_t layer, double to) {
  const Layer before = program.layers[layer];
  to = std::clamp(to, -farthest_range, farthest_range);
  if (to >= before.parameter.min && to <= before.parameter.max) return;
  std::set<std::string> held;
  for (const RelationReport& report : before.relations) {
    if (report.status == RelationStatus::held) held.insert(report.id);
  }
  Layer& stretched = program.layers[layer];
  double& end = to > 0 ? stretched.parameter.max : stretched.parameter.min;
  const double old = end;
  const Range possible = find_range(shape, program, layer, -std::abs(to), std::abs(to));
  Watch watch(shape, program, layer, [&](const std::string& id) { return held.count(id) > 0; });
  end = watch.reach(old, to > 0 ? std::max(old, possible.max) : std::min(old, possible.min));
  if (end != to) end = shortened(end);
  for (int round = 0; round < most_rounds && std::abs(end) > std::abs(old); ++round) {
    if (!before.relations.empty()) stretched.relations = prove_relations(shape, program, layer, disabled_in(before));
    if (!any_broken(stretched, &held) && validate(program, shape)) return;
    end = shortened(old + (end - old) / 2);
  }
  stretched = before;
}

Result<Propagation> propagate_cleanly(const Shape& shape, const EditRequest& request, const PropagateOptions& options,
                                      const Progress& progress) {
  Result<Propagation> found = propagate(shape, request, options, progress);
  if (!found.ok()) return found;
  cut_to_clean(shape, found->program, 0);
  const Parameter& range = found->program.layers[0].parameter;
  if (std::max(range.max, -range.min) < least_clean * options.limit || !does_something(shape, found->program)) {
    return Error{"propagate/clean", "", "something comes apart as soon as the slider moves", "ask for another edit"};
  }
  return found;
}

}  // namespace parsel
