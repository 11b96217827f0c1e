#include "core/propagate/propagate.h"

#include <algorithm>
#include <cmath>

#include "core/propagate/transfer.h"
#include "core/prove/prove.h"
#include "core/prove/range.h"
#include "core/prove/slack.h"

namespace parsel {

namespace {

constexpr const char* stage = "propagate";
/// A seed must be able to go at least this far to one side, as a share of the limit.
constexpr double least_range = 0.02;
/// What the search for revisions may cost, in the units of Loop::cost(): about a tenth of a second natively. Not the
/// clock: the same input must give the same program everywhere.
constexpr int revision_cost = 100'000;
constexpr int most_revision_runs = 40;
/// A part that follows an edit at the ends of a slider and changes an edge by more than this factor is distorted.
constexpr double largest_stretch = 2.5;

Motion still() {
  Motion motion;
  motion.fill(Corners::Zero());
  return motion;
}

/// By how much the edge that changes most has become longer, or shorter, as a factor of at least 1.
double stretch(const Corners& rest, const Corners& deformed) {
  double most = 1;
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      const int other = k ^ (1 << axis);
      if (other < k) continue;
      const double before = (rest.row(other) - rest.row(k)).norm(),
                   after = (deformed.row(other) - deformed.row(k)).norm();
      most = std::max({most, after / before, before / std::max(after, noise)});
    }
  }
  return most;
}

bool is_alive(const Corners& corners, const Corners& rest) {
  return corners.allFinite() && relative_jacobians(corners, rest).minCoeff() > collapse_ratio;
}

/// Hints that nobody gave: what the search does otherwise after it has seen where its first choices lead.
using Revisions = std::map<PartIndex, Hint>;

class Loop {
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
        goals_(graph_, edits_) {
    solve_options_.neighbour_edits = options.neighbour_edits;
    solve_options_.breaking_edits = options.breaking_edits;
    solve_options_.exact = exact;
    solve_options_.one_edited = delta_one_edited;
    solve_options_.both_edited = delta_both_edited;
    layer_.request = options.request;
  }

  /// Finds the edits. Once.
  Status search() {
    if (Status status = apply_seeds(); !status.ok()) return status;
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
      if (std::max(stretch(rest, rest + motion.front()), stretch(rest, rest + motion.back())) > largest_stretch)
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

  /// The program and its proof. After search(), once.
  Propagation finish() {
    note_fixed_parts();
    note_unused_hints();
    say_why_it_stopped();
    Propagation result;
    result.program.shape_name = shape_.name;
    result.program.shape_sha256 = shape_.sha256;
    layer_.parameter = {options_.parameter, at_.front(), at_.back(), 0};
    result.program.layers.push_back(std::move(layer_));
    Layer& layer = result.program.layers[0];
    report(progress_, "finding the range", 0, 2);
    const Range range = find_range(shape_, result.program, 0, options_.limit);
    layer.parameter.min = range.min;
    layer.parameter.max = range.max;
    std::set<std::string> disabled;
    for (const RelationIndex relation : request_.disabled) disabled.insert(id(relation));
    report(progress_, "proving the relations", 1, 2);
    layer.relations = prove_relations(shape_, result.program, 0, disabled);

    trace_.parameter = options_.parameter;
    trace_.samples.assign(at_.begin(), at_.end());
    trace_.exact = exact;
    trace_.one_edited = delta_one_edited;
    trace_.both_edited = delta_both_edited;
    for (const RelationIndex relation : request_.dissolved) trace_.dissolved.push_back(id(relation));
    trace_.disabled.assign(disabled.begin(), disabled.end());
    result.trace = std::move(trace_);
    return result;
  }

 private:
  bool is_seed(PartIndex part) const {
    return std::find(request_.seed_parts.begin(), request_.seed_parts.end(), part) != request_.seed_parts.end();
  }
  /// Whether a part is edited and does not stay where it is.
  bool moves(PartIndex part) const { return edits_[part] && !edits_[part]->steps.empty(); }
  /// Whether a relation of `part`, which `moves` or not, is off by more than it may be.
  bool is_broken(RelationIndex relation, double by, PartIndex part, bool part_moves) const {
    return slack_of(shape_.relations[relation], by, part_moves, moves(graph_.other(relation, part))) == Slack::broken;
  }
  const std::string& id(PartIndex part) const { return shape_.parts[part].id; }
  const std::string& id(RelationIndex relation) const { return shape_.relations[relation].id; }

  // ----- seeds

  Status apply_seeds() {
    const GiNaC::symbol& x = parameter_symbol(edit_parameter);
    const GiNaC::symbol& own = parameter_symbol(options_.parameter);
    std::vector<PartIndex> parts;
    PartData<std::vector<Step>> steps(shape_.parts.size());
    PartData<std::vector<int>> indices(shape_.parts.size());
    for (std::size_t i = 0; i < request_.seed.size(); ++i) {
      Statement statement = request_.seed[i];
      statement.amount = Amount(statement.amount.expression().subs(x == own));
      statement.why = Why{WhyKind::seed, {}};
      const PartIndex part = request_.seed_parts[i];
      if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
      Step step = to_step(shape_, statement);
      if (step.what.op != Op::keep_fixed) steps[part].push_back(std::move(step));
      indices[part].push_back(static_cast<int>(layer_.statements.size()));
      layer_.statements.push_back(std::move(statement));
    }
    if (Status status = find_working_range(parts, steps); !status.ok()) return status;
    for (const PartIndex part : parts) {
      for (Step& step : steps[part]) step.values = *sampled(step.amount, options_.parameter, at_);
      TraceStep trace;
      trace.part = id(part);
      trace.kind = "seed";
      trace.statements = indices[part];
      trace.why = "the edit asked for";
      edits_[part] = PartEdit{steps[part], motion_of(shape_, part, steps[part])};
      trace_.steps.push_back(std::move(trace));
    }
    for (const PartIndex part : parts) pull_neighbours(part);
    note_conflicts_of_seeds(parts);
    return success();
  }

  /// The samples of the search lie where the seeds make sense: amounts defined, their parts neither inverted nor
  /// collapsed.
  Status find_working_range(const std::vector<PartIndex>& parts, const PartData<std::vector<Step>>& steps) {
    constexpr int batches = 8;
    constexpr int grid = batches * static_cast<int>(sample_count);
    std::string culprit;
    const auto reach = [&](double sign) {
      for (int batch = 0; batch < batches; ++batch) {
        Samples at;
        for (std::size_t s = 0; s < sample_count; ++s) {
          at[s] = sign * options_.limit * (batch * static_cast<int>(sample_count) + static_cast<int>(s) + 1) / grid;
        }
        std::size_t good = sample_count;
        for (const PartIndex part : parts) {
          std::vector<Step> sampled_steps = steps[part];
          for (Step& step : sampled_steps) {
            const CompiledAmount amount = Amount(step.amount).compile({options_.parameter});
            for (std::size_t s = 0; s < sample_count; ++s) step.values[s] = amount(&at[s]);
          }
          const Corners& rest = shape_.parts[part].hexahedron.corners;
          const Motion motion = motion_of(shape_, part, sampled_steps);
          for (std::size_t s = 0; s < good; ++s) {
            if (!is_alive(rest + motion[s], rest)) {
              good = s;
              culprit = id(part);
            }
          }
        }
        if (good < sample_count)
          return good == 0 ? (batch == 0 ? 0.0 : at[0] - sign * options_.limit / grid) : at[good - 1];
      }
      return sign * options_.limit;
    };
    const double high = reach(1);
    const double low = reach(-1);
    if (high - low < least_range * options_.limit) {
      return Error{stage, "/seed", "the seed edit turns part '" + culprit + "' inside out, or is undefined, at once",
                   "use a smaller or another amount"};
    }
    at_ = sample_points(low, high);
    return success();
  }

  void note_conflicts_of_seeds(const std::vector<PartIndex>& parts) {
    for (const PartIndex part : parts) {
      for (const RelationIndex relation : graph_.relations(part)) {
        const PartIndex other = graph_.other(relation, part);
        if (other < part || !edits_[other]) continue;
        std::vector<PointConstraint> constraints;
        add_constraints(graph_, relation, part, edits_, constraints);
        if (residuals(constraints, edits_[part]->motion)[0].second <= delta_both_edited) continue;
        trace_.notes.push_back("the seed edits of " + id(part) + " and " + id(other) + " break " + id(relation) +
                               " between them");
      }
    }
  }

  // ----- parts that a hint holds

  void hold_fixed_parts() {
    for (const auto& [part, hint] : request_.hints) {
      if (hint != Hint::keep_fixed || edits_[part] || !is_in_graph(part)) continue;
      edits_[part] = PartEdit{{}, still()};
      held_.push_back(part);
    }
    // Their neighbours must respect them, but nothing is broken by them yet.
    for (const PartIndex part : held_) pull_neighbours(part);
  }

  /// A held part that an edited neighbour pulls at gets its keep_fixed, so that the program shows the decision.
  void note_fixed_parts() {
    for (const PartIndex part : held_) {
      std::vector<PointConstraint> constraints;
      for (const RelationIndex relation : graph_.relations(part)) {
        const PartIndex other = graph_.other(relation, part);
        if (edits_[other] && !edits_[other]->steps.empty())
          add_constraints(graph_, relation, part, edits_, constraints);
      }
      const RelationResiduals off = residuals(constraints, still());
      TraceStep trace;
      trace.part = id(part);
      trace.kind = "keep_fixed";
      trace.hint = "keep_fixed";
      for (const auto& [relation, by] : off) {
        trace.pulled_by.push_back({id(relation), by});
        if (slack_of(shape_.relations[relation], by, false, false) == Slack::broken)
          trace.left_broken.push_back(id(relation));
      }
      trace.result = trace.pulled_by;
      trace.why = "a hint keeps it fixed";
      if (!trace.left_broken.empty()) {
        Why why{WhyKind::breaking, trace.left_broken};
        trace.statements.push_back(add_keep_fixed(part, std::move(why)));
      }
      trace_.steps.push_back(std::move(trace));
    }
  }

  void note_unused_hints() {
    for (const auto& [part, hint] : request_.hints) {
      const std::string words = "the hint " + std::string(to_string(hint)) + " for " + id(part);
      if (!is_in_graph(part)) {
        trace_.notes.push_back(words + " has no effect: the group is dissolved");
      } else if (std::find(request_.seed_parts.begin(), request_.seed_parts.end(), part) != request_.seed_parts.end()) {
        trace_.notes.push_back(words + " has no effect: the part has a seed edit");
      }
    }
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

  /// The unedited part with the most broken relations; one with a broken symmetry before any without.
  std::optional<PartIndex> next_part() const {
    std::optional<PartIndex> best;
    std::pair<bool, int> most{false, 0};
    for (const PartIndex part : graph_.parts()) {
      if (edits_[part] ||
          std::find(left_alone_.begin(), left_alone_.end(), std::pair(part, pulls_[part].size())) != left_alone_.end())
        continue;
      std::pair<bool, int> broken{false, 0};
      for (const auto& [relation, by] : residuals(pulls_[part], still())) {
        if (by <= exact) continue;
        broken.first = broken.first || is_side_by_side(relation);
        ++broken.second;
      }
      if (broken.second == 0) continue;
      if (!best || broken > most || (broken == most && id(part) < id(*best))) {
        best = part;
        most = broken;
      }
    }
    return best;
  }

  /// A symmetry, but for mirror images one above the other: what stands on the floor grows away from it, and its upper
  /// half is seldom asked to do the opposite of the lower one.
  bool is_side_by_side(RelationIndex relation) const {
    const auto* mirror = std::get_if<Reflection>(&shape_.relations[relation].detail);
    return shape_.relations[relation].is_symmetry() && !(mirror != nullptr && std::abs(mirror->normal.y()) > 0.5);
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
      trace.statements.push_back(add_keep_fixed(part, Why{WhyKind::breaking, trace.left_broken}));
    } else {
      trace.kind = kind_name(solution.kind);
      for (const Step& step : solution.steps) {
        Statement statement = to_statement(shape_, part, step, sources);
        statement.why = Why{solution.kind, broken};
        trace.statements.push_back(static_cast<int>(layer_.statements.size()));
        layer_.statements.push_back(std::move(statement));
      }
    }
    edits_[part] = PartEdit{std::move(solution.steps), motion};
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

  int add_keep_fixed(PartIndex part, Why why) {
    Statement statement;
    statement.op = Op::keep_fixed;
    statement.part = id(part);
    statement.why = std::move(why);
    layer_.statements.push_back(std::move(statement));
    return static_cast<int>(layer_.statements.size()) - 1;
  }

  static std::string kind_name(WhyKind kind) {
    switch (kind) {
      case WhyKind::seed:
        return "seed";
      case WhyKind::symmetry:
        return "symmetry";
      case WhyKind::attachment:
        return "attachment";
      case WhyKind::neighbour:
        return "neighbour";
      case WhyKind::breaking:
        return "breaking";
      case WhyKind::group:
        return "group";
    }
    return "";
  }

  // ----- the end

  void say_why_it_stopped() {
    std::size_t edited = 0;
    bool touches = false;
    for (const PartIndex part : graph_.parts()) {
      edited += edits_[part].has_value();
      touches = touches || !pulls_[part].empty();
    }
    if (edited == graph_.parts().size()) {
      trace_.stop = "every part is edited";
    } else if (touches) {
      trace_.stop = "no relation between an edited and an unedited part is broken";
    } else {
      trace_.stop = "no relation ties the edited parts to any other part, so nothing follows them";
    }
  }

  const Shape& shape_;
  const ResolvedRequest& request_;
  const Revisions& revisions_;
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

Result<Propagation> propagate(const Shape& shape, const EditRequest& request, const PropagateOptions& options,
                              const Progress& progress) {
  const auto resolved = resolve(request, shape);
  if (!resolved.ok()) return resolved.error();
  const Revisions none;
  Loop first(shape, *resolved, none, options, progress);
  if (const Status found = first.search(); !found.ok()) return found.error();
  if (!options.revisions) return first.finish();
  const Loop::Faults before = first.faults();
  const Revisions revisions =
      before == Loop::Faults{} ? none : find_revisions(shape, *resolved, options, first, before, progress);
  if (revisions.empty()) return first.finish();
  Loop second(shape, *resolved, revisions, options, progress);
  if (const Status found = second.search(); !found.ok()) return found.error();
  const Loop::Faults after = second.faults();
  const std::string gain = before.first > after.first
                               ? std::to_string(before.first - after.first) + " more relations are kept"
                               : std::to_string(before.second - after.second) + " fewer parts are distorted";
  Propagation result = second.finish();
  for (const auto& [part, hint] : revisions) {
    result.trace.notes.push_back("a second look: " + shape.parts[part].id +
                                 (hint == Hint::scale ? " is not moved, so that " : " is not stretched, so that ") +
                                 gain);
  }
  return result;
}

}  // namespace parsel
