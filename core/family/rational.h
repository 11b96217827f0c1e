// Exact fractions for elimination: the coefficients of constraints are 1 and 1/2, so that 64 bits hold what comes of
// them. (CLN's rationals, which the project has, allocate for every sum; elimination of the chair's 172 constraints took
// nothing else. What does not fit 64 bits is not wrong but lost, and stays so: callers look at the end.)
#pragma once

#include <cstdint>
#include <numeric>
#include <string>

namespace parsel::family {

class Rational {
 public:
  Rational(std::int64_t whole = 0) : numerator_(whole) {}
  Rational(std::int64_t numerator, std::int64_t denominator) : numerator_(numerator), denominator_(denominator) {
    reduce();
  }

  /// Too large for 64 bits, or divided by zero; every operation on it is lost as well.
  bool is_lost() const { return denominator_ == 0; }
  bool is_zero() const { return numerator_ == 0 && !is_lost(); }
  std::int64_t numerator() const { return numerator_; }
  std::int64_t denominator() const { return denominator_; }
  double value() const { return static_cast<double>(numerator_) / static_cast<double>(denominator_); }
  /// "3", "-1/2".
  std::string text() const {
    return std::to_string(numerator_) + (denominator_ == 1 ? "" : "/" + std::to_string(denominator_));
  }

  bool operator==(const Rational&) const = default;
  Rational operator-() const { return Rational(0) - *this; }
  friend Rational operator+(const Rational& a, const Rational& b) { return sum(a, b, false); }
  friend Rational operator-(const Rational& a, const Rational& b) { return sum(a, b, true); }
  friend Rational operator*(const Rational& a, const Rational& b) {
    std::int64_t n = 0, d = 0;
    const bool is_too_large = __builtin_mul_overflow(a.numerator_, b.numerator_, &n) ||
                              __builtin_mul_overflow(a.denominator_, b.denominator_, &d);
    return is_too_large ? lost() : Rational(n, d);
  }
  friend Rational operator/(const Rational& a, const Rational& b) {
    if (b.is_lost()) return lost();
    return a * Rational(b.denominator_, b.numerator_);
  }

 private:
  static Rational lost() { return Rational(0, 0); }
  static Rational sum(const Rational& a, const Rational& b, bool is_difference) {
    std::int64_t left = 0, right = 0, n = 0, d = 0;
    const bool is_too_large =
        __builtin_mul_overflow(a.numerator_, b.denominator_, &left) ||
        __builtin_mul_overflow(b.numerator_, a.denominator_, &right) ||
        __builtin_mul_overflow(a.denominator_, b.denominator_, &d) ||
        (is_difference ? __builtin_sub_overflow(left, right, &n) : __builtin_add_overflow(left, right, &n));
    return is_too_large ? lost() : Rational(n, d);
  }
  void reduce() {
    if (denominator_ == 0 || numerator_ == INT64_MIN || denominator_ == INT64_MIN) {
      numerator_ = denominator_ = 0;
      return;
    }
    const std::int64_t common = std::gcd(numerator_, denominator_) * (denominator_ < 0 ? -1 : 1);
    numerator_ /= common;
    denominator_ /= common;
  }

  std::int64_t numerator_ = 0, denominator_ = 1;
};

}  // namespace parsel::family
