#include "core/propagate/decisions.h"

#include <algorithm>

#include "core/base/tolerance.h"
#include "core/propagate/layer_writer.h"
#include "core/prove/slack.h"

namespace parsel {

namespace {

class Writer {
 public:
  Writer(const Graph& graph, const ResolvedRequest& request, const Edits& seeds, Layer& layer, Trace& trace)
      : graph_(graph), shape_(graph.shape()), request_(request), seeds_(seeds), layer_(layer), trace_(trace) {}

  void write(const SearchState& state) {
    std::vector<const Decision*> decisions;
    for (const Decision* d = state.last.get(); d != nullptr; d = d->before.get()) decisions.push_back(d);
    std::reverse(decisions.begin(), decisions.end());
    std::vector<PartIndex> edited;
    for (const PartIndex part : graph_.parts()) {
      if (is_seed(part)) edited.push_back(part);
    }
    held_.clear();
    for (const PartIndex part : graph_.parts()) {
      const auto decides = [part](const Decision* d) { return d->part == part && !d->left_alone; };
      if (state.edits[part] && !is_seed(part) && std::none_of(decisions.begin(), decisions.end(), decides))
        held_.insert(part);
    }
    for (const Decision* decision : decisions) {
      write(*decision, edited, state.edits);
      if (!decision->left_alone) edited.push_back(decision->part);
    }
    for (const PartIndex part : held_)
      trace_.steps.push_back(held_step(layer_, graph_, state.edits, part, request_.hints.count(part) > 0));
    show_dissolved_groups();
  }

 private:
  bool is_seed(PartIndex part) const { return seeds_[part] != nullptr; }
  const std::string& id(PartIndex part) const { return shape_.parts[part].id; }
  const std::string& id(RelationIndex relation) const { return shape_.relations[relation].id; }

  void write(const Decision& decision, const std::vector<PartIndex>& edited, const Edits& edits) {
    const PartIndex part = decision.part;
    TraceStep trace = decision.trace;
    Edits before(shape_.parts.size());
    for (const PartIndex other : edited) before[other] = edits[other];
    for (const PartIndex other : graph_.parts()) {
      if (held_.count(other) > 0) before[other] = edits[other];
    }
    std::vector<PointConstraint> constraints;
    for (const RelationIndex relation : graph_.relations(part)) {
      if (before[graph_.other(relation, part)]) add_constraints(graph_, relation, part, before, constraints);
    }
    const bool moves = !decision.chosen.rest;
    std::vector<std::string> broken;
    for (const auto& pulled : trace.pulled_by) {
      if (pulled.by > exact) broken.push_back(pulled.relation);
    }
    double worst = 0;
    for (const auto& [relation, by] : residuals(constraints, decision.chosen.motion)) {
      trace.result.push_back({id(relation), by});
      worst = std::max(worst, by);
      const bool other_moves = !before[graph_.other(relation, part)]->steps.empty();
      const bool broken_by_it = slack_of(shape_.relations[relation], by, moves, other_moves) == Slack::broken;
      if (broken_by_it && !decision.left_alone) trace.left_broken.push_back(id(relation));
    }
    trace.why = decision.chosen.why;
    trace.energy = decision.chosen.cost;
    trace.tolerance = worst <= exact ? exact : delta_both_edited;
    if (decision.left_alone) {
      trace.kind = "left_alone";
    } else if (decision.chosen.rest) {
      trace.kind = "keep_fixed";
      trace.statements.push_back(add_keep_fixed(layer_, shape_, part, Why{WhyKind::breaking, trace.left_broken}));
    } else {
      trace.kind = to_string(decision.chosen.kind);
      trace.statements = add_steps(layer_, shape_, part, decision.chosen.steps, reference_parts(part, edited),
                                   Why{decision.chosen.kind, broken});
    }
    trace_.steps.push_back(std::move(trace));
  }

  /// A program shows that a group is taken apart by a statement on one of its instances.
  void show_dissolved_groups() {
    for (const RelationIndex group : request_.dissolved) {
      const std::vector<PartIndex>& instances = shape_.relations[group].parts;
      const auto is_named = [&](const Statement& s) {
        return std::any_of(instances.begin(), instances.end(), [&](PartIndex p) { return s.part == id(p); });
      };
      const auto& statements = layer_.statements;
      if (request_.disabled_by_name.count(group) > 0) continue;
      if (std::any_of(statements.begin(), statements.end(), is_named)) continue;
      TraceStep trace;
      trace.part = id(instances[0]);
      trace.kind = "keep_fixed";
      trace.held = true;
      trace.why = "its group is taken apart, and nothing pulls at it";
      trace.statements.push_back(add_keep_fixed(layer_, shape_, instances[0], Why{WhyKind::group, {}}));
      trace_.steps.push_back(std::move(trace));
    }
  }

  /// Whose points and axes a statement on the part may name, the nearest first: the part's own, its neighbours', those
  /// of the parts that are edited already.
  std::vector<PartIndex> reference_parts(PartIndex part, const std::vector<PartIndex>& edited) const {
    std::vector<PartIndex> sources = {part};
    for (const RelationIndex relation : graph_.relations(part)) sources.push_back(graph_.other(relation, part));
    sources.insert(sources.end(), edited.begin(), edited.end());
    return sources;
  }

  const Graph& graph_;
  const Shape& shape_;
  const ResolvedRequest& request_;
  const Edits& seeds_;
  std::set<PartIndex> held_;  ///< parts that stay without having been decided upon
  Layer& layer_;
  Trace& trace_;
};

}  // namespace

void write_decisions(const Graph& graph, const ResolvedRequest& request, const Edits& seeds, const SearchState& state,
                     Layer& layer, Trace& trace) {
  Writer(graph, request, seeds, layer, trace).write(state);
}

}  // namespace parsel
