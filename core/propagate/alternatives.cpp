#include "core/propagate/alternatives.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/propagate/search.h"
#include "core/propagate/seeds.h"
#include "core/propagate/transfer.h"
#include "core/prove/slack.h"

namespace parsel {

namespace {

/// A seed that takes a part through the floor, or a foot off it, by more than this has no use for the floor; and what
/// is this near the lowest of a shape that could not stand is its foot. Half-diagonals: the distance within which parts
/// touch.
constexpr double floor_distance = 0.01;
/// Two motions of the whole that differ by no more than this are the same rigid one.
constexpr double rigid_noise = 1e-5;

Motion still() {
  Motion motion;
  motion.fill(Corners::Zero());
  return motion;
}

/// What a ground relation asks of its part.
Footing footing_of(const Ground& ground) {
  Footing footing;
  for (const Vec3& local : ground.local) footing.points.push_back(trilinear_weights(local));
  return footing;
}

/// The part's lowest corners.
Footing footing_of(const Corners& corners) {
  const double lowest = corners.col(1).minCoeff();
  Footing footing;
  for (int k = 0; k < 8; ++k) {
    if (corners(k, 1) > lowest + floor_distance) continue;
    Weights weights = Weights::Zero();
    weights[k] = 1;
    footing.points.push_back(weights);
  }
  return footing;
}

double area_on_floor(const Vec3& low, const Vec3& high) {
  return (high.x() - low.x()) * (high.z() - low.z());
}

/// The rigid motion that takes `before` nearest to `after` (Kabsch 1976).
std::pair<Mat3, Vec3> rigid_motion(const Corners& before, const Corners& after) {
  const Vec3 a = before.colwise().mean().transpose(), b = after.colwise().mean().transpose();
  const Mat3 covariance = (before.rowwise() - a.transpose()).transpose() * (after.rowwise() - b.transpose());
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 v = svd.matrixV();
  if ((v * svd.matrixU().transpose()).determinant() < 0) v.col(2) *= -1;
  const Mat3 rotation = v * svd.matrixU().transpose();
  return {rotation, b - rotation * a};
}

class Alternatives : public Attempt {
 public:
  Alternatives(const Shape& shape, const ResolvedRequest& request, const PropagateOptions& options,
               const Progress& progress)
      : shape_(shape),
        request_(request),
        options_(options),
        progress_(progress),
        graph_(shape, request_.dissolved, request_.disabled),
        goals_(graph_) {
    layer_.request = options.request;
  }

  /// Whether there is one that is clearly better than these edits.
  bool beats(const Edits& incumbent) {
    auto seeds = apply_seeds(graph_, request_, options_);
    if (!seeds.ok()) return false;
    seeds_ = std::move(seeds->edits);
    at_ = seeds->at;
    feet_ = standing();
    layer_.statements = std::move(seeds->statements);
    trace_.steps = std::move(seeds->trace);
    trace_.notes = std::move(seeds->notes);
    const Problem free = problem({});
    const Verdict before = judge(free, incumbent);
    if (before.relations < acceptable) return false;
    auto found = find();
    if (!found) return false;
    found_ = std::move(*found);
    const Verdict after = judge(free, found_.edits);
    return after.total() < before.total() - clearly_better;
  }

  const Edits& edits() const override { return found_.edits; }

  Propagation finish() override {
    write(found_);
    for (std::string& note : unused_hints(graph_, request_)) trace_.notes.push_back(std::move(note));
    trace_.stop = why_it_stopped(graph_, found_.edits);
    return finished(shape_, request_, options_, at_, std::move(layer_), std::move(trace_), progress_);
  }

 private:
  bool is_seed(PartIndex part) const { return seeds_[part] != nullptr; }
  const std::string& id(PartIndex part) const { return shape_.parts[part].id; }
  const std::string& id(RelationIndex relation) const { return shape_.relations[relation].id; }

  // ----- what is wrong with edits

  /// Edits with less wrong than a joint that slides are not looked at again.
  static constexpr double acceptable = 3;
  /// What is to replace the edits of the greedy search must be better by more than a choice between kinds of edits.
  static constexpr double clearly_better = 1;

  struct Verdict {
    double relations = 0;  ///< joints, mirror images, feet, and a rigid motion of everything
    double shapes = 0;     ///< strain and slant of the parts that follow
    double total() const { return relations + shapes; }
  };

  Verdict judge(const Problem& problem, const Edits& edits) const {
    Edits all = edits;
    for (const PartIndex part : graph_.parts()) {
      if (!all[part]) all[part] = std::make_shared<const PartEdit>(PartEdit{{}, still()});
    }
    Verdict verdict;
    for (const PartIndex part : graph_.parts()) {
      std::vector<PointConstraint> constraints;
      for (const RelationIndex relation : graph_.relations(part)) {
        if (graph_.other(relation, part) < part) add_constraints(graph_, relation, part, all, constraints);
      }
      verdict.relations += price_of_relations(problem, all, part, constraints, all[part]->motion);
      if (is_seed(part)) continue;
      const std::vector<Step>& steps = all[part]->steps;
      if (std::any_of(steps.begin(), steps.end(), [](const Step& s) { return !is_geometric(s.what.op); })) continue;
      const Corners& rest = shape_.parts[part].hexahedron.corners;
      verdict.shapes += std::max(price_of_strain(rest, rest + all[part]->motion.front()),
                                 price_of_strain(rest, rest + all[part]->motion.back()));
      for (const Step& step : steps) verdict.shapes += step.what.op == Op::shear ? problem.options.prices.slant : 0;
    }
    if (moves_as_one(edits)) verdict.relations += problem.options.prices.all_rigid;
    return verdict;
  }

  // ----- the search

  Problem problem(const Restriction& restriction) {
    ProposalOptions solve;
    solve.neighbour_edits = options_.neighbour_edits;
    solve.breaking_edits = options_.breaking_edits;
    Problem problem{graph_,
                    goals_,
                    options_.parameter,
                    at_,
                    solve,
                    RelationData<std::optional<Contact>>(shape_.relations.size()),
                    PartData<std::optional<Footing>>(shape_.parts.size())};
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      if (!relation.is_attachment()) continue;
      problem.contacts[r] = contact_of(shape_.parts[relation.parts[0]].hexahedron.corners,
                                       shape_.parts[relation.parts[1]].hexahedron.corners);
    }
    for (auto [part, footing] : feet_) {
      if (restriction.feet_stay) footing.mask = Vec3::Ones();
      problem.footings[part] = std::move(footing);
    }
    return problem;
  }

  using Feet = std::map<PartIndex, Footing>;

  /// Parts that stand on the floor, by the ground relations that count. Of a shape that has none, as it hangs or leans,
  /// what is lowest: without an end that stays, the rod of a ceiling fan is left behind by what hangs on it. None where
  /// a seed itself takes a part off the floor or through it: then the request has no floor, and the parts that follow
  /// are not to blame.
  Feet standing() const {
    Feet feet;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const Part& part : shape_.parts) {
      low = low.cwiseMin(part.hexahedron.corners.colwise().minCoeff().transpose());
      high = high.cwiseMax(part.hexahedron.corners.colwise().maxCoeff().transpose());
    }
    const double floor = low.y();
    bool could_stand = false;
    for (const RelationIndex r : shape_.relations.indices()) {
      const auto* ground = std::get_if<Ground>(&shape_.relations[r].detail);
      if (ground == nullptr) continue;
      could_stand = true;
      const bool counts = request_.disabled.count(r) == 0 && is_active(shape_, r, request_.dissolved);
      if (counts) feet.emplace(shape_.relations[r].parts[0], footing_of(*ground));
    }
    for (const PartIndex part : graph_.parts()) {
      const Corners& corners = shape_.parts[part].hexahedron.corners;
      if (!could_stand && corners.col(1).minCoeff() <= floor + floor_distance) feet.emplace(part, footing_of(corners));
    }
    const double extent = std::max(area_on_floor(low, high), noise);
    for (auto& [part, footing] : feet) {
      const Corners& corners = shape_.parts[part].hexahedron.corners;
      footing.share = area_on_floor(corners.colwise().minCoeff(), corners.colwise().maxCoeff()) / extent;
    }
    for (const PartIndex part : graph_.parts()) {
      if (!is_seed(part)) continue;
      const Corners& rest = shape_.parts[part].hexahedron.corners;
      for (const Corners& motion : {seeds_[part]->motion.front(), seeds_[part]->motion.back()}) {
        const double bottom = (rest + motion).col(1).minCoeff();
        if (bottom < floor - floor_distance || (feet.count(part) > 0 && bottom > floor + floor_distance)) return {};
      }
    }
    return feet;
  }

  /// Parts that a hint keeps fixed.
  std::set<PartIndex> held() const {
    std::set<PartIndex> parts;
    for (const auto& [part, hint] : request_.hints) {
      if (hint == Hint::keep_fixed && !is_seed(part) && is_in_graph(part)) parts.insert(part);
    }
    return parts;
  }

  /// The cheapest state of four searches, those first that leave least to be found; together they may do most_work.
  std::optional<SearchState> find() {
    Restriction free;
    free.held = held();
    std::optional<SearchState> best;
    double cost = std::numeric_limits<double>::infinity();
    std::size_t work = 0;
    const auto consider = [&](const Restriction& restriction) {
      const Problem other = problem(restriction);
      SearchOptions search_options;
      search_options.work = most_work - std::min(most_work, work);
      auto found = search(other, seeds_, request_.hints, restriction, search_options, cost - cheaper_by, progress_);
      work += other.work;
      if (!found) return;
      const double price = total(other, *found);
      if (price >= cost - cheaper_by) return;
      best = std::move(found);
      cost = price;
    };
    std::set<PartIndex> nearest;
    for (const PartIndex part : graph_.parts()) {
      if (is_seed(part)) nearest.insert(part);
    }
    for (int reach = 0; reach < 2; ++reach) {
      Restriction body = free;
      const std::set<PartIndex> stays = body_beyond(nearest);
      body.held.insert(stays.begin(), stays.end());
      if (body.held.size() > free.held.size()) consider(body);
      const std::set<PartIndex> around = neighbours_of(nearest);
      nearest.insert(around.begin(), around.end());
    }
    Restriction standing_parts = free;
    for (const auto& [part, footing] : feet_) {
      if (!is_seed(part)) standing_parts.held.insert(part);
    }
    if (standing_parts.held.size() > free.held.size()) consider(standing_parts);
    Restriction feet = free;
    feet.feet_stay = true;
    consider(feet);
    consider(free);
    return best;
  }

  /// Another search must be cheaper by this, so that equals do not change places with rounding.
  static constexpr double cheaper_by = 1e-6;

  double total(const Problem& problem, const SearchState& state) const {
    return state.cost + (moves_as_one(state.edits) ? problem.options.prices.all_rigid : 0);
  }

  /// Whether nothing has changed but the place of the model: all that stands on the floor, beyond the seeds, moves by one
  /// rigid motion, or, where nothing stands, every part. Not where all of these have a hint or are seeds: then it was
  /// asked for.
  bool moves_as_one(const Edits& edits) const {
    std::vector<PartIndex> body;
    for (const auto& [part, footing] : feet_) {
      if (!is_seed(part)) body.push_back(part);
    }
    if (feet_.empty()) {
      for (const PartIndex part : graph_.parts()) {
        if (!graph_.relations(part).empty() || is_seed(part)) body.push_back(part);
      }
      if (body.size() < 2) return false;
    }
    const auto is_asked = [&](PartIndex part) { return is_seed(part) || request_.hints.count(part) > 0; };
    if (body.empty()) return false;
    if (std::all_of(body.begin(), body.end(), is_asked)) return false;
    const auto moves = [&](PartIndex part) { return edits[part] && !edits[part]->steps.empty(); };
    if (!std::all_of(body.begin(), body.end(), moves)) return false;
    for (const std::size_t s : {std::size_t{0}, sample_count - 1}) {
      const Corners& rest = shape_.parts[body.front()].hexahedron.corners;
      const auto [rotation, shift] = rigid_motion(rest, rest + edits[body.front()]->motion[s]);
      for (const PartIndex part : body) {
        const Corners& before = shape_.parts[part].hexahedron.corners;
        const Corners moved = (before * rotation.transpose()).rowwise() + shift.transpose();
        if ((moved - before - edits[part]->motion[s]).cwiseAbs().maxCoeff() > rigid_noise) return false;
      }
    }
    return true;
  }

  std::set<PartIndex> neighbours_of(const std::set<PartIndex>& parts) const {
    std::set<PartIndex> neighbours;
    for (const PartIndex part : parts) {
      for (const RelationIndex r : graph_.relations(part)) {
        const PartIndex other = graph_.other(r, part);
        if (shape_.relations[r].is_attachment() && parts.count(other) == 0) neighbours.insert(other);
      }
    }
    return neighbours;
  }

  /// The neighbours of some parts that belong to the body of the model: what is left of the graph of joints without
  /// those parts falls into pieces; a piece stays when it stands on the floor, or when it is the largest.
  std::set<PartIndex> body_beyond(const std::set<PartIndex>& nearest) const {
    PartData<int> piece(shape_.parts.size(), -1);
    std::vector<double> size;
    std::vector<bool> stands;
    for (const PartIndex start : graph_.parts()) {
      if (nearest.count(start) > 0 || piece[start] >= 0) continue;
      const int number = static_cast<int>(size.size());
      size.push_back(0);
      stands.push_back(false);
      std::vector<PartIndex> open = {start};
      piece[start] = number;
      while (!open.empty()) {
        const PartIndex part = open.back();
        open.pop_back();
        const Corners& corners = shape_.parts[part].hexahedron.corners;
        size.back() += (corners.colwise().maxCoeff() - corners.colwise().minCoeff()).norm();
        stands.back() = stands.back() || feet_.count(part) > 0;
        for (const PartIndex other : neighbours_of({part})) {
          if (nearest.count(other) > 0 || piece[other] >= 0) continue;
          piece[other] = number;
          open.push_back(other);
        }
      }
    }
    if (size.empty()) return {};
    const auto largest = std::max_element(size.begin(), size.end()) - size.begin();
    std::set<PartIndex> stays;
    for (const PartIndex part : neighbours_of(nearest)) {
      const int number = piece[part];
      if (number == largest || stands[static_cast<std::size_t>(number)]) stays.insert(part);
    }
    return stays;
  }

  bool is_in_graph(PartIndex part) const {
    return std::find(graph_.parts().begin(), graph_.parts().end(), part) != graph_.parts().end();
  }

  // ----- from the decisions to statements and trace

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
    for (const PartIndex part : held_) write_held(part, state.edits);
    show_dissolved_groups();
  }

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
      trace.statements.push_back(add_keep_fixed(part, Why{WhyKind::breaking, trace.left_broken}));
    } else {
      trace.kind = to_string(decision.chosen.kind);
      const std::vector<PartIndex> sources = reference_parts(part, edited);
      for (const Step& step : decision.chosen.steps) {
        Statement statement = to_statement(shape_, part, step, sources);
        statement.why = Why{decision.chosen.kind, broken};
        trace.statements.push_back(static_cast<int>(layer_.statements.size()));
        layer_.statements.push_back(std::move(statement));
      }
    }
    trace_.steps.push_back(std::move(trace));
  }

  /// A held part that an edited neighbour pulls at gets its keep_fixed, so that the program shows the decision.
  void write_held(PartIndex part, const Edits& edits) {
    std::vector<PointConstraint> constraints;
    for (const RelationIndex relation : graph_.relations(part)) {
      const PartIndex other = graph_.other(relation, part);
      if (edits[other] && !edits[other]->steps.empty()) add_constraints(graph_, relation, part, edits, constraints);
    }
    TraceStep trace;
    trace.part = id(part);
    trace.kind = "keep_fixed";
    trace.held = true;
    const bool by_hint = request_.hints.count(part) > 0;
    if (by_hint) trace.hint = "keep_fixed";
    for (const auto& [relation, by] : residuals(constraints, still())) {
      trace.pulled_by.push_back({id(relation), by});
      if (by > delta_one_edited) trace.left_broken.push_back(id(relation));
    }
    trace.result = trace.pulled_by;
    trace.why = by_hint ? "a hint keeps it fixed" : "it belongs to the body of the model, which stays";
    if (!trace.left_broken.empty()) {
      Why why{WhyKind::breaking, trace.left_broken};
      trace.statements.push_back(add_keep_fixed(part, std::move(why)));
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
      trace.statements.push_back(add_keep_fixed(instances[0], Why{WhyKind::group, {}}));
      trace_.steps.push_back(std::move(trace));
    }
  }

  int add_keep_fixed(PartIndex part, Why why) {
    Statement statement;
    statement.op = Op::keep_fixed;
    statement.part = id(part);
    statement.why = std::move(why);
    layer_.statements.push_back(std::move(statement));
    return static_cast<int>(layer_.statements.size()) - 1;
  }

  /// Whose points and axes a statement on the part may name, the nearest first: the part's own, its neighbours', those
  /// of the parts that are edited already.
  std::vector<PartIndex> reference_parts(PartIndex part, const std::vector<PartIndex>& edited) const {
    std::vector<PartIndex> sources = {part};
    for (const RelationIndex relation : graph_.relations(part)) sources.push_back(graph_.other(relation, part));
    sources.insert(sources.end(), edited.begin(), edited.end());
    return sources;
  }

  const Shape& shape_;
  const ResolvedRequest& request_;
  PropagateOptions options_;
  const Progress& progress_;
  Graph graph_;
  SymbolicGoals goals_;
  Edits seeds_;
  Feet feet_;  ///< see standing()
  SearchState found_;
  Samples at_{};
  std::set<PartIndex> held_;  ///< parts that stay without having been decided upon
  Layer layer_;
  Trace trace_;
};

}  // namespace

std::unique_ptr<Attempt> better_alternative(const Shape& shape, const ResolvedRequest& request,
                                            const PropagateOptions& options, const Edits& incumbent,
                                            const Progress& progress) {
  auto alternatives = std::make_unique<Alternatives>(shape, request, options, progress);
  if (!alternatives->beats(incumbent)) return nullptr;
  return alternatives;
}

}  // namespace parsel
