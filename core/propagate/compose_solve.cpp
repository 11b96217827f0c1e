// How LayerComposer solves amounts again: which equations there are, and their closed forms.
#include <algorithm>
#include <cmath>

#include "core/amount/amount_range.h"
#include "core/propagate/compose_part.h"
#include "core/propagate/motion.h"
#include "core/prove/range.h"

namespace parsel {

using GiNaC::ex;

namespace {

/// Equations that are tried for an amount, and pairs of them for two.
constexpr std::size_t most_equations = 5;
/// A point that an amount moves by less than this share of what it moves most is no measure of it.
constexpr double least_lever = 0.15;
/// What solved amounts are put on simple numbers within.
constexpr double simple_within = 1e-4;

const GiNaC::symbol& unknown_symbol(std::size_t number) {
  return parameter_symbol("unknown_" + std::to_string(number));
}

}  // namespace

std::vector<LayerComposer::Equation> LayerComposer::equations(PartIndex part, const Statements& statements,
                                                              std::size_t unknown) const {
  const StatementRun run(statements[unknown], names_, shape_, groups_);
  if (statements[unknown].op == Op::change_count) return {};
  State state = starts_.front();
  constexpr double unit = 0.01;
  run.run(run.resolve(state), unit, groups_, state);
  const Corners by = (state.parts[part] - starts_.front().parts[part]) / unit;
  std::vector<Equation> found;
  for (const Tie* tie : ties_of(part)) {
    const Relation& relation = *tie->constraint.relation;
    if (relation.is_group() || relation.kind == RelationKind::ground || tie->movers.size() < 2) continue;
    const bool is_first = relation.parts[0] == part;
    if (!is_first && relation.parts[1] != part) continue;
    const bool mirrors = relation.kind == RelationKind::reflection;
    const std::size_t points = mirrors ? 8 : tie->constraint.weights_a.size();
    for (int c = 0; c < 3; ++c) {
      Equation best{tie, is_first, 0, c, 0};
      for (std::size_t i = 0; i < points; ++i) {
        const double lever =
            mirrors ? by(static_cast<int>(i), c)
                    : interpolate(is_first ? tie->constraint.weights_a[i] : tie->constraint.weights_b[i], by)[c];
        if (std::abs(lever) > std::abs(best.lever) + 1e-6) best = {tie, is_first, static_cast<int>(i), c, lever};
      }
      if (best.lever != 0) found.push_back(best);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Equation& a, const Equation& b) { return std::abs(a.lever) > std::abs(b.lever) + 1e-6; });
  const double most = found.empty() ? 0 : std::abs(found.front().lever);
  std::erase_if(found, [&](const Equation& e) { return std::abs(e.lever) < least_lever * most; });
  if (found.size() > most_equations) found.resize(most_equations);
  return found;
}

namespace {

ex weighted(const Weights& weights, const ClosedPart& after, const ClosedPart& before, std::size_t c) {
  ex sum = 0;
  for (std::size_t k = 0; k < 8; ++k) {
    const double weight = weights[static_cast<int>(k)];
    if (weight != 0) sum += closed_length(weight) * (after.corners[k][c] - before.corners[k][c]);
  }
  return sum;
}

Weights corner(int k) {
  Weights weights = Weights::Zero();
  weights[k] = 1;
  return weights;
}

}  // namespace

/// By how much the neighbour's point goes in the new layer, in the equation's coordinate.
std::optional<ex> LayerComposer::goal(const Equation& equation, PartIndex part) {
  const Relation& relation = *equation.tie->constraint.relation;
  const PartIndex other = relation.parts[equation.is_first ? 1 : 0];
  if (other == part) return std::nullopt;
  const ClosedPart* before = closed_.part(other, last_);
  const ClosedPart* after = before ? closed_.part(other, last_ + 1) : nullptr;
  if (after == nullptr) return std::nullopt;
  const auto c = static_cast<std::size_t>(equation.coordinate);
  const auto i = static_cast<std::size_t>(equation.point);
  if (relation.kind != RelationKind::reflection) {
    const Constraint& constraint = equation.tie->constraint;
    return weighted(equation.is_first ? constraint.weights_b[i] : constraint.weights_a[i], *after, *before, c);
  }
  const auto& reflection = std::get<Reflection>(relation.detail);
  int image = reflection.corner_map[i];  // corner i of the second part is the image of this one of the first
  if (equation.is_first) {
    for (int k = 0; k < 8; ++k) {
      if (reflection.corner_map[static_cast<std::size_t>(k)] == equation.point) image = k;
    }
  }
  const ex along = weighted(corner(image), *after, *before, c);
  return std::abs(reflection.normal[equation.coordinate]) > 0.5 ? ex(-along) : along;
}

/// What the equation is off by, with symbols for the amounts of `unknowns`.
std::optional<ex> LayerComposer::left(const Equation& equation, PartIndex part, const Statements& statements,
                                      const std::vector<std::size_t>& unknowns) {
  const auto wanted = goal(equation, part);
  const ClosedPart* before = closed_.part(part, last_);
  if (!wanted || before == nullptr) return std::nullopt;
  Statements with = statements;
  for (const std::size_t u : unknowns) with[u].amount = Amount(ex(unknown_symbol(u)));
  std::vector<const Statement*> list;
  for (const Statement& statement : with) list.push_back(&statement);
  const auto after = closed_.after(part, *before, list, last_);
  if (!after) return std::nullopt;
  const Constraint& constraint = equation.tie->constraint;
  const auto i = static_cast<std::size_t>(equation.point);
  const Weights weights = constraint.relation->kind == RelationKind::reflection ? corner(equation.point)
                          : equation.is_first                                   ? constraint.weights_a[i]
                                                                                : constraint.weights_b[i];
  return cleaned(weighted(weights, *after, *before, static_cast<std::size_t>(equation.coordinate)) - *wanted);
}

std::optional<ex> LayerComposer::solved(const Equation& equation, PartIndex part, const Statements& statements,
                                        std::size_t unknown) {
  if (statements[unknown].op == Op::rotate) {
    return statements.size() == 1 ? solved_turn(equation, part, statements) : std::nullopt;
  }
  const auto off = left(equation, part, statements, {unknown});
  const ex symbol = unknown_symbol(unknown);
  if (!off || off->degree(symbol) != 1) return std::nullopt;
  const ex lever = off->coeff(symbol, 1);
  if (lever.is_zero()) return std::nullopt;
  return -off->coeff(symbol, 0) / lever;
}

/// Two amounts from two equations, linear in each; their product may occur in both alike.
std::optional<std::vector<ex>> LayerComposer::solved_pair(const Equation& first, const Equation& second, PartIndex part,
                                                          const Statements& statements) {
  if (first.tie == second.tie && first.point == second.point && first.coordinate == second.coordinate)
    return std::nullopt;
  if (statements[0].op == Op::rotate || statements[1].op == Op::rotate) return std::nullopt;
  const auto f = left(first, part, statements, {0, 1}), g = left(second, part, statements, {0, 1});
  if (!f || !g) return std::nullopt;
  const ex a = unknown_symbol(0), b = unknown_symbol(1);
  const auto product = [&](const ex& e) { return e.coeff(a, 1).coeff(b, 1); };
  if (f->degree(a) > 1 || f->degree(b) > 1 || g->degree(a) > 1 || g->degree(b) > 1) return std::nullopt;
  const ex difference = cleaned(*f - *g);
  for (const bool is_first : {true, false}) {
    // One of them from an equation without the other, the other then from either equation.
    const ex& one = is_first ? a : b;
    const ex& two = is_first ? b : a;
    for (const ex& without : {*f, *g, difference}) {
      if (without.degree(two) != 0 || without.degree(one) != 1) continue;
      const ex found = -without.coeff(one, 0) / without.coeff(one, 1);
      for (const ex& with : {*f, *g}) {
        const ex lever = with.coeff(two, 1).subs(one == found);
        if (with.degree(two) != 1 || lever.is_zero()) continue;
        const ex other = -with.coeff(two, 0).subs(one == found) / lever;
        return is_first ? std::vector<ex>{found, other} : std::vector<ex>{other, found};
      }
    }
  }
  if (!product(*f).is_zero() || !product(*g).is_zero()) return std::nullopt;
  const ex fa = f->coeff(a, 1), fb = f->coeff(b, 1), ga = g->coeff(a, 1), gb = g->coeff(b, 1);
  const ex f0 = f->coeff(a, 0).coeff(b, 0), g0 = g->coeff(a, 0).coeff(b, 0);
  const ex determinant = cleaned(fa * gb - fb * ga);
  if (determinant.is_zero()) return std::nullopt;
  return std::vector<ex>{(fb * g0 - gb * f0) / determinant, (ga * f0 - fa * g0) / determinant};
}

/// The angle by which the point is turned to where the neighbour's goes, seen along the axis.
std::optional<ex> LayerComposer::solved_turn(const Equation& equation, PartIndex part, const Statements& statements) {
  const Statement& turn = statements[0];
  const ClosedPart* before = closed_.part(part, last_);
  const auto origin = closed_.point(*turn.origin, last_);
  const auto axis = closed_.direction(*turn.direction, last_);
  if (before == nullptr || !origin || !axis) return std::nullopt;
  const Constraint& constraint = equation.tie->constraint;
  if (constraint.relation->kind == RelationKind::reflection) return std::nullopt;
  const auto i = static_cast<std::size_t>(equation.point);
  const Weights& weights = equation.is_first ? constraint.weights_a[i] : constraint.weights_b[i];
  ClosedVector from, to;
  for (std::size_t c = 0; c < 3; ++c) {
    from[c] = -(*origin)[c];
    for (std::size_t k = 0; k < 8; ++k) from[c] += closed_length(weights[static_cast<int>(k)]) * before->corners[k][c];
    Equation along = equation;
    along.coordinate = static_cast<int>(c);
    const auto by = goal(along, part);
    if (!by) return std::nullopt;
    from[c] = cleaned(from[c]);
    to[c] = cleaned(from[c] + *by);
  }
  const auto dot = [](const ClosedVector& a, const ClosedVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  ex sine = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t d = (c + 1) % 3, e = (c + 2) % 3;
    sine += (*axis)[c] * (from[d] * to[e] - from[e] * to[d]);
  }
  const ex cosine = dot(from, to) - dot(*axis, from) * dot(*axis, to);
  return GiNaC::atan2(cleaned(sine), cleaned(cosine));
}

/// The amount that is what it was alone where the earlier parameters are 0, if it is short enough, defined and no larger
/// than amounts may be on all ranges.
std::optional<Amount> LayerComposer::accepted(const ex& found, const Amount& alone) const {
  try {
    const Amount simple = Amount(found.normal()).simplified(simple_within, false);
    ex at_rest = simple.expression();
    for (std::size_t l = 0; l < last_; ++l) at_rest = at_rest.subs(parameter_symbol(names_[l]) == 0);
    ex sum = alone.expression();
    if (!(simple.expression() - sum).expand().is_zero()) {
      const ex change = (simple.expression() - at_rest).normal();
      if (change.is_zero()) return std::nullopt;
      sum = (at_rest - sum).expand().is_zero() ? simple.expression() : ex(sum + change);
    }
    const Amount amount(sum);
    if (amount.text().size() > longest_amount) return std::nullopt;
    std::vector<Interval> box;
    for (const Layer& layer : program_.layers) box.push_back({layer.parameter.min, layer.parameter.max});
    int budget = judging_budget / 10;
    const auto fault = find_fault(amount.compile(names_), box, largest_amount, budget);
    if (fault || budget < 0) return std::nullopt;
    return amount;
  } catch (const std::exception&) {  // GiNaC throws where it divides by zero
    return std::nullopt;
  }
}

}  // namespace parsel
