// Taylor jets of intervals: functions of one parameter x, with rigorous bounds over a range of it.
//
// A jet holds the Taylor coefficients c[k] = f⁽ᵏ⁾/k! of a function, as intervals. Run once at the midpoint m of a range
// X = [m - h, m + h] and once with x = X itself, the two jets bound the function by Taylor's theorem:
//   f(x) ∈ Σ_{k<N} c_k(m)·(x - m)^k + c_N(X)·(x - m)^N                                   (Moore 1966, N = Jet::order)
// Motions that cancel, cancel coefficient by coefficient in the first jet, which plain intervals cannot see: of two
// parts that turn by the same sin and cos only rounding and the last term, of order h^N, are left, without any
// bisection.
#pragma once

#include <array>
#include <cstddef>

#include "core/amount/amount.h"
#include "core/amount/interval.h"

namespace parsel {

struct Jet {
  static constexpr std::size_t order = 8;

  std::array<Interval, order + 1> c{};  ///< c[size…] are exactly 0
  std::size_t size = 1;                 ///< 1 … order + 1
  bool smooth = true;                   ///< false: a kink or jump may lie in the range; only c[0] counts
  bool defined = true;                  ///< false: the function may be undefined somewhere in the range

  Jet() = default;
  Jet(double value) { c[0] = value; }
  Jet(const Interval& value) { c[0] = value; }
  /// The parameter itself, at a point or over a range.
  static Jet variable(const Interval& value) {
    Jet jet(value);
    jet.c[1] = 1;
    jet.size = 2;
    return jet;
  }
};

Jet operator-(const Jet& a);
Jet operator+(const Jet& a, const Jet& b);
Jet operator-(const Jet& a, const Jet& b);
Jet operator*(const Jet& a, const Jet& b);
Jet operator*(double s, const Jet& a);
Jet operator/(const Jet& a, const Jet& b);
/// a += s·b, without temporaries: the inner loop of every relation.
void add_scaled(Jet& a, double s, const Jet& b);

Jet sqrt(const Jet& a);
struct SineCosine {
  Jet sine, cosine;
};
SineCosine sine_cosine(const Jet& a);
Jet atan2(const Jet& y, const Jet& x);
Jet abs(const Jet& a);
Jet floor(const Jet& a);
Jet min(const Jet& a, const Jet& b);
Jet max(const Jet& a, const Jet& b);
/// Constant exponents only; another one gives an undefined jet. An even power is never negative.
Jet power(const Jet& base, const Jet& exponent);

/// An upper bound of |f| over [m - radius, m + radius] from the jets at m and over that range; infinite when it may be
/// undefined there.
double bound(const Jet& at_middle, const Jet& over_range, double radius);

}  // namespace parsel
