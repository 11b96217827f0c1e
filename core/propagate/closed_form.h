// From the numeric fit of a candidate to its amount in closed form. ParSEL §5.3, algorithm 3.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/propagate/screen.h"

namespace parsel {

/// Simplifying an amount may move a point by this much, half-diagonals.
inline constexpr double simplification_slack = 5e-4;

/// An amount as expression and samples.
struct ClosedForm {
  GiNaC::ex expression;
  Samples values{};
};

/// What the edits of the neighbours in the constraints move by: their amounts, rounded down for change_count. Without
/// repetition.
std::vector<ClosedForm> driving_amounts(const std::vector<PointConstraint>& constraints, const Edits& edits);

/// Values of an expression of `parameter` at the samples; nothing when it is undefined at one.
std::optional<Samples> sampled(const GiNaC::ex& expression, const std::string& parameter, const Samples& at);

class AmountSolver {
 public:
  AmountSolver(const std::vector<PointConstraint>& constraints, const Edits& edits, SymbolicGoals& goals,
               std::string parameter, const Samples& at);

  /// The closed form of the amount with which `candidate` fits the constraints, shortened within simplification_slack;
  /// nothing when none is found. In most chains the goals are multiples of one driving amount, and then so is the
  /// solution: its factor follows from the fit. Otherwise a scalar equation is solved (solve.h).
  std::optional<ClosedForm> solve(const Candidate& candidate, const Samples& wanted);
  /// The same from the driving amounts alone, for a pair of candidates.
  std::optional<ClosedForm> proportional(const Candidate& candidate, const Samples& wanted) const;

 private:
  /// The turn of a neighbour, or its opposite, where that is as good as the fit: joints that are a little off make the
  /// fitted angle differ by less than they are off.
  std::optional<ClosedForm> same_turn(const Candidate& candidate, const Samples& wanted) const;
  std::optional<ClosedForm> from_equation(const Candidate& candidate, const Samples& wanted);
  /// The least-squares amount of all points together (screen.h), where no amount meets each: Σ v·r, but for a factor.
  std::optional<ClosedForm> from_all_points(const Candidate& candidate, const Samples& wanted);
  std::optional<ClosedForm> from_angle(const Candidate& candidate, const Samples& wanted);
  std::optional<ClosedForm> accept(const GiNaC::ex& expression, const Candidate& candidate,
                                   const Samples& wanted) const;
  std::optional<ClosedForm> shorten(double factor, const ClosedForm& drive, const Candidate& candidate,
                                    const Samples& wanted) const;
  std::size_t strongest(const Candidate& candidate) const;

  const std::vector<PointConstraint>& constraints_;
  const Edits& edits_;
  SymbolicGoals& goals_;
  std::string parameter_;
  Samples at_;
  std::vector<ClosedForm> driving_;
};

/// The steps of a candidate, or of a pair whose `second` comes first, so that the origin of the first is where the fit
/// took it to be; in closed form with the amounts that they were fitted with. Nothing when one has none.
/// `counted`: the group whose count follows where it spreads, if it shall: it keeps its new extent, and as many
/// instances fill it as bring the spacing nearest to what it was.
std::optional<std::vector<Step>> closed_steps(AmountSolver& solver, const Candidate& first, const Samples& amount,
                                              const Candidate* second, const Samples& second_amount,
                                              const Relation* counted);

}  // namespace parsel
