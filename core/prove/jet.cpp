#include "core/prove/jet.h"

#include <algorithm>
#include <vector>

#include "core/base/result.h"

namespace parsel {

namespace {

constexpr std::size_t full = Jet::order + 1;
/// Carries the flags of the operands over; a jet that is not smooth keeps its value only.
Jet with_flags(Jet result, const Jet& a, const Jet& b) {
  result.smooth = result.smooth && a.smooth && b.smooth;
  result.defined = result.defined && a.defined && b.defined;
  if (!result.smooth) result.size = 1;
  return result;
}

Jet rough(const Interval& value, const Jet& a, const Jet& b) {
  Jet result(value);
  result.smooth = false;
  return with_flags(result, a, b);
}

Jet undefined() {
  Jet result(Interval::everything());
  result.smooth = false;
  result.defined = false;
  return result;
}

/// base^exponent for a constant exponent and a base > 0, by the recurrence of h' · base = exponent · base' · h.
Jet smooth_power(const Jet& base, double exponent, const Interval& value) {
  Jet result(value);
  if (base.size == 1) return with_flags(result, base, base);
  result.size = full;
  for (std::size_t k = 1; k < full; ++k) {
    Interval sum;
    for (std::size_t j = 1; j <= std::min(k, base.size - 1); ++j) {
      const double factor = exponent * static_cast<double>(j) - static_cast<double>(k - j);
      sum = sum + factor * (base.c[j] * result.c[k - j]);
    }
    result.c[k] = sum / (static_cast<double>(k) * base.c[0]);
  }
  return with_flags(result, base, base);
}

/// Σ a[j]·b[k - j] over j = first … last. The inner loop of all jets: outward rounding once for the sum instead of for
/// every operation (2.5 times faster). Each of the 2n roundings is within half an ulp of a partial result, and no
/// partial result exceeds the sum of the terms' sizes.
Interval sum_of_products(const Interval* a, const Interval* b, std::size_t first, std::size_t last, std::size_t k) {
  double low = 0;
  double high = 0;
  double size = 0;
  for (std::size_t j = first; j <= last; ++j) {
    const Interval& u = a[j];
    const Interval& v = b[k - j];
    const double p = u.low * v.low;
    const double q = u.low * v.high;
    const double r = u.high * v.low;
    const double s = u.high * v.high;
    const double least = std::min(std::min(p, q), std::min(r, s));
    const double most = std::max(std::max(p, q), std::max(r, s));
    low += least;
    high += most;
    size += std::max(-least, most);
  }
  // Overflow, and 0·∞, which min and max may drop.
  if (!(size < 1e300)) return Interval::everything();
  const double terms = static_cast<double>(last - first + 1);
  const double error = (terms + 1) * (2 * detail::ulp * size + detail::smallest);
  return {low - error, high + error};
}

using BernsteinTable = std::array<std::array<double, Jet::order>, Jet::order>;

double binomial(int n, int k) {
  double result = 1;
  for (int i = 1; i <= k; ++i) result = result * (n - k + i) / i;
  return k < 0 || k > n ? 0 : result;
}

/// Row i holds the i-th Bernstein coefficient over [-1, 1] of 1, u, u², …: a polynomial lies between the smallest and
/// the largest of its coefficients, and meets the first and last. So a bound is exact when the largest value is at an
/// end, as it mostly is. With Σ|cₖ| instead, the case rotate_broken of bench_prove took 15.0 ms; with this, 3.4.
const BernsteinTable& bernstein_table() {
  static const BernsteinTable table = [] {
    constexpr int degree = static_cast<int>(Jet::order) - 1;
    BernsteinTable entries{};
    for (int i = 0; i <= degree; ++i) {
      for (int k = 0; k <= degree; ++k) {
        double sum = 0;
        for (int j = 0; j <= k; ++j) sum += binomial(i, j) * binomial(degree - i, k - j) * ((k - j) % 2 == 0 ? 1 : -1);
        entries[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = sum / binomial(degree, k);
      }
    }
    return entries;
  }();
  return table;
}

}  // namespace

Jet operator-(const Jet& a) {
  Jet result = a;
  for (std::size_t k = 0; k < a.size; ++k) result.c[k] = -a.c[k];
  return result;
}

Jet operator+(const Jet& a, const Jet& b) {
  Jet result;
  result.size = std::max(a.size, b.size);
  const std::size_t common = std::min(a.size, b.size);
  for (std::size_t k = 0; k < common; ++k) result.c[k] = a.c[k] + b.c[k];
  for (std::size_t k = common; k < result.size; ++k) result.c[k] = a.size > b.size ? a.c[k] : b.c[k];
  return with_flags(result, a, b);
}

Jet operator-(const Jet& a, const Jet& b) {
  Jet result;
  result.size = std::max(a.size, b.size);
  const std::size_t common = std::min(a.size, b.size);
  for (std::size_t k = 0; k < common; ++k) result.c[k] = a.c[k] - b.c[k];
  for (std::size_t k = common; k < result.size; ++k) result.c[k] = a.size > b.size ? a.c[k] : -b.c[k];
  return with_flags(result, a, b);
}

Jet operator*(const Jet& a, const Jet& b) {
  if (a.size == 1 && a.c[0].low == a.c[0].high) return with_flags(a.c[0].low * b, a, b);
  if (b.size == 1 && b.c[0].low == b.c[0].high) return with_flags(b.c[0].low * a, a, b);
  Jet result;
  result.size = std::min(full, a.size + b.size - 1);
  for (std::size_t k = 0; k < result.size; ++k) {
    const std::size_t first = k < b.size ? 0 : k - b.size + 1;
    result.c[k] = sum_of_products(a.c.data(), b.c.data(), first, std::min(k, a.size - 1), k);
  }
  return with_flags(result, a, b);
}

Jet operator*(double s, const Jet& a) {
  Jet result;
  result.smooth = a.smooth;
  result.defined = a.defined;
  if (s == 0) return result;
  result.size = a.size;
  for (std::size_t k = 0; k < a.size; ++k) result.c[k] = s * a.c[k];
  return result;
}

void add_scaled(Jet& a, double s, const Jet& b) {
  for (std::size_t k = 0; k < b.size; ++k) a.c[k] = a.c[k] + s * b.c[k];
  a.size = std::max(a.size, b.size);
  a.smooth = a.smooth && b.smooth;
  a.defined = a.defined && b.defined;
}

Jet operator/(const Jet& a, const Jet& b) {
  if (b.c[0].contains(0)) return undefined();
  Jet result;
  result.size = b.size == 1 ? a.size : full;
  for (std::size_t k = 0; k < result.size; ++k) {
    Interval sum = a.c[k];
    for (std::size_t j = 1; j <= std::min(k, b.size - 1); ++j) sum = sum - b.c[j] * result.c[k - j];
    result.c[k] = sum / b.c[0];
  }
  return with_flags(result, a, b);
}

Jet sqrt(const Jet& a) {
  if (!(a.c[0].low >= -amount_noise)) return undefined();
  const Interval value = sqrt(a.c[0]);
  // The slope is infinite at 0.
  if (a.size > 1 && !(a.c[0].low > 0)) return rough(value, a, a);
  return smooth_power(a, 0.5, value);
}

SineCosine sine_cosine(const Jet& a) {
  SineCosine result{sin(a.c[0]), cos(a.c[0])};
  Jet& s = result.sine;
  Jet& c = result.cosine;
  if (a.size > 1) {
    s.size = c.size = full;
    for (std::size_t k = 1; k < full; ++k) {
      Interval sine_sum;
      Interval cosine_sum;
      for (std::size_t j = 1; j <= std::min(k, a.size - 1); ++j) {
        const Interval slope = static_cast<double>(j) * a.c[j];
        sine_sum = sine_sum + slope * c.c[k - j];
        cosine_sum = cosine_sum - slope * s.c[k - j];
      }
      s.c[k] = sine_sum / static_cast<double>(k);
      c.c[k] = cosine_sum / static_cast<double>(k);
    }
  }
  return {with_flags(s, a, a), with_flags(c, a, a)};
}

Jet atan2(const Jet& y, const Jet& x) {
  if (may_meet_cut(y.c[0], x.c[0])) return rough(atan2(Interval(-1, 1), Interval(-1, 1)), y, x);
  const Interval value = atan2(y.c[0], x.c[0]);
  if (y.size == 1 && x.size == 1) return with_flags(Jet(value), y, x);
  // θ'·(x² + y²) = x·y' - y·x'
  Jet slope_y;
  Jet slope_x;
  slope_y.size = std::max<std::size_t>(y.size - 1, 1);
  slope_x.size = std::max<std::size_t>(x.size - 1, 1);
  for (std::size_t k = 1; k < y.size; ++k) slope_y.c[k - 1] = static_cast<double>(k) * y.c[k];
  for (std::size_t k = 1; k < x.size; ++k) slope_x.c[k - 1] = static_cast<double>(k) * x.c[k];
  const Jet slope = (x * slope_y - y * slope_x) / (x * x + y * y);
  Jet result(value);
  result.size = full;
  for (std::size_t k = 1; k < full; ++k) result.c[k] = slope.c[k - 1] / static_cast<double>(k);
  return with_flags(with_flags(result, y, x), slope, slope);
}

Jet abs(const Jet& a) {
  if (a.c[0].low >= 0) return a;
  if (a.c[0].high <= 0) return -a;
  return rough(abs(a.c[0]), a, a);
}

Jet floor(const Jet& a) {
  const Interval value = floor(a.c[0]);
  if (value.low != value.high) return rough(value, a, a);
  Jet result(value);  // constant, whatever lies under it
  result.defined = a.defined;
  return result;
}

Jet min(const Jet& a, const Jet& b) {
  if (a.c[0].high <= b.c[0].low) return with_flags(a, a, b);
  if (b.c[0].high <= a.c[0].low) return with_flags(b, a, b);
  return rough(min(a.c[0], b.c[0]), a, b);
}

Jet max(const Jet& a, const Jet& b) {
  return -min(-a, -b);
}

Jet power(const Jet& base, const Jet& exponent) {
  const double constant = exponent.c[0].low;
  if (exponent.size > 1 || exponent.c[0].high != constant) return undefined();
  if (constant == std::floor(constant) && std::abs(constant) <= 64) {
    Jet product(1.0);
    for (int i = 0; i < static_cast<int>(std::abs(constant)); ++i) product = product * base;
    const Interval plain = integer_power(base.c[0], std::abs(constant));
    product.c[0] = {std::max(product.c[0].low, plain.low), std::min(product.c[0].high, plain.high)};
    return constant < 0 ? Jet(1.0) / product : product;
  }
  if (!(base.c[0].low > 0)) return undefined();
  return smooth_power(base, constant, power(base.c[0], constant));
}

double bound(const Jet& at_middle, const Jet& over_range, double radius) {
  if (!at_middle.defined || !over_range.defined) return std::numeric_limits<double>::infinity();
  const double plain = over_range.c[0].magnitude();
  if (!at_middle.smooth || !over_range.smooth) return plain;
  // f(m + radius·u) = Σ scaled[k]·u^k + remainder for u in [-1, 1]; the coefficients are middle ± spread.
  std::array<double, Jet::order> scaled{};
  double size = 0;
  double spread = 0;
  double step = 1;
  const std::size_t terms = std::min(at_middle.size, Jet::order);
  for (std::size_t k = 0; k < terms; ++k) {
    const Interval& c = at_middle.c[k];
    scaled[k] = (c.low + c.high) / 2 * step;
    size += c.magnitude() * step;
    spread += (c.high - c.low) * step;
    step *= radius;
  }
  for (std::size_t k = terms; k < Jet::order; ++k) step *= radius;
  if (over_range.size == full) spread += over_range.c[Jet::order].magnitude() * step;
  double largest = 0;
  for (const auto& row : bernstein_table()) {
    double value = 0;
    for (std::size_t k = 0; k < terms; ++k) value += row[k] * scaled[k];
    largest = std::max(largest, std::abs(value));
  }
  // Each of the roundings above is an ulp of a number no larger than size + spread; there are fewer than 64 in a row.
  const double sum = largest + spread + 64 * detail::ulp * (size + spread) + detail::smallest;
  return std::isnan(sum) ? plain : std::min(plain, sum);
}

}  // namespace parsel
