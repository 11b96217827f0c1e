#include "core/family/vote.h"

#include <Eigen/QR>
#include <algorithm>
#include <set>

#include "core/family/candidates.h"

namespace parsel::family {

namespace {

constexpr const char* stage = "family/vote";
/// Of the half-diagonal: what is nearer counts as equal, as in a family.
constexpr double tolerance_share = 1e-6;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double low(const Layout& layout, const Values& values, std::size_t part, int axis) {
  return values[static_cast<Eigen::Index>(layout.centre(part, axis))] -
         values[static_cast<Eigen::Index>(layout.extent(part, axis))] / 2;
}
double high(const Layout& layout, const Values& values, std::size_t part, int axis) {
  return values[static_cast<Eigen::Index>(layout.centre(part, axis))] +
         values[static_cast<Eigen::Index>(layout.extent(part, axis))] / 2;
}

/// Where an answer lies: the middle of some parts along x and z, and their lowest height.
Vec3 place_of(const Layout& layout, const Values& values, const std::vector<std::size_t>& parts) {
  Vec3 least = Vec3::Constant(1e300), most = -least;
  for (const std::size_t p : parts) {
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = std::min(least[axis], low(layout, values, p, axis));
      most[axis] = std::max(most[axis], high(layout, values, p, axis));
    }
  }
  return {(least[0] + most[0]) / 2, least[1], (least[2] + most[2]) / 2};
}

/// The answers laid over each other.
std::vector<Ballot> aligned(const Layout& layout, std::vector<Ballot> ballots) {
  const std::size_t count = ballots.front().absent.size();
  std::vector<std::size_t> shared;
  for (std::size_t p = 0; p < count; ++p) {
    if (std::all_of(ballots.begin(), ballots.end(), [&](const Ballot& b) { return b.has(p); })) shared.push_back(p);
  }
  if (shared.empty()) return ballots;
  std::vector<Vec3> places;
  for (const Ballot& ballot : ballots) places.push_back(place_of(layout, ballot.values, shared));
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> along;
    for (const Vec3& place : places) along.push_back(place[axis]);
    const double at = median(along);
    for (std::size_t b = 0; b < ballots.size(); ++b) {
      for (std::size_t p = 0; p < count; ++p) {
        ballots[b].values[static_cast<Eigen::Index>(layout.centre(p, axis))] += at - along[b];
      }
    }
  }
  return ballots;
}

/// Of the parts that `variation` has, over the answers that have them; of others what is there stays.
void take_medians(const Layout& layout, const std::vector<Ballot>& ballots, Variation& variation) {
  for (std::size_t p = 0; p < variation.absent.size(); ++p) {
    if (!variation.has(p)) continue;
    const auto over = [&](const auto& number) {
      std::vector<double> numbers;
      for (const Ballot& ballot : ballots) {
        if (ballot.has(p)) numbers.push_back(number(ballot.values));
      }
      return median(std::move(numbers));
    };
    for (int axis = 0; axis < 3; ++axis) {
      const double least = over([&](const Values& values) { return low(layout, values, p, axis); });
      const double most = over([&](const Values& values) { return high(layout, values, p, axis); });
      variation.values[static_cast<Eigen::Index>(layout.centre(p, axis))] = (least + most) / 2;
      variation.values[static_cast<Eigen::Index>(layout.extent(p, axis))] = most - least;
    }
    const std::size_t top = layout.top(p);
    if (top < layout.size() && layout.parameters[top].part == p) {
      const auto i = static_cast<Eigen::Index>(top);
      variation.values[i] = over([i](const Values& values) { return values[i]; });
    }
  }
}

bool has_sizes(const Layout& layout, const Variation& variation, double least) {
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const Parameter& parameter = layout.parameters[i];
    const double value = variation.values[static_cast<Eigen::Index>(i)];
    if (!variation.has(parameter.part) || parameter.quantity == Quantity::centre) continue;
    if (parameter.quantity == Quantity::size ? value <= least : value < 0) return false;
  }
  return true;
}

/// The nearest values on which the constraints hold.
Values projected(const Layout& layout, const std::vector<const Constraint*>& constraints, const Values& values) {
  Elimination elimination(layout.size());
  for (const Constraint* constraint : constraints) {
    for (const SparseRow& row : constraint->rows()) elimination.add(row);
  }
  if (elimination.rank() == 0 || elimination.is_lost()) return values;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(elimination.rank()), values.size());
  Eigen::Index r = 0;
  for (const auto& [_, row] : elimination.rows()) {
    for (const auto& [column, factor] : row) rows(r, static_cast<Eigen::Index>(column)) = factor.value();
    ++r;
  }
  return values - rows.completeOrthogonalDecomposition().solve(rows * values);
}

}  // namespace

Result<Voted> count_votes(const cad::Model& model, const Layout& layout, const std::string& name,
                          const std::vector<Ballot>& ballots) {
  if (ballots.empty()) return Error{stage, "", "no answer can be counted", "ask again, or ask another model"};
  const double tolerance = tolerance_share * half_diagonal(model);
  const Values base = values_of(layout, model);
  Voted voted;
  Variation& variation = voted.variation;
  variation = {name, "model", static_cast<int>(ballots.size()), base, std::vector<bool>(model.parts.size(), false)};
  for (std::size_t p = 0; p < model.parts.size(); ++p) {
    const auto without = std::count_if(ballots.begin(), ballots.end(), [&](const Ballot& b) { return !b.has(p); });
    variation.absent[p] = 2 * static_cast<std::size_t>(without) > ballots.size();
  }
  if (std::all_of(variation.absent.begin(), variation.absent.end(), [](bool b) { return b; })) {
    return Error{stage, "", "the answers leave no part of it", "ask again, or ask about another kind"};
  }
  take_medians(layout, aligned(layout, ballots), variation);

  struct Counted {
    const Constraint* constraint;
    std::size_t holds, of;
  };
  std::vector<Counted> wanted;
  const Candidates candidates = find_candidates(layout, model, base, tolerance);
  for (const Constraint& constraint : candidates.holding) {
    if (!variation.has(constraint.a.part) || !variation.has(constraint.b.part)) continue;
    ++voted.constraints;
    Counted counted{&constraint, 0, 0};
    for (const Ballot& ballot : ballots) {
      if (!ballot.has(constraint.a.part) || !ballot.has(constraint.b.part)) continue;
      ++counted.of;
      counted.holds += constraint.residual(ballot.values) <= tolerance;
    }
    if (2 * counted.holds <= counted.of) continue;
    ++voted.agreed;
    voted.unanimous += counted.holds == counted.of;
    wanted.push_back(counted);
  }
  std::set<std::size_t> against;  // how many speak against a constraint, most first
  for (const Counted& counted : wanted) against.insert(counted.of - counted.holds);
  const Values medians = variation.values;
  for (auto most = against.rbegin(); most != against.rend(); ++most) {
    std::vector<const Constraint*> held;
    for (const Counted& counted : wanted) {
      if (counted.of - counted.holds <= *most) held.push_back(counted.constraint);
    }
    const bool hold =
        std::all_of(held.begin(), held.end(), [&](const Constraint* c) { return c->residual(medians) <= tolerance; });
    variation.values = hold ? medians : projected(layout, held, medians);
    if (has_sizes(layout, variation, tolerance)) return voted;
  }
  variation.values = medians;
  if (has_sizes(layout, variation, tolerance)) return voted;
  return Error{stage, "", "the answers contradict each other", "ask again, or give its numbers by hand"};
}

}  // namespace parsel::family
