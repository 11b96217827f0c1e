#include "core/propagate/alternatives.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/tolerance.h"
#include "core/propagate/decisions.h"
#include "core/propagate/pointless.h"
#include "core/propagate/search.h"
#include "core/propagate/seeds.h"
#include "core/propagate/transfer.h"

namespace parsel {

namespace {

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
    feet_ = find_feet(graph_, request_, seeds_);
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
    write_decisions(graph_, request_, seeds_, found_, layer_, trace_);
    for (std::string& note : unused_hints(graph_, request_)) trace_.notes.push_back(std::move(note));
    trace_.stop = why_it_stopped(graph_, found_.edits);
    return finished(shape_, request_, options_, at_, std::move(layer_), std::move(trace_), progress_);
  }

 private:
  bool is_seed(PartIndex part) const { return seeds_[part] != nullptr; }

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
      if (edits[part] && steps.empty() && is_to_move(part)) verdict.shapes += problem.options.prices.rest_against_hint;
    }
    if (is_pointless(graph_, request_, seeds_, feet_, edits)) verdict.relations += problem.options.prices.all_rigid;
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
                    RelationData<JointContact>(shape_.relations.size()),
                    PartData<std::optional<Footing>>(shape_.parts.size()),
                    asked_to_move(),
                    asked_to_turn(),
                    asked_to_shift()};
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      if (relation.is_attachment()) problem.contacts[r] = contact_of_joint(shape_, relation);
    }
    for (auto [part, footing] : feet_) {
      if (restriction.feet_stay) footing.mask = Vec3::Ones();
      problem.footings[part] = std::move(footing);
    }
    return problem;
  }

  /// Whether the part has to do what a hint says, or what its mirror image was asked for, so that it is no part of what
  /// stays.
  bool is_asked_to_move(PartIndex part) const {
    const auto& relations = graph_.relations(part);
    return is_to_move(part) || std::any_of(relations.begin(), relations.end(), [&](RelationIndex r) {
             return shape_.relations[r].kind == RelationKind::reflection && is_seed(graph_.other(r, part));
           });
  }

  /// Whether a hint says what the part is to do.
  bool is_to_move(PartIndex part) const {
    const auto hint = request_.hints.find(part);
    return hint != request_.hints.end() && hint->second != Hint::keep_fixed;
  }

  /// The seeds, and what is their mirror image side by side, or the mirror image of that: all four legs when one gets
  /// thinner.
  std::set<PartIndex> asked_to_move() const {
    std::set<PartIndex> asked(request_.seed_parts.begin(), request_.seed_parts.end());
    std::vector<PartIndex> open(asked.begin(), asked.end());
    while (!open.empty()) {
      const PartIndex part = open.back();
      open.pop_back();
      for (const RelationIndex r : graph_.relations(part)) {
        const auto* mirror = std::get_if<Reflection>(&shape_.relations[r].detail);
        if (mirror == nullptr || mirror->stacked) continue;
        const PartIndex other = graph_.other(r, part);
        if (asked.insert(other).second) open.push_back(other);
      }
    }
    return asked;
  }

  std::set<PartIndex> asked_to_turn() const {
    std::set<PartIndex> turning;
    for (std::size_t i = 0; i < request_.seed.size(); ++i) {
      if (request_.seed[i].op == Op::rotate) turning.insert(request_.seed_parts[i]);
    }
    for (const auto& [part, hint] : request_.hints) {
      if (hint == Hint::rotate) turning.insert(part);
    }
    return turning;
  }

  std::set<PartIndex> asked_to_shift() const {
    std::set<PartIndex> shifted;
    for (std::size_t i = 0; i < request_.seed.size(); ++i) {
      const Statement& seed = request_.seed[i];
      if (seed.op == Op::translate && seed.feature == LocalTriple{0, 0, 0}) shifted.insert(request_.seed_parts[i]);
    }
    return shifted;
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
      if (!is_seed(part) && !is_asked_to_move(part)) standing_parts.held.insert(part);
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
    return state.cost +
           (is_pointless(graph_, request_, seeds_, feet_, state.edits) ? problem.options.prices.all_rigid : 0);
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
      const bool is_body = number == largest || stands[static_cast<std::size_t>(number)];
      if (is_body && !is_asked_to_move(part)) stays.insert(part);
    }
    return stays;
  }

  bool is_in_graph(PartIndex part) const {
    return std::find(graph_.parts().begin(), graph_.parts().end(), part) != graph_.parts().end();
  }

  const Shape& shape_;
  const ResolvedRequest& request_;
  PropagateOptions options_;
  const Progress& progress_;
  Graph graph_;
  SymbolicGoals goals_;
  Edits seeds_;
  Feet feet_;
  SearchState found_;
  Samples at_{};
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
