#include "core/propagate/proposals.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/base/tolerance.h"
#include "core/propagate/transfer.h"

namespace parsel {

namespace {

/// Two edits that move no corner differently by more than this are one.
constexpr double same_motion = 1e-6;
/// How many of the cheapest numeric fits are kept for the algebra, which may fail for some.
constexpr std::size_t most_fits = 12;
/// Costs below these cannot be beaten by what the source offers, so it is not asked. See price_of_kind().
constexpr double floor_of_neighbours = 0.7;
constexpr double floor_of_pairs = 1.0;
constexpr double floor_of_partial_fits = 1.2;
/// A pair of operators, on top of what the parts of the pair do to the shape.
constexpr double price_of_pair = 1.0;
constexpr double price_of_group_pair = 0.5, price_of_filling_group_pair = 1.1;
/// Deformation energy breaks ties between edits of equal price.
constexpr double price_of_energy = 0.01;
/// Rest is a little dearer than nothing, so that what fits perfectly is taken.
constexpr double price_of_rest = 0.05;

/// A candidate, or a pair of them, with the amounts that fit.
struct Fitted {
  const Candidate* first = nullptr;
  const Candidate* second = nullptr;
  Samples amount{}, second_amount{};
  std::size_t subset = 0;  ///< of the constraints that it was fitted to
  Motion motion;
  double cost = 0;
  double energy = 0;
};

/// Some of what ties the part.
struct Subset {
  std::vector<PointConstraint> constraints;
  Rows rows;
  double tolerance = exact;
};

class Proposer {
 public:
  Proposer(const Problem& problem, const Edits& edits, PartIndex part, const std::optional<Hint>& hint,
           const std::vector<PointConstraint>& constraints, TraceStep& trace)
      : problem_(problem),
        shape_(problem.graph.shape()),
        edits_(edits),
        part_(part),
        hint_(hint),
        constraints_(constraints),
        trace_(trace) {}

  std::vector<Proposal> run() {
    proposals_.push_back(rest_proposal());
    add_mirror_images();
    make_subsets();
    const bool is_group = shape_.parts[part_].is_virtual();
    generate_own(is_group);
    fit_all(own_, 0);
    if (is_group) fit_group_pairs(0);
    const bool neighbours = problem_.options.neighbour_edits;
    if (neighbours && best() > floor_of_neighbours) {
      neighbour_ = neighbour_candidates(shape_, part_, std::nullopt, constraints_, edits_);
      trace_.neighbour_candidates += static_cast<int>(neighbour_.size());
      fit_all(neighbour_, 0);
    }
    if (neighbours && best() > floor_of_pairs) fit_pairs(0);
    if (problem_.options.breaking_edits) {
      for (std::size_t subset = 1; subset < subsets_.size() && best() > floor_of_partial_fits; ++subset) {
        fit_all(own_, subset);
        fit_all(neighbour_, subset);
        if (is_group) fit_group_pairs(subset);
        if (neighbours && subsets_[subset].constraints.size() > 1) fit_pairs(subset);
      }
    }
    return close();
  }

 private:
  const Corners& rest() const { return shape_.parts[part_].hexahedron.corners; }

  static bool is_whole(const Candidate& candidate) { return candidate.what.feature == LocalTriple{0, 0, 0}; }

  // ----- proposals that need no fit

  Proposal rest_proposal() const {
    Proposal proposal;
    proposal.kind = WhyKind::breaking;
    proposal.rest = true;
    proposal.motion = still();
    proposal.source = "rest";
    proposal.why = "staying as it is gives up least";
    proposal.cost = price_of_rest + price_of_relations(problem_, edits_, part_, constraints_, proposal.motion);
    bool slightly = true;
    for (const auto& [relation, by] : residuals(constraints_, proposal.motion)) {
      const bool is_asked = shape_.relations[relation].kind == RelationKind::reflection &&
                            problem_.asked.count(problem_.graph.other(relation, part_)) > 0;
      slightly = slightly && by <= (is_asked ? exact : delta_one_edited);
    }
    if (slightly) proposal.cost = std::min(proposal.cost, problem_.options.prices.slightly_off);
    if (hint_ && *hint_ != Hint::keep_fixed) proposal.cost += problem_.options.prices.rest_against_hint;
    return proposal;
  }

  void add_mirror_images() {
    for (const auto& [relation, by] : residuals(constraints_, still())) {
      if (by <= exact || shape_.relations[relation].kind != RelationKind::reflection) continue;
      const PartIndex other = problem_.graph.other(relation, part_);
      auto steps = reflected(shape_, shape_.relations[relation], other, edits_[other]->steps);
      if (!steps || steps->empty()) continue;
      Proposal proposal;
      proposal.kind = WhyKind::symmetry;
      proposal.motion = motion_of(shape_, part_, *steps);
      proposal.steps = std::move(*steps);
      proposal.source = "mirror";
      proposal.why = "mirrors " + shape_.parts[other].id + " (" + shape_.relations[relation].id + ")";
      proposal.cost = price_of_relations(problem_, edits_, part_, constraints_, proposal.motion);
      proposals_.push_back(std::move(proposal));
    }
  }

  // ----- what the amounts are fitted to

  void add_subset(std::vector<PointConstraint> constraints, bool with_footing, double tolerance) {
    Subset subset{std::move(constraints), {}, tolerance};
    for (const PointConstraint& constraint : subset.constraints) subset.rows.add(constraint);
    const auto& footing = problem_.footings[part_];
    if (with_footing && footing) {
      for (const Weights& point : footing->points) subset.rows.add_fixed(point, footing->mask);
    }
    subsets_.push_back(std::move(subset));
  }

  void make_subsets() {
    const bool stands = problem_.footings[part_].has_value();
    add_subset(constraints_, true, delta_both_edited);
    if (stands) add_subset(constraints_, false, delta_both_edited);
    std::vector<PointConstraint> joints;
    for (const PointConstraint& constraint : constraints_) {
      if (!constraint.mirror) joints.push_back(constraint);
    }
    if (joints.size() < constraints_.size() && !joints.empty()) {
      add_subset(joints, true, delta_both_edited);
      if (stands) add_subset(joints, false, delta_both_edited);
    }
    std::vector<std::vector<PointConstraint>> single;
    for (const PointConstraint& constraint : constraints_) {
      if (single.empty() || single.back().front().relation != constraint.relation) single.emplace_back();
      single.back().push_back(constraint);
    }
    if (single.size() < 2) return;
    for (auto& group : single) {
      if (stands) add_subset(group, true, exact);
      add_subset(std::move(group), false, exact);
    }
  }

  // ----- candidates

  void generate_own(bool is_group) {
    own_ = own_candidates(shape_, part_, std::nullopt);
    trace_.own_candidates = static_cast<int>(own_.size());
    if (problem_.options.neighbour_edits) {
      const auto copies = transplants(shape_, part_, std::nullopt, constraints_, edits_);
      trace_.neighbour_candidates = static_cast<int>(copies.size());
      own_.insert(own_.end(), copies.begin(), copies.end());
    }
    if (!is_group) return;
    fills_ = fills_its_extent(shape_, part_);
    for (const Candidate& candidate : own_) {
      if (candidate.what.op == Op::change_delta && candidate.anchor == Anchor::middle) spacing_ = candidate;
    }
  }

  double hint_price(const Candidate& first, const Candidate* second) const {
    const auto fits = [&](const Candidate& c) { return allows(hint_, c.what, c.symmetry_cost); };
    // Of a pair one must be what the hint asks for; the other may always be a translation.
    const bool follows = second == nullptr ? fits(first) : fits(*second) || fits(first);
    return follows ? 0 : problem_.options.prices.against_hint;
  }

  double best() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Proposal& proposal : proposals_) least = std::min(least, proposal.cost);
    return fits_.empty() ? least : std::min(least, fits_.front().cost);
  }

  /// What a new fit must cost less than to be kept.
  double limit() const {
    return fits_.size() < most_fits ? std::numeric_limits<double>::infinity() : fits_.back().cost;
  }

  void fit_all(const std::vector<Candidate>& candidates, std::size_t subset) {
    const Subset& to = subsets_[subset];
    problem_.work += candidates.size();
    for (const Candidate& candidate : candidates) {
      const double price = price_of_kind(problem_.options.prices, candidate, fills_) + hint_price(candidate, nullptr);
      if (price >= limit()) continue;
      if (const auto found = fit(candidate, to.rows, to.tolerance)) {
        ++trace_.survivors;
        keep({&candidate, nullptr, found->amount, {}, subset, {}, price, 0});
      }
    }
  }

  const std::vector<Candidate>& shifts() {
    if (shifts_.empty()) {
      for (const Candidate& candidate : own_candidates(shape_, part_, Hint::translate)) {
        if (is_whole(candidate)) shifts_.push_back(candidate);
      }
    }
    return shifts_;
  }

  /// A group that must shift and spread does both rather than stretch its instances.
  void fit_group_pairs(std::size_t subset) {
    if (!spacing_) return;
    fit_pairs_of({&*spacing_}, subset, fills_ ? price_of_filling_group_pair : price_of_group_pair);
  }

  void fit_pairs(std::size_t subset) {
    const Vec3 centre = shape_.parts[part_].hexahedron.point(Vec3::Zero());
    std::vector<const Candidate*> partners;
    for (const Candidate& candidate : own_) {
      const Op op = candidate.what.op;
      const bool is_scale = op == Op::scale_1d || op == Op::scale_2d || op == Op::scale_3d;
      const bool is_central = is_scale && (candidate.what.origin - centre).norm() < noise;
      if (is_whole(candidate) && (op == Op::translate || is_central)) partners.push_back(&candidate);
    }
    fit_pairs_of(partners, subset, price_of_pair);
  }

  void fit_pairs_of(const std::vector<const Candidate*>& seconds, std::size_t subset, double price) {
    const Subset& to = subsets_[subset];
    for (const Candidate& first : shifts()) {
      for (const Candidate* second : seconds) {
        const double total = price + hint_price(first, second);
        if (total >= limit()) continue;
        ++trace_.pairs;
        ++problem_.work;
        const auto found = fit_pair(first, *second, to.rows, to.tolerance);
        if (!found) continue;
        ++trace_.survivors;
        keep({&first, second, found->amount, found->second, subset, {}, total, 0});
      }
    }
  }

  std::vector<Step> numeric_steps(const Fitted& fitted) const {
    std::vector<Step> steps;
    // The translation comes last, so that the other's origin is where the fit took it to be.
    if (fitted.second != nullptr)
      steps.push_back({fitted.second->what, fitted.second->anchor, 0, fitted.second_amount});
    steps.push_back({fitted.first->what, fitted.first->anchor, 0, fitted.amount});
    return steps;
  }

  /// Keeps the cheapest fits, each motion once.
  void keep(Fitted fitted) {
    fitted.motion = motion_of(shape_, part_, numeric_steps(fitted));
    const bool spreads =
        !is_geometric(fitted.first->what.op) || (fitted.second != nullptr && !is_geometric(fitted.second->what.op));
    if (!spreads) {
      double strain = 0;
      for (const std::size_t s : {std::size_t{0}, sample_count - 1}) {
        const Corners deformed = rest() + fitted.motion[s];
        strain = std::max(strain, price_of_strain(rest(), deformed));
      }
      fitted.cost += strain;
      if (fitted.cost >= limit()) return;
      if (strain > 1e-9) {
        for (const std::size_t s : {std::size_t{0}, sample_count - 1})
          fitted.energy = std::max(fitted.energy, arap_energy(rest(), rest() + fitted.motion[s]));
      }
      if (fitted.energy > largest_energy) return;
      fitted.cost += price_of_energy * fitted.energy;
    }
    fitted.cost += price_of_relations(problem_, edits_, part_, constraints_, fitted.motion);
    if (fitted.cost >= limit()) return;
    for (auto other = fits_.begin(); other != fits_.end(); ++other) {
      if (largest_difference(other->motion, fitted.motion) > same_motion) continue;
      if (other->cost <= fitted.cost + 1e-9) return;
      fits_.erase(other);
      break;
    }
    const auto place = std::upper_bound(fits_.begin(), fits_.end(), fitted,
                                        [](const Fitted& a, const Fitted& b) { return a.cost < b.cost - 1e-9; });
    fits_.insert(place, std::move(fitted));
    if (fits_.size() > most_fits) fits_.pop_back();
  }

  // ----- closed forms

  std::optional<std::vector<Step>> steps_of(const Fitted& fitted, AmountSolver& solver) {
    ++trace_.solved;
    const Relation* group = hint_ == Hint::change_count ? &shape_.relations[*shape_.parts[part_].group] : nullptr;
    return closed_steps(solver, *fitted.first, fitted.amount, fitted.second, fitted.second_amount, group);
  }

  static std::string name_of(const Fitted& fitted) {
    const auto name = [](const Candidate& c) {
      std::string words(to_string(c.what.op));
      if (!is_whole(c)) words += " of a feature";
      return words;
    };
    return fitted.second == nullptr ? name(*fitted.first) : name(*fitted.first) + " and " + name(*fitted.second);
  }

  /// The cheapest of all, in closed form.
  std::vector<Proposal> close() {
    std::size_t solved = 0;
    std::set<std::string> kinds;
    for (const Fitted& fitted : fits_) {
      if (solved == problem_.options.proposals) break;
      // One of a kind: three turns about axes side by side would leave no room for the slant that fits exactly.
      if (kinds.count(name_of(fitted)) > 0) continue;
      AmountSolver solver(subsets_[fitted.subset].constraints, edits_, problem_.goals, problem_.parameter, problem_.at);
      auto steps = steps_of(fitted, solver);
      if (!steps || is_too_long(*steps)) continue;
      Proposal proposal;
      proposal.motion = motion_of(shape_, part_, *steps);
      proposal.steps = std::move(*steps);
      proposal.cost = fitted.cost;
      proposal.kind = fitted.subset > 0 ? WhyKind::breaking
                      : fitted.second != nullptr
                          ? (shape_.parts[part_].is_virtual() ? WhyKind::group : WhyKind::attachment)
                      : fitted.first->from_neighbour ? WhyKind::neighbour
                                                     : WhyKind::attachment;
      proposal.source = name_of(fitted);
      proposal.why = proposal.source;
      kinds.insert(proposal.source);
      proposals_.push_back(std::move(proposal));
      ++solved;
    }
    std::stable_sort(proposals_.begin(), proposals_.end(),
                     [](const Proposal& a, const Proposal& b) { return a.cost < b.cost - 1e-9; });
    if (proposals_.size() > problem_.options.proposals) proposals_.resize(problem_.options.proposals);
    return std::move(proposals_);
  }

  const Problem& problem_;
  const Shape& shape_;
  const Edits& edits_;
  PartIndex part_;
  std::optional<Hint> hint_;
  const std::vector<PointConstraint>& constraints_;
  TraceStep& trace_;
  std::vector<Subset> subsets_;
  std::vector<Candidate> own_, neighbour_, shifts_;
  std::optional<Candidate> spacing_;
  bool fills_ = false;
  std::vector<Fitted> fits_;  ///< cheapest first
  std::vector<Proposal> proposals_;
};

}  // namespace

std::vector<Proposal> propose(const Problem& problem, const Edits& edits, PartIndex part,
                              const std::optional<Hint>& hint, const std::vector<PointConstraint>& constraints,
                              TraceStep& trace) {
  return Proposer(problem, edits, part, hint, constraints, trace).run();
}

}  // namespace parsel
