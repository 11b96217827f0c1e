#include "core/propagate/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/tolerance.h"
#include "core/propagate/urgency.h"

namespace parsel {

namespace {

using Pulls = std::vector<PointConstraint>;

struct LeftAlone {
  std::size_t pulls = 0;  ///< constraints seen
  double cost = 0;
};

struct State : SearchState {
  PartData<std::shared_ptr<const Pulls>> pulls;  ///< constraints of unedited parts by edited ones
  PartData<Urgency> urgency;
  std::map<PartIndex, LeftAlone> left_alone;
  bool finished = false;
};

class Beam {
 public:
  Beam(const Problem& problem, const std::map<PartIndex, Hint>& hints, const SearchOptions& options,
       const Progress& progress)
      : problem_(problem), shape_(problem.graph.shape()), hints_(hints), options_(options), progress_(progress) {}

  std::optional<SearchState> run(const Edits& seeds, const Restriction& restriction, double limit) {
    std::vector<State> states = {start(seeds, restriction)};
    const std::size_t parts = std::max<std::size_t>(1, problem_.graph.parts().size());
    const std::size_t width = std::clamp<std::size_t>(options_.looks / parts, 1, options_.width);
    int round = 0;
    while (!std::all_of(states.begin(), states.end(), [](const State& s) { return s.finished; })) {
      if (problem_.work > options_.work) return std::nullopt;
      std::vector<State> next;
      for (State& state : states) {
        const auto part = state.finished ? std::nullopt : next_part(state);
        if (!part) {
          state.finished = true;
          limit = std::min(limit, state.cost);
          next.push_back(std::move(state));
          continue;
        }
        report(progress_, shape_.parts[*part].name, std::min<int>(round, static_cast<int>(parts) - 1),
               static_cast<int>(parts));
        expand(state, *part, width, next);
      }
      next.erase(std::remove_if(next.begin(), next.end(),
                                [&](const State& s) { return !s.finished && s.cost > limit + 1e-9; }),
                 next.end());
      std::stable_sort(next.begin(), next.end(), [](const State& a, const State& b) { return a.cost < b.cost - 1e-9; });
      if (next.size() > width) next.resize(width);
      if (next.empty()) return std::nullopt;
      states = std::move(next);
      ++round;
    }
    if (states.empty() || states.front().cost > limit + 1e-9) return std::nullopt;
    return static_cast<SearchState&&>(states.front());
  }

 private:
  State start(const Edits& seeds, const Restriction& restriction) const {
    State state;
    state.edits = seeds;
    state.pulls = PartData<std::shared_ptr<const Pulls>>(shape_.parts.size());
    state.urgency = PartData<Urgency>(shape_.parts.size());
    std::vector<PartIndex> edited;
    for (const PartIndex part : problem_.graph.parts()) {
      if (seeds[part]) {
        edited.push_back(part);
      } else if (restriction.held.count(part) > 0) {
        state.edits[part] = std::make_shared<const PartEdit>(PartEdit{{}, still()});
        edited.push_back(part);
      }
    }
    for (const PartIndex part : edited) pull_neighbours(state, part);
    // What the seeds and the held parts break between them is the same in every state, but not under every restriction.
    for (const PartIndex part : edited) {
      Pulls constraints;
      for (const RelationIndex relation : problem_.graph.relations(part)) {
        const PartIndex other = problem_.graph.other(relation, part);
        if (other < part && state.edits[other])
          add_constraints(problem_.graph, relation, part, state.edits, constraints);
      }
      state.loss += price_of_relations(problem_, state.edits, part, constraints, state.edits[part]->motion);
    }
    state.cost = state.loss;
    return state;
  }

  void pull_neighbours(State& state, PartIndex part) const {
    for (const RelationIndex relation : problem_.graph.relations(part)) {
      const PartIndex other = problem_.graph.other(relation, part);
      if (state.edits[other]) continue;
      auto pulls = state.pulls[other] ? std::make_shared<Pulls>(*state.pulls[other]) : std::make_shared<Pulls>();
      add_constraints(problem_.graph, relation, other, state.edits, *pulls);
      state.urgency[other] = urgency_of(shape_, *pulls, hints_.count(other) > 0);
      state.pulls[other] = std::move(pulls);
    }
  }

  std::optional<PartIndex> next_part(const State& state) const {
    std::optional<PartIndex> best;
    for (const PartIndex part : problem_.graph.parts()) {
      const Urgency& urgency = state.urgency[part];
      if (state.edits[part] || urgency.broken == 0) continue;
      const auto alone = state.left_alone.find(part);
      if (alone != state.left_alone.end() && alone->second.pulls == state.pulls[part]->size()) continue;
      if (!best || urgency > state.urgency[*best] ||
          (urgency == state.urgency[*best] && shape_.parts[part].id < shape_.parts[*best].id))
        best = part;
    }
    return best;
  }

  void expand(const State& state, PartIndex part, std::size_t width, std::vector<State>& next) {
    const Pulls& constraints = *state.pulls[part];
    std::optional<Hint> hint;
    TraceStep trace;
    trace.part = shape_.parts[part].id;
    if (const auto found = hints_.find(part); found != hints_.end()) {
      hint = found->second;
      trace.hint = to_string(*hint);
    }
    bool slightly = true;
    for (const auto& [relation, by] : residuals(constraints, still())) {
      trace.pulled_by.push_back({shape_.relations[relation].id, by});
      slightly = slightly && by <= delta_one_edited;
    }
    std::vector<Proposal> proposals = propose(problem_, state.edits, part, hint, constraints, trace);
    for (std::size_t i = 1; i < proposals.size() && i <= 3; ++i)
      trace.runners_up.push_back({proposals[i].source, 0, 0, proposals[i].cost});
    if (proposals.size() > width) proposals.resize(width);
    for (Proposal& proposal : proposals) {
      State child = state;
      const auto alone = child.left_alone.find(part);
      const double before = alone == child.left_alone.end() ? 0 : alone->second.cost;
      const double loss = price_of_relations(problem_, state.edits, part, constraints, proposal.motion);
      child.cost += proposal.cost - before;
      child.loss += loss - before;
      const bool left_alone = proposal.rest && slightly;
      if (left_alone) {
        child.left_alone[part] = {constraints.size(), loss};
      } else {
        child.left_alone.erase(part);
        child.edits[part] = std::make_shared<const PartEdit>(PartEdit{proposal.steps, proposal.motion});
        pull_neighbours(child, part);
      }
      Decision decision{state.last, part, std::move(proposal), left_alone, trace};
      child.last = std::make_shared<const Decision>(std::move(decision));
      next.push_back(std::move(child));
    }
  }

  const Problem& problem_;
  const Shape& shape_;
  const std::map<PartIndex, Hint>& hints_;
  SearchOptions options_;
  const Progress& progress_;
};

}  // namespace

std::optional<SearchState> search(const Problem& problem, const Edits& seeds, const std::map<PartIndex, Hint>& hints,
                                  const Restriction& restriction, const SearchOptions& options, double limit,
                                  const Progress& progress) {
  return Beam(problem, hints, options, progress).run(seeds, restriction, limit);
}

}  // namespace parsel
