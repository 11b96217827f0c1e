#include "core/propagate/solve.h"

namespace parsel {

using GiNaC::ex;
using GiNaC::symbol;

namespace {

Solutions none(std::string why) {
  return {{}, std::move(why)};
}

Solutions solve_polynomial(const ex& equation, const symbol& unknown) {
  const ex a = equation.coeff(unknown, 2).normal();
  const ex b = equation.coeff(unknown, 1).normal();
  const ex c = equation.coeff(unknown, 0).normal();
  if (a.is_zero()) {
    if (b.is_zero()) return none("the equation does not depend on the amount");
    return {{(-c / b).normal()}, ""};
  }
  const ex discriminant = (b * b - 4 * a * c).expand();
  if (discriminant.is_zero()) return {{(-b / (2 * a)).normal()}, ""};
  const ex root = GiNaC::sqrt(discriminant);
  return {{(-b + root) / (2 * a), (-b - root) / (2 * a)}, ""};
}

/// a·cos Y + b·sin Y + c = 0 with r² = a² + b²: Y = atan2(b, a) ± arccos(−c/r), where arccos(t/r) = atan2(√(r² − t²),
/// t).
Solutions solve_circle(const ex& a, const ex& b, const ex& c) {
  const ex phase = GiNaC::atan2(b, a);
  if (c.is_zero()) return {{GiNaC::atan2(-a, b), GiNaC::atan2(a, -b)}, ""};
  const ex opening = GiNaC::atan2(GiNaC::sqrt((a * a + b * b - c * c).expand()), -c);
  return {{phase + opening, phase - opening}, ""};
}

}  // namespace

Solutions solve_for(const ex& equation, const symbol& unknown) {
  const ex expanded = equation.expand();
  if (!expanded.has(unknown)) return none("the equation does not depend on the amount");
  if (expanded.is_polynomial(unknown)) {
    if (expanded.degree(unknown) > 2) return none("the amount occurs with a power above two");
    return solve_polynomial(expanded, unknown);
  }

  const symbol cosine("cosine");
  const symbol sine("sine");
  const ex substituted = expanded.subs(GiNaC::lst{GiNaC::cos(unknown) == cosine, GiNaC::sin(unknown) == sine}).expand();
  const bool is_circle = !substituted.has(unknown) && substituted.is_polynomial(GiNaC::lst{cosine, sine}) &&
                         substituted.degree(cosine) <= 1 && substituted.degree(sine) <= 1;
  if (!is_circle) return none("the amount occurs in a form that has no closed solution here");
  const ex a = substituted.coeff(cosine, 1);
  if (a.has(sine)) return none("the amount's sine and cosine occur multiplied");
  const ex b = substituted.coeff(cosine, 0).coeff(sine, 1);
  const ex c = substituted.coeff(cosine, 0).coeff(sine, 0);
  return solve_circle(a, b, c);
}

}  // namespace parsel
