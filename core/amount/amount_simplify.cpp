// Puts noisy coefficients on the simple numbers that they are near.
//
// A number is snapped to p/q only while few such numbers exist: fractions with a denominator up to q lie about 1/q²
// apart on average, so that one is within the tolerance by chance with probability near 2·q²·tolerance; `chance` bounds
// it. Multiples of π and square roots come after fractions, with fewer members each, under the same bound.
#include <array>
#include <cmath>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"
#include "core/base/result.h"
#include "core/base/tolerance.h"

namespace parsel {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

constexpr double chance = 0.06;
constexpr std::array<long, 8> angle_parts = {1, 2, 3, 4, 5, 6, 8, 12};  ///< π/5 … as designers use them
constexpr long largest_root = 12;                                       ///< sqrt(2/1) … sqrt(11/12)

std::optional<ex> near_fraction(double value, double tolerance) {
  for (long q = 1; 2 * static_cast<double>(q * q) * tolerance <= chance && q <= 1000; ++q) {
    const double p = std::round(value * static_cast<double>(q));
    if (p == 0 || std::abs(p) > 1e6) continue;
    if (std::abs(value - p / static_cast<double>(q)) <= tolerance) return numeric(static_cast<long>(p), q);
  }
  return std::nullopt;
}

std::optional<ex> near_angle(double value, double tolerance) {
  // 2·(sum of angle_parts)/π candidates a unit.
  if (26 * tolerance > chance) return std::nullopt;
  for (const long q : angle_parts) {
    const double p = std::round(value / pi * static_cast<double>(q));
    if (p == 0 || std::abs(p) > 100) continue;
    if (std::abs(value - p * pi / static_cast<double>(q)) <= tolerance)
      return numeric(static_cast<long>(p), q) * GiNaC::Pi;
  }
  return std::nullopt;
}

std::optional<ex> near_root(double value, double tolerance) {
  // At most largest_root²/2 candidates a unit.
  if (static_cast<double>(largest_root * largest_root) * tolerance > chance) return std::nullopt;
  for (long q = 1; q <= largest_root; ++q) {
    const double p = std::round(value * value * static_cast<double>(q));
    if (p < 1 || p > largest_root) continue;
    const double root = std::sqrt(p / static_cast<double>(q));
    if (std::abs(std::abs(value) - root) <= tolerance) {
      return (value < 0 ? -1 : 1) * pow(ex(numeric(static_cast<long>(p), q)), numeric(1, 2));
    }
  }
  return std::nullopt;
}

/// The decimal of fewest places within a tenth of the tolerance.
ex rounded(double value, double tolerance) {
  for (int places = 0; places <= 15; ++places) {
    const double scale = std::pow(10.0, places);
    const double whole = std::round(value * scale);
    if (std::abs(whole) > 1e15) break;
    if (std::abs(whole / scale - value) <= tolerance / 10) return Amount::constant(whole / scale).expression();
  }
  return inexact(value);
}

/// What numbers are put on.
struct Grid {
  double tolerance = 0;
  bool is_angle = false;  ///< multiples of π as well: 0.3927 is π/8 as an angle, and no more than 0.3927 as a length
};

ex snapped(double value, const Grid& grid) {
  const double tolerance = grid.tolerance;
  if (std::abs(value) <= tolerance) return 0;
  if (const auto fraction = near_fraction(value, tolerance)) return *fraction;
  if (grid.is_angle) {
    if (const auto angle = near_angle(value, tolerance)) return *angle;
  }
  if (const auto root = near_root(value, tolerance)) return *root;
  return rounded(value, tolerance);
}

ex simplify(const ex& e, const Grid& grid);

bool is_constant(const ex& e) {
  if (is_a<GiNaC::symbol>(e)) return false;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    if (!is_constant(e.op(i))) return false;
  }
  return true;
}

/// A coefficient with a π or a root in it comes from exact algebra and stays, unless all of it is tiny.
ex simplify_product(const ex& e, const Grid& grid) {
  double coefficient = 1;
  double constants = 1;
  ex rest = 1;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    const ex& factor = e.op(i);
    if (is_a<numeric>(factor)) {
      coefficient = ex_to<numeric>(factor).to_double();
    } else if (is_constant(factor)) {
      constants *= Amount(factor).compile({})(nullptr);
    } else {
      rest = rest * simplify(factor, grid);
    }
  }
  if (std::abs(coefficient * constants) <= grid.tolerance) return 0;
  if (constants == 1) return coefficient == 1 ? rest : snapped(coefficient, grid) * rest;
  ex exact = 1;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    if (is_constant(e.op(i))) exact = exact * e.op(i);
  }
  return exact * rest;
}

/// Exponents stay, and so does a base that would vanish.
ex simplify_power(const ex& e, const Grid& grid) {
  if (is_a<numeric>(e.op(0))) return e;
  const ex base = simplify(e.op(0), grid);
  return base.is_zero() ? e : pow(base, e.op(1));
}

ex simplify(const ex& e, const Grid& grid) {
  if (is_a<numeric>(e)) return snapped(ex_to<numeric>(e).to_double(), grid);
  if (is_a<GiNaC::mul>(e)) return simplify_product(e, grid);
  if (is_a<GiNaC::power>(e)) return simplify_power(e, grid);
  if (e.nops() == 0) return e;
  struct Inside : GiNaC::map_function {
    Grid grid;
    ex operator()(const ex& operand) override { return simplify(operand, grid); }
  };
  Inside inside;
  inside.grid = grid;
  return e.map(inside);
}

}  // namespace

Amount Amount::simplified(double tolerance, bool is_angle) const {
  PARSEL_ASSERT(tolerance > 0, "a tolerance is positive");
  return Amount(simplify(expression_, Grid{tolerance, is_angle}));
}

}  // namespace parsel
