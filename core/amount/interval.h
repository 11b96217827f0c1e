// Intervals of doubles with outward rounding: every operation returns an interval that contains the exact result for
// every choice of operands in its arguments (Moore, Kearfott, Cloud 2009).
//
// Rounding is to nearest, always: no change of the floating-point environment, so the code is the same natively and in
// WebAssembly. Each basic operation is within half an ulp of the truth, and one ulp of r is at most |r|·2^-52, so
// stepping out by that much (and by the smallest normal number, for underflow) is safe; it is several times faster than
// std::nextafter. Functions of the C library are trusted to four ulps, which glibc and musl both document or exceed.
//
// An interval with a NaN end says nothing: magnitude() is infinite, contains() is true.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace parsel {

struct Interval {
  double low = 0;
  double high = 0;

  Interval() = default;
  Interval(double value) : low(value), high(value) {}
  Interval(double l, double h) : low(l), high(h) {}

  /// The whole line.
  static Interval everything() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  bool contains(double value) const { return !(value < low) && !(value > high); }
  /// An upper bound of |x| over the interval; infinite when an end is NaN.
  double magnitude() const {
    const double largest = std::max(std::abs(low), std::abs(high));
    return std::isnan(low) || std::isnan(high) ? std::numeric_limits<double>::infinity() : largest;
  }
  /// A lower bound of |x| over the interval.
  double mignitude() const { return low > 0 ? low : high < 0 ? -high : 0; }
};

namespace detail {
inline constexpr double ulp = 0x1.0p-52;
inline constexpr double smallest = std::numeric_limits<double>::min();
inline double down(double r) {
  return r - (std::abs(r) * ulp + smallest);
}
inline double up(double r) {
  return r + (std::abs(r) * ulp + smallest);
}
}  // namespace detail

inline Interval operator-(const Interval& a) {
  return {-a.high, -a.low};
}
inline Interval operator+(const Interval& a, const Interval& b) {
  return {detail::down(a.low + b.low), detail::up(a.high + b.high)};
}
inline Interval operator-(const Interval& a, const Interval& b) {
  return {detail::down(a.low - b.high), detail::up(a.high - b.low)};
}
inline Interval operator*(double s, const Interval& a) {
  const double first = s * a.low;
  const double second = s * a.high;
  return {detail::down(std::min(first, second)), detail::up(std::max(first, second))};
}
inline Interval operator*(const Interval& a, const Interval& b) {
  const double p = a.low * b.low;
  const double q = a.low * b.high;
  const double r = a.high * b.low;
  const double s = a.high * b.high;
  // std::min drops a NaN on its right side: 0·∞ must not look like a bound.
  if (std::isnan(p + q + r + s)) return Interval::everything();
  return {detail::down(std::min(std::min(p, q), std::min(r, s))), detail::up(std::max(std::max(p, q), std::max(r, s)))};
}
/// The whole line when b contains 0.
Interval operator/(const Interval& a, const Interval& b);

/// The smallest interval around both.
inline Interval hull(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// √max(x, 0): a negative part, which the caller has judged, counts as 0.
Interval sqrt(const Interval& a);
Interval sin(const Interval& a);
Interval cos(const Interval& a);
/// [-π, π] when the box meets the origin or the cut (x < 0, y = 0).
Interval atan2(const Interval& y, const Interval& x);
/// x^exponent for x > 0; the whole line when the interval reaches 0.
Interval power(const Interval& a, double exponent);
/// x^y for x >= 0, and x > 0 where y <= 0.
Interval power(const Interval& base, const Interval& exponent);
/// x^n for any x, and x != 0 where n < 0: an even power is never negative.
Interval integer_power(const Interval& base, double n);
/// The whole line when a pole may lie in the interval.
Interval tan(const Interval& a);
Interval abs(const Interval& a);
Interval floor(const Interval& a);
Interval min(const Interval& a, const Interval& b);
Interval max(const Interval& a, const Interval& b);

}  // namespace parsel
