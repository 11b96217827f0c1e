#include "core/propagate/closed_form.h"

#include <algorithm>
#include <cmath>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"
#include "core/base/tolerance.h"
#include "core/propagate/solve.h"

namespace parsel {

using GiNaC::ex;

namespace {

double largest_difference(const Samples& a, const Samples& b) {
  double worst = 0;
  for (std::size_t s = 0; s < sample_count; ++s) worst = std::max(worst, std::abs(a[s] - b[s]));
  return worst;
}

/// Amounts that agree to this are the same closed form; the fit itself is good to about 1e-12.
constexpr double same = 1e-7;

/// Terms and factors of a sum that may still become an amount: about what fits in longest_amount. With 1,000, chains of
/// turned parts are simplified for seconds, in vain.
constexpr int most_terms = 250;

/// Counts an expression's nodes down from `left`; stops below 0.
void count_down(const ex& expression, int& left) {
  --left;
  for (std::size_t i = 0; i < expression.nops() && left >= 0; ++i) count_down(expression.op(i), left);
}

bool is_large(const ex& expression) {
  int left = most_terms;
  count_down(expression, left);
  return left < 0;
}

}  // namespace

std::vector<ClosedForm> driving_amounts(const std::vector<PointConstraint>& constraints, const Edits& edits) {
  std::vector<ClosedForm> driving;
  std::vector<PartIndex> seen;
  for (const PointConstraint& constraint : constraints) {
    if (std::find(seen.begin(), seen.end(), constraint.other) != seen.end()) continue;
    seen.push_back(constraint.other);
    for (const Step& step : edits[constraint.other]->steps) {
      ClosedForm form{step.amount, step.values};
      if (step.what.op == Op::change_count) {
        form.expression = counted_form(step.amount);
        for (double& value : form.values) value = counted(value);
      }
      const auto equals = [&form](const ClosedForm& other) {
        return largest_difference(form.values, other.values) < noise;
      };
      if (std::none_of(driving.begin(), driving.end(), equals)) driving.push_back(std::move(form));
    }
  }
  return driving;
}

std::optional<Samples> sampled(const ex& expression, const std::string& parameter, const Samples& at) {
  const CompiledAmount compiled = Amount(expression).compile({parameter});
  Samples values;
  for (std::size_t s = 0; s < sample_count; ++s) {
    values[s] = compiled(&at[s]);
    if (!std::isfinite(values[s])) return std::nullopt;
  }
  return values;
}

AmountSolver::AmountSolver(const std::vector<PointConstraint>& constraints, const Edits& edits, SymbolicGoals& goals,
                           std::string parameter, const Samples& at)
    : constraints_(constraints),
      edits_(edits),
      goals_(goals),
      parameter_(std::move(parameter)),
      at_(at),
      driving_(driving_amounts(constraints, edits)) {}

std::optional<ClosedForm> AmountSolver::solve(const Candidate& candidate, const Samples& wanted) {
  if (auto form = proportional(candidate, wanted)) return form;
  if (candidate.what.op == Op::rotate) {
    if (auto form = same_turn(candidate, wanted)) return form;
    if (auto form = from_equation(candidate, wanted)) return form;
    return from_angle(candidate, wanted);
  }
  if (auto form = from_equation(candidate, wanted)) return form;
  return from_all_points(candidate, wanted);
}

std::optional<ClosedForm> AmountSolver::proportional(const Candidate& candidate, const Samples& wanted) const {
  for (const ClosedForm& drive : driving_) {
    double dot = 0;
    double square = 0;
    for (std::size_t s = 0; s < sample_count; ++s) {
      dot += wanted[s] * drive.values[s];
      square += drive.values[s] * drive.values[s];
    }
    if (square < noise * noise) continue;
    const double factor = dot / square;
    Samples product;
    for (std::size_t s = 0; s < sample_count; ++s) product[s] = factor * drive.values[s];
    if (largest_difference(product, wanted) > same) continue;
    return shorten(factor, drive, candidate, wanted);
  }
  return std::nullopt;
}

std::optional<ClosedForm> AmountSolver::same_turn(const Candidate& candidate, const Samples& wanted) const {
  const Rows rows(constraints_);
  const double allowed = std::max(exact, missed_by(candidate, wanted, rows));
  for (const ClosedForm& drive : driving_) {
    for (const int sign : {1, -1}) {
      Samples values;
      for (std::size_t s = 0; s < sample_count; ++s) values[s] = sign * drive.values[s];
      if (missed_by(candidate, values, rows) <= allowed) return ClosedForm{sign * drive.expression, values};
    }
  }
  return std::nullopt;
}

std::optional<ClosedForm> AmountSolver::shorten(double factor, const ClosedForm& drive, const Candidate& candidate,
                                                const Samples& wanted) const {
  // Only the factor: the drive is as short as it can be, and the place of its jumps must not move.
  const double reach = candidate.field.cwiseAbs().maxCoeff();
  const bool is_angle = candidate.what.op == Op::rotate;
  const ex exact_factor = number(factor);
  std::vector<ex> factors;
  for (const double tolerance : {1e-3, 1e-5, 1e-8})
    factors.push_back(Amount(exact_factor).simplified(tolerance, is_angle).expression());
  factors.push_back(exact_factor);
  for (const ex& simple : factors) {
    const double value = Amount(simple).compile({})(nullptr);
    if (value == 0) continue;
    Samples values;
    for (std::size_t s = 0; s < sample_count; ++s) values[s] = value * drive.values[s];
    if (largest_difference(values, wanted) * reach <= simplification_slack) {
      return ClosedForm{simple * drive.expression, values};
    }
  }
  return std::nullopt;
}

std::optional<ClosedForm> AmountSolver::accept(const ex& expression, const Candidate& candidate,
                                               const Samples& wanted) const {
  // The plainest form that moves no point noticeably; lever and field are both per unit of the amount. Rounding must
  // not move anything at rest: a difference that vanishes at 0, like pi/2 - atan2(…), would no longer do so.
  const double reach = candidate.field.cwiseAbs().maxCoeff();
  const bool is_angle = candidate.what.op == Op::rotate;
  const auto at_rest = [&](const ex& form) {
    const double zero = 0;
    return std::abs(Amount(form).compile({parameter_})(&zero));
  };
  const double rest_slack = std::max(at_rest(expression), 1e-7);
  for (const double tolerance : {1e-3, 1e-5, 1e-8}) {
    const ex simple = Amount(expression).simplified(tolerance, is_angle).expression();
    if (!simple.has(parameter_symbol(parameter_)) || !(at_rest(simple) <= rest_slack)) continue;
    const auto values = sampled(simple, parameter_, at_);
    if (values && largest_difference(*values, wanted) * reach <= simplification_slack)
      return ClosedForm{simple, *values};
  }
  const auto values = sampled(expression, parameter_, at_);
  if (!values || largest_difference(*values, wanted) * reach > simplification_slack) return std::nullopt;
  if (!expression.has(parameter_symbol(parameter_))) return std::nullopt;
  return ClosedForm{expression, *values};
}

std::size_t AmountSolver::strongest(const Candidate& candidate) const {
  std::size_t best = 0;
  double largest = -1;
  for (std::size_t i = 0; i < constraints_.size(); ++i) {
    Vec3 v = interpolate(constraints_[i].weights, candidate.field);
    if (candidate.what.op == Op::rotate) v -= candidate.what.direction.dot(v) * candidate.what.direction;
    if (v.norm() > largest * (1 + 1e-9)) {
      largest = v.norm();
      best = i;
    }
  }
  return best;
}

std::optional<ClosedForm> AmountSolver::from_equation(const Candidate& candidate, const Samples& wanted) {
  const GiNaC::realsymbol unknown("amount");
  const std::size_t i = strongest(candidate);
  const Vec3 v = interpolate(constraints_[i].weights, candidate.field);
  const Vec3& axis = candidate.what.direction;
  const bool rotates = candidate.what.op == Op::rotate;
  const Vec3 sine = rotates ? turned(v, axis, pi / 2) + (v - axis.dot(v) * axis) : v;
  const Vec3 cosine = v - axis.dot(v) * axis;
  // The coordinate that the amount moves most: the best-conditioned of the point's three equations.
  std::array<int, 3> order = {0, 1, 2};
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return std::abs(sine[a]) > std::abs(sine[b]); });
  for (const int c : order) {
    if (std::abs(sine[c]) < 1e-6) break;
    const ex goal = goals_(constraints_[i], edits_, static_cast<std::size_t>(c));
    const ex moved = rotates ? ex(number(sine[c]) * GiNaC::sin(unknown) + number(cosine[c]) * (GiNaC::cos(unknown) - 1))
                             : ex(number(sine[c]) * unknown);
    for (const ex& root : solve_for(moved - goal, unknown).roots) {
      const auto values = sampled(root, parameter_, at_);
      if (!values || largest_difference(*values, wanted) > simplification_slack) continue;
      if (auto form = accept(root, candidate, wanted)) return form;
    }
  }
  return std::nullopt;
}

std::optional<ClosedForm> AmountSolver::from_all_points(const Candidate& candidate, const Samples& wanted) {
  ex sum = 0;
  for (const PointConstraint& constraint : constraints_) {
    const Vec3 v = interpolate(constraint.weights, candidate.field);
    for (std::size_t c = 0; c < 3; ++c) {
      const double coefficient = v[static_cast<int>(c)];
      if (std::abs(coefficient) > noise) sum += number(coefficient) * goals_(constraint, edits_, c);
    }
    if (is_large(sum)) return std::nullopt;
  }
  const auto values = sampled(sum, parameter_, at_);
  if (!values) return std::nullopt;
  double dot = 0, square = 0;
  for (std::size_t s = 0; s < sample_count; ++s) {
    dot += wanted[s] * (*values)[s];
    square += (*values)[s] * (*values)[s];
  }
  if (square < noise * noise) return std::nullopt;
  return accept((number(dot / square) * sum).expand(), candidate, wanted);
}

std::optional<ClosedForm> AmountSolver::from_angle(const Candidate& candidate, const Samples& wanted) {
  // The turn that takes the lever m to m + r: atan2(axis·(m × (m + r)), m·(m + r)).
  const std::size_t i = strongest(candidate);
  const Vec3& axis = candidate.what.direction;
  const Vec3 v = interpolate(constraints_[i].weights, candidate.field);
  const Vec3 lever = v - axis.dot(v) * axis;
  const Vec3 quarter = turned(v, axis, pi / 2) + lever;
  ex y = 0;
  ex x = number(lever.squaredNorm());
  for (std::size_t c = 0; c < 3; ++c) {
    const ex goal = goals_(constraints_[i], edits_, c);
    y += number(quarter[static_cast<int>(c)]) * goal;
    x += number(lever[static_cast<int>(c)]) * goal;
  }
  return accept(GiNaC::atan2(y.expand(), x.expand()), candidate, wanted);
}

namespace {

/// With n instances in a row, n − 1 gaps spread by 1 + a hold round((n − 1)·(1 + a)) gaps of the old size.
Step count_of(const Relation& group, const Step& spread) {
  const long gaps = static_cast<long>(group.parts.size()) - (group.kind == RelationKind::translation ? 1 : 0);
  Step count;
  count.what.op = Op::change_count;
  count.anchor = Anchor::fit;
  count.amount = (gaps * spread.amount + GiNaC::numeric(1, 2)).expand();
  for (std::size_t s = 0; s < sample_count; ++s) count.values[s] = static_cast<double>(gaps) * spread.values[s] + 0.5;
  return count;
}

}  // namespace

std::optional<std::vector<Step>> closed_steps(AmountSolver& solver, const Candidate& first, const Samples& amount,
                                              const Candidate* second, const Samples& second_amount,
                                              const Relation* counted) {
  std::vector<Step> steps;
  const auto add = [&](const Candidate& candidate, const std::optional<ClosedForm>& form) {
    if (form) steps.push_back({candidate.what, candidate.anchor, form->expression, form->values});
    return form.has_value();
  };
  const Candidate& spread = second == nullptr ? first : *second;
  if (!add(spread, second == nullptr ? solver.solve(first, amount) : solver.proportional(*second, second_amount))) {
    return std::nullopt;
  }
  if (counted != nullptr && spread.what.op == Op::change_delta) steps.push_back(count_of(*counted, steps.back()));
  if (second != nullptr && !add(first, solver.proportional(first, amount))) return std::nullopt;
  return steps;
}

}  // namespace parsel
