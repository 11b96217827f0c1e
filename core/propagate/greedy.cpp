#include "core/propagate/greedy.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/propagate/cost.h"
#include "core/propagate/layer_writer.h"
#include "core/propagate/seeds.h"
#include "core/propagate/solve_part.h"
#include "core/propagate/transfer.h"
#include "core/propagate/urgency.h"
#include "core/prove/slack.h"

namespace parsel {

namespace {

/// What the search for revisions may cost, in the units of Loop::cost(): about a tenth of a second natively. Not the
/// clock: the same input must give the same program everywhere.
constexpr int revision_cost = 100'000;
constexpr int most_revision_runs = 40;
/// Hints that nobody gave: what the search does otherwise after it has seen where its first choices lead.
using Revisions = std::map<PartIndex, Hint>;

class Loop : public Attempt {
 public:
  Loop(const Shape& shape, const ResolvedRequest& request, const Revisions& revisions, const PropagateOptions& options,
       const Progress& progress)
      : shape_(shape),
        request_(request),
        revisions_(revisions),
        options_(options),
        progress_(progress),
        graph_(shape, request_.dissolved, request_.disabled),
        edits_(shape.parts.size()),
        pulls_(shape.parts.size()),
        goals_(graph_) {
    solve_options_.neighbour_edits = options.neighbour_edits;
    solve_options_.breaking_edits = options.breaking_edits;
    solve_options_.exact = exact;
    solve_options_.one_edited = delta_one_edited;
    solve_options_.both_edited = delta_both_edited;
    layer_.request = options.request;
  }

  /// Finds the edits. Once.
  Status search() {
    if (Status status = start(); !status.ok()) return status;
    hold_fixed_parts();
    int done = static_cast<int>(layer_.statements.size());
    const int total = static_cast<int>(graph_.parts().size());
    while (const auto next = next_part()) {
      report(progress_, shape_.parts[*next].name, std::min(done++, total), total);
      edit_part(*next);
    }
    return success();
  }

  /// Relations that the edits found leave broken.
  std::vector<RelationIndex> broken_relations() const {
    std::vector<RelationIndex> broken;
    for (const PartIndex part : graph_.parts()) {
      if (!edits_[part]) continue;
      for (const RelationIndex relation : graph_.relations(part)) {
        const PartIndex other = graph_.other(relation, part);
        if (edits_[other] && other < part) continue;
        std::vector<PointConstraint> constraints;
        add_constraints(graph_, relation, other, edits_, constraints);
        const Motion motion = edits_[other] ? edits_[other]->motion : still();
        if (is_broken(relation, residuals(constraints, motion)[0].second, other, moves(other)))
          broken.push_back(relation);
      }
    }
    return broken;
  }

  /// Parts that the search stretches or squeezes beyond what anyone would want, though it keeps their relations: a
  /// bed's legs that grow five times as thick.
  std::vector<PartIndex> distorted_parts() const {
    std::vector<PartIndex> distorted;
    for (const PartIndex part : graph_.parts()) {
      if (!edits_[part] || is_seed(part)) continue;
      const std::vector<Step>& steps = edits_[part]->steps;
      // A row that spreads keeps its instances as they are.
      if (std::any_of(steps.begin(), steps.end(), [](const Step& step) { return !is_geometric(step.what.op); }))
        continue;
      const Corners& rest = shape_.parts[part].hexahedron.corners;
      const auto& motion = edits_[part]->motion;
      if (is_distorted(rest, rest + motion.front()) || is_distorted(rest, rest + motion.back()))
        distorted.push_back(part);
    }
    return distorted;
  }

  /// What a second look tries to lessen: broken relations first, then distorted parts.
  using Faults = std::pair<std::size_t, std::size_t>;
  Faults faults() const { return {broken_relations().size(), distorted_parts().size()}; }

  /// How much work the search was, about 1000 a millisecond.
  int cost() const {
    int cost = 1;
    for (const TraceStep& step : trace_.steps)
      cost += step.own_candidates + step.neighbour_candidates + 4 * step.pairs + 100 * step.solved;
    return cost;
  }

  /// Hints that might have served better: for the parts that the search edited by itself, up to two relations away from
  /// a fault, to be stretched where they were moved, and the other way round.
  std::vector<std::pair<PartIndex, Hint>> possible_revisions() const {
    std::set<PartIndex> near;
    for (const RelationIndex relation : broken_relations())
      near.insert(shape_.relations[relation].parts.begin(), shape_.relations[relation].parts.end());
    for (const PartIndex part : distorted_parts()) near.insert(part);
    for (const PartIndex part : std::set<PartIndex>(near)) {
      for (const RelationIndex relation : graph_.relations(part)) near.insert(graph_.other(relation, part));
    }
    std::vector<std::pair<PartIndex, Hint>> possible;
    for (const PartIndex part : graph_.parts()) {
      if (!edits_[part] || near.count(part) == 0 || request_.hints.count(part) > 0 || revisions_.count(part) > 0)
        continue;
      if (is_seed(part)) continue;
      const auto uses = [&](Op op) {
        const std::vector<Step>& steps = edits_[part]->steps;
        return std::any_of(steps.begin(), steps.end(), [op](const Step& step) { return step.what.op == op; });
      };
      if (!uses(Op::scale_1d)) possible.emplace_back(part, Hint::scale);
      if (!uses(Op::translate)) possible.emplace_back(part, Hint::translate);
    }
    return possible;
  }

  void note(std::string text) { trace_.notes.push_back(std::move(text)); }

  const Edits& edits() const override { return edits_; }

  /// The program and its proof. After search(), once.
  Propagation finish() override {
    for (const PartIndex part : held_) trace_.steps.push_back(held_step(layer_, graph_, edits_, part, true));
    for (std::string& note : unused_hints(graph_, request_)) trace_.notes.push_back(std::move(note));
    trace_.stop = why_it_stopped(graph_, edits_);
    return finished(shape_, request_, options_, at_, std::move(layer_), std::move(trace_), progress_);
  }

 private:
  bool is_seed(PartIndex part) const {
    return std::find(request_.seed_parts.begin(), request_.seed_parts.end(), part) != request_.seed_parts.end();
  }
  /// Whether a part is edited and does not stay where it is.
  bool moves(PartIndex part) const { return edits_[part] != nullptr && !edits_[part]->steps.empty(); }
  /// Whether a relation of `part`, which `moves` or not, is off by more than it may be.
  bool is_broken(RelationIndex relation, double by, PartIndex part, bool part_moves) const {
    return slack_of(shape_.relations[relation], by, part_moves, moves(graph_.other(relation, part))) == Slack::broken;
  }
  const std::string& id(PartIndex part) const { return shape_.parts[part].id; }
  const std::string& id(RelationIndex relation) const { return shape_.relations[relation].id; }

  // ----- seeds

  Status start() {
    auto seeds = apply_seeds(graph_, request_, options_);
    if (!seeds.ok()) return seeds.error();
    at_ = seeds->at;
    edits_ = std::move(seeds->edits);
    layer_.statements = std::move(seeds->statements);
    trace_.steps = std::move(seeds->trace);
    trace_.notes = std::move(seeds->notes);
    for (const PartIndex part : graph_.parts()) {
      if (edits_[part]) pull_neighbours(part);
    }
    return success();
  }

  // ----- parts that a hint holds

  void hold_fixed_parts() {
    for (const auto& [part, hint] : request_.hints) {
      if (hint != Hint::keep_fixed || edits_[part] || !is_in_graph(part)) continue;
      edits_[part] = std::make_shared<const PartEdit>(PartEdit{{}, still()});
      held_.push_back(part);
    }
    // Their neighbours must respect them, but nothing is broken by them yet.
    for (const PartIndex part : held_) pull_neighbours(part);
  }

  bool is_in_graph(PartIndex part) const {
    return std::find(graph_.parts().begin(), graph_.parts().end(), part) != graph_.parts().end();
  }

  // ----- the loop

  void pull_neighbours(PartIndex part) {
    for (const RelationIndex relation : graph_.relations(part)) {
      const PartIndex other = graph_.other(relation, part);
      if (!edits_[other]) add_constraints(graph_, relation, other, edits_, pulls_[other]);
    }
  }

  std::optional<PartIndex> next_part() const {
    std::optional<PartIndex> best;
    Urgency most;
    for (const PartIndex part : graph_.parts()) {
      if (edits_[part] ||
          std::find(left_alone_.begin(), left_alone_.end(), std::pair(part, pulls_[part].size())) != left_alone_.end())
        continue;
      const Urgency urgency = urgency_of(shape_, pulls_[part], request_.hints.count(part) > 0);
      if (urgency.broken == 0) continue;
      if (!best || urgency > most || (urgency == most && id(part) < id(*best))) {
        best = part;
        most = urgency;
      }
    }
    return best;
  }

  void edit_part(PartIndex part) {
    TraceStep trace;
    trace.part = id(part);
    std::optional<Hint> hint;
    if (const auto found = request_.hints.find(part); found != request_.hints.end()) {
      hint = found->second;
      trace.hint = to_string(*hint);
    } else if (const auto revision = revisions_.find(part); revision != revisions_.end()) {
      hint = revision->second;
    }
    const std::vector<PointConstraint>& constraints = pulls_[part];
    std::vector<std::string> broken;
    for (const auto& [relation, by] : residuals(constraints, still())) {
      trace.pulled_by.push_back({id(relation), by});
      if (by > exact) broken.push_back(id(relation));
    }
    Solution solution;
    const std::vector<PartIndex> sources = reference_parts(part);
    const auto mirrored = mirror_neighbour(part);
    if (mirrored && mirrored->lost == 0) {
      solution = mirrored->solution;
      trace.why = mirrored->why;
    } else {
      const Scene scene{graph_, edits_, goals_, options_.parameter, at_, solve_options_};
      solution = solve_part(scene, part, hint, constraints, trace);
      // A mirror image that tears as many joints as it keeps symmetries is none that anyone wants.
      if (mirrored && mirrored->lost < lost_with(part, solution.steps)) {
        solution = mirrored->solution;
        trace.why = mirrored->why;
      }
    }
    if (solution.outcome == Outcome::left_alone) {
      trace.kind = "left_alone";
      trace.result = trace.pulled_by;
      left_alone_.emplace_back(part, constraints.size());
      trace_.steps.push_back(std::move(trace));
      return;
    }
    const Motion motion = motion_of(shape_, part, solution.steps);
    for (const auto& [relation, by] : residuals(constraints, motion)) {
      trace.result.push_back({id(relation), by});
      if (is_broken(relation, by, part, !solution.steps.empty())) trace.left_broken.push_back(id(relation));
    }
    if (solution.outcome == Outcome::keep_fixed) {
      trace.kind = "keep_fixed";
      trace.statements.push_back(add_keep_fixed(layer_, shape_, part, Why{WhyKind::breaking, trace.left_broken}));
    } else {
      trace.kind = to_string(solution.kind);
      trace.statements = add_steps(layer_, shape_, part, solution.steps, sources, Why{solution.kind, broken});
    }
    edits_[part] = std::make_shared<const PartEdit>(PartEdit{std::move(solution.steps), motion});
    trace_.steps.push_back(std::move(trace));
    pull_neighbours(part);
  }

  struct Mirrored {
    Solution solution;
    int lost = 0;  ///< relations to edited parts that it breaks
    std::string why;
  };

  /// E* = T(E), of the first edited neighbour by reflection that has a mirror image here.
  std::optional<Mirrored> mirror_neighbour(PartIndex part) const {
    for (const auto& [relation, by] : residuals(pulls_[part], still())) {
      if (by <= exact || shape_.relations[relation].kind != RelationKind::reflection) continue;
      const PartIndex other = graph_.other(relation, part);
      auto steps = reflected(shape_, shape_.relations[relation], other, edits_[other]->steps);
      if (!steps) continue;
      const int lost = lost_with(part, *steps);
      return Mirrored{{Outcome::solved, WhyKind::symmetry, std::move(*steps)},
                      lost,
                      "mirrors " + id(other) + " (" + id(relation) + ")"};
    }
    return std::nullopt;
  }

  /// Relations of the part to edited parts that these steps break.
  int lost_with(PartIndex part, const std::vector<Step>& steps) const {
    int lost = 0;
    for (const auto& [relation, by] : residuals(pulls_[part], motion_of(shape_, part, steps)))
      lost += is_broken(relation, by, part, !steps.empty());
    return lost;
  }

  /// Whose points and axes a statement on the part may name, the nearest first: the part's own, its neighbours', those
  /// of the parts that are edited already.
  std::vector<PartIndex> reference_parts(PartIndex part) const {
    std::vector<PartIndex> sources = {part};
    for (const RelationIndex relation : graph_.relations(part)) sources.push_back(graph_.other(relation, part));
    for (const PartIndex other : graph_.parts()) {
      if (edits_[other]) sources.push_back(other);
    }
    return sources;
  }

  const Shape& shape_;
  const ResolvedRequest& request_;
  Revisions revisions_;
  PropagateOptions options_;
  const Progress& progress_;
  SolveOptions solve_options_;
  Graph graph_;
  Edits edits_;
  PartData<std::vector<PointConstraint>> pulls_;  ///< constraints of unedited parts by edited ones
  SymbolicGoals goals_;
  Samples at_{};
  std::vector<PartIndex> held_;
  std::vector<std::pair<PartIndex, std::size_t>> left_alone_;  ///< with the number of constraints seen
  Layer layer_;
  Trace trace_;
};

/// The revisions with the fewest faults, found greedily. The search takes one part after the other and never
/// looks back; a part that it moved with its first edited neighbour often must stretch once the neighbour at its other
/// end is known.
Revisions find_revisions(const Shape& shape, const ResolvedRequest& request, const PropagateOptions& options,
                         const Loop& first, const Loop::Faults& faults_of_first, const Progress& progress) {
  int budget = std::min(revision_cost / first.cost(), most_revision_runs);
  const Progress silent;
  Revisions chosen;
  Loop::Faults fewest = faults_of_first;
  auto possible = first.possible_revisions();
  const int total = budget;
  while (fewest > Loop::Faults{} && budget > 0) {
    std::optional<Revisions> better;
    std::vector<std::pair<PartIndex, Hint>> next;
    for (const auto& [part, hint] : possible) {
      if (budget-- <= 0) break;
      report(progress, "looking for a way that keeps more", total - budget, total);
      Revisions tried = chosen;
      tried[part] = hint;
      Loop loop(shape, request, tried, options, silent);
      if (!loop.search().ok()) continue;
      const Loop::Faults faults = loop.faults();
      if (faults >= fewest) continue;
      fewest = faults;
      better = std::move(tried);
      next = loop.possible_revisions();
    }
    if (!better) break;
    chosen = std::move(*better);
    possible = std::move(next);
  }
  return chosen;
}

}  // namespace

Result<std::unique_ptr<Attempt>> search_greedily(const Shape& shape, const ResolvedRequest& request,
                                                 const PropagateOptions& options, const Progress& progress) {
  static const Revisions none;
  auto first = std::make_unique<Loop>(shape, request, none, options, progress);
  if (const Status found = first->search(); !found.ok()) return found.error();
  if (!options.revisions) return std::unique_ptr<Attempt>(std::move(first));
  const Loop::Faults before = first->faults();
  Revisions revisions =
      before == Loop::Faults{} ? none : find_revisions(shape, request, options, *first, before, progress);
  if (revisions.empty()) return std::unique_ptr<Attempt>(std::move(first));
  auto second = std::make_unique<Loop>(shape, request, revisions, options, progress);
  if (const Status found = second->search(); !found.ok()) return found.error();
  const Loop::Faults after = second->faults();
  const std::string gain = before.first > after.first
                               ? std::to_string(before.first - after.first) + " more relations are kept"
                               : std::to_string(before.second - after.second) + " fewer parts are distorted";
  for (const auto& [part, hint] : revisions) {
    second->note("a second look: " + shape.parts[part].id +
                 (hint == Hint::scale ? " is not moved, so that " : " is not stretched, so that ") + gain);
  }
  return std::unique_ptr<Attempt>(std::move(second));
}

}  // namespace parsel
