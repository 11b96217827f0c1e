#include "core/amount/interval.h"

#include "core/base/tolerance.h"

namespace parsel {

namespace {

/// Four ulps outward, and never beyond [floor, ceiling].
Interval library(double low, double high, double floor_value, double ceiling) {
  constexpr double step = 4 * detail::ulp;
  return {std::max(low - (std::abs(low) * step + detail::smallest), floor_value),
          std::min(high + (std::abs(high) * step + detail::smallest), ceiling)};
}

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether some point phase + 2πk may lie in the interval; says yes when in doubt.
bool meets(const Interval& a, double phase) {
  const double slack = 1e-9 * (1 + a.magnitude());
  const double first = std::ceil((a.low - slack - phase) / (2 * pi));
  const double last = std::floor((a.high + slack - phase) / (2 * pi));
  return !(last < first);
}

/// Range of sin or cos: values at the ends, and ±1 where a crest or trough may lie inside.
Interval wave(const Interval& a, double at_low, double at_high, double crest) {
  Interval range = library(std::min(at_low, at_high), std::max(at_low, at_high), -1, 1);
  if (meets(a, crest)) range.high = 1;
  if (meets(a, crest + pi)) range.low = -1;
  return range;
}

/// Beyond this the argument's own rounding and the slack of meets() make the range worthless.
bool is_moderate(const Interval& a) {
  return a.magnitude() < 1e6;
}

}  // namespace

Interval operator/(const Interval& a, const Interval& b) {
  if (b.contains(0)) return Interval::everything();
  const double p = a.low / b.low;
  const double q = a.low / b.high;
  const double r = a.high / b.low;
  const double s = a.high / b.high;
  if (std::isnan(p + q + r + s)) return Interval::everything();
  return {detail::down(std::min(std::min(p, q), std::min(r, s))), detail::up(std::max(std::max(p, q), std::max(r, s)))};
}

Interval sqrt(const Interval& a) {
  return library(std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0)), 0, infinity);
}

Interval sin(const Interval& a) {
  if (!is_moderate(a)) return {-1, 1};
  return wave(a, std::sin(a.low), std::sin(a.high), pi / 2);
}

Interval cos(const Interval& a) {
  if (!is_moderate(a)) return {-1, 1};
  return wave(a, std::cos(a.low), std::cos(a.high), 0);
}

Interval atan2(const Interval& y, const Interval& x) {
  // The constant is rounded: the exact π lies above the double.
  constexpr double half_turn = 3.14159265358979356;
  const bool away = x.low > 0 || y.low > 0 || y.high < 0;
  if (!away) return {-half_turn, half_turn};
  const double corners[4] = {std::atan2(y.low, x.low), std::atan2(y.low, x.high), std::atan2(y.high, x.low),
                             std::atan2(y.high, x.high)};
  return library(*std::min_element(corners, corners + 4), *std::max_element(corners, corners + 4), -half_turn,
                 half_turn);
}

Interval power(const Interval& a, double exponent) {
  if (!(a.low > 0)) return Interval::everything();
  const double first = std::pow(a.low, exponent);
  const double second = std::pow(a.high, exponent);
  return library(std::min(first, second), std::max(first, second), 0, infinity);
}

Interval power(const Interval& base, const Interval& exponent) {
  const double corners[4] = {std::pow(base.low, exponent.low), std::pow(base.low, exponent.high),
                             std::pow(base.high, exponent.low), std::pow(base.high, exponent.high)};
  return library(*std::min_element(corners, corners + 4), *std::max_element(corners, corners + 4), 0, infinity);
}

Interval integer_power(const Interval& base, double n) {
  if (n == 0) return 1;
  const bool even = std::fmod(n, 2) == 0;
  if (n < 0 && base.contains(0)) return Interval::everything();
  const double low = std::pow(even ? base.mignitude() : base.low, n);
  const double high = std::pow(even ? base.magnitude() : base.high, n);
  return library(std::min(low, high), std::max(low, high), even ? 0 : -infinity, infinity);
}

Interval tan(const Interval& a) {
  if (!is_moderate(a) || meets(a, pi / 2) || meets(a, -pi / 2)) return Interval::everything();
  return library(std::tan(a.low), std::tan(a.high), -infinity, infinity);
}

Interval abs(const Interval& a) {
  return {a.mignitude(), a.magnitude()};
}

Interval floor(const Interval& a) {
  return {std::floor(a.low), std::floor(a.high)};
}

Interval min(const Interval& a, const Interval& b) {
  return {std::min(a.low, b.low), std::min(a.high, b.high)};
}

Interval max(const Interval& a, const Interval& b) {
  return {std::max(a.low, b.low), std::max(a.high, b.high)};
}

}  // namespace parsel
