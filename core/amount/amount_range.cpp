#include "core/amount/amount_range.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/result.h"

namespace parsel {

namespace {

using Op = CompiledAmount::Op;
using std::numbers::pi;

constexpr double root_noise = 1e-12;  ///< as in apply_operation()
constexpr int halvings = 40;
constexpr std::size_t corner_dimensions = 6;  ///< beyond, only the two extreme corners are evaluated

Interval hull(std::initializer_list<double> values) {
  const auto [low, high] = std::minmax(values);
  return {low, high};
}

bool contains(const Interval& a, double value) {
  return a.low <= value && value <= a.high;
}

/// sin on an interval: its ends, and 1 or -1 where a crest or trough lies inside.
Interval sine(const Interval& a) {
  Interval result = hull({std::sin(a.low), std::sin(a.high)});
  const auto passes = [&](double phase) {
    return std::floor((a.high - phase) / (2 * pi)) >= std::ceil((a.low - phase) / (2 * pi));
  };
  if (passes(pi / 2)) result.high = 1;
  if (passes(-pi / 2)) result.low = -1;
  return result;
}

std::optional<Interval> tangent(const Interval& a) {
  if (std::floor((a.low - pi / 2) / pi) != std::floor((a.high - pi / 2) / pi)) return std::nullopt;
  return Interval{std::tan(a.low), std::tan(a.high)};
}

Interval arc(const Interval& y, const Interval& x) {
  // Across the cut along the negative x axis atan2 jumps, but is defined.
  if (x.low <= 0 && contains(y, 0)) return {-pi, pi};
  return hull(
      {std::atan2(y.low, x.low), std::atan2(y.low, x.high), std::atan2(y.high, x.low), std::atan2(y.high, x.high)});
}

std::optional<Interval> power(const Interval& base, const Interval& exponent) {
  const double n = exponent.low;
  const bool constant = exponent.low == exponent.high;
  const auto corners = [&](double low) {
    return hull({std::pow(low, exponent.low), std::pow(low, exponent.high), std::pow(base.high, exponent.low),
                 std::pow(base.high, exponent.high)});
  };
  if (base.low > 0) return corners(base.low);
  if (!constant) return std::nullopt;
  if (n == std::floor(n)) {
    if (n < 0 && contains(base, 0)) return std::nullopt;
    Interval result = corners(base.low);
    if (contains(base, 0) && n > 0) result = hull({result.low, result.high, 0});
    return result;
  }
  if (n < 0 || base.low < -root_noise) return std::nullopt;
  return Interval{0, std::pow(std::max(base.high, 0.0), n)};
}

std::optional<Interval> unary(Op op, const Interval& a) {
  switch (op) {
    case Op::negate:
      return Interval{-a.high, -a.low};
    case Op::sqrt:
      if (a.low < -root_noise) return std::nullopt;
      return Interval{std::sqrt(std::max(a.low, 0.0)), std::sqrt(std::max(a.high, 0.0))};
    case Op::abs:
      if (contains(a, 0)) return Interval{0, std::max(-a.low, a.high)};
      return hull({std::abs(a.low), std::abs(a.high)});
    case Op::floor:
      return Interval{std::floor(a.low), std::floor(a.high)};
    case Op::sin:
      return sine(a);
    case Op::cos:
      return sine({a.low + pi / 2, a.high + pi / 2});
    case Op::tan:
      return tangent(a);
    default:
      return std::nullopt;
  }
}

std::optional<Interval> binary(Op op, const Interval& a, const Interval& b) {
  switch (op) {
    case Op::add:
      return Interval{a.low + b.low, a.high + b.high};
    case Op::subtract:
      return Interval{a.low - b.high, a.high - b.low};
    case Op::multiply:
      return hull({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    case Op::divide:
      if (contains(b, 0)) return std::nullopt;
      return hull({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
    case Op::power:
      return power(a, b);
    case Op::atan2:
      return arc(a, b);
    case Op::min:
      return Interval{std::min(a.low, b.low), std::min(a.high, b.high)};
    case Op::max:
      return Interval{std::max(a.low, b.low), std::max(a.high, b.high)};
    default:
      return std::nullopt;
  }
}

std::string cause_of(const CompiledAmount& amount, const std::vector<double>& at) {
  const auto op = amount.undefined_operation(at.data());
  if (op == Op::sqrt) return "the square root of a negative number";
  if (op == Op::divide) return "a division by zero";
  if (op == Op::power) return "a power that has no value";
  return "no finite value";
}

struct Box {
  std::vector<Interval> sides;
  int halved = 0;
};

/// Undefined, or beyond the limit, at one point.
std::optional<RangeFault> fault_at(const CompiledAmount& amount, const std::vector<double>& at, double limit) {
  const double value = amount(at.data());
  if (std::isnan(value)) return RangeFault{at, cause_of(amount, at)};
  if (std::abs(value) > limit) return RangeFault{at, "a value that grows without bound"};
  return std::nullopt;
}

std::optional<RangeFault> fault_at_corners(const CompiledAmount& amount, const std::vector<Interval>& box,
                                           double limit) {
  const std::size_t all = std::size_t{1} << std::min(box.size(), corner_dimensions);
  for (std::size_t corner = 0; corner < all; ++corner) {
    std::vector<double> at;
    for (std::size_t i = 0; i < box.size(); ++i) {
      const bool high = i < corner_dimensions ? (corner >> i & 1) != 0 : corner + 1 == all;
      at.push_back(high ? box[i].high : box[i].low);
    }
    if (auto fault = fault_at(amount, at, limit)) return fault;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Interval> enclose(const CompiledAmount& amount, const std::vector<Interval>& box) {
  std::vector<Interval> stack;
  stack.reserve(amount.depth());
  for (const CompiledAmount::Instruction& instruction : amount.code()) {
    std::optional<Interval> result;
    if (instruction.op == Op::constant) {
      result = Interval{instruction.constant, instruction.constant};
    } else if (instruction.op == Op::parameter) {
      result = box[instruction.parameter];
    } else if (arity(instruction.op) == 1) {
      result = unary(instruction.op, stack.back());
      stack.pop_back();
    } else {
      const Interval b = stack.back();
      stack.pop_back();
      result = binary(instruction.op, stack.back(), b);
      stack.pop_back();
    }
    if (!result || !std::isfinite(result->low) || !std::isfinite(result->high)) return std::nullopt;
    stack.push_back(*result);
  }
  return stack.back();
}

std::optional<RangeFault> find_fault(const CompiledAmount& amount, const std::vector<Interval>& box, double limit,
                                     int& budget) {
  if (auto fault = fault_at_corners(amount, box, limit)) return fault;
  std::vector<Box> open = {{box, 0}};
  while (!open.empty() && budget > 0) {
    --budget;
    const Box current = std::move(open.back());
    open.pop_back();
    const auto range = enclose(amount, current.sides);
    if (range && std::max(-range->low, range->high) <= limit) continue;
    std::vector<double> centre;
    std::size_t widest = 0;
    double most = 0;
    for (std::size_t i = 0; i < box.size(); ++i) {
      const Interval& side = current.sides[i];
      centre.push_back((side.low + side.high) / 2);
      // Widths count relative to the whole, so that all parameters are narrowed alike.
      const double width = box[i].high > box[i].low ? (side.high - side.low) / (box[i].high - box[i].low) : 0;
      if (width > most) {
        most = width;
        widest = i;
      }
    }
    if (auto fault = fault_at(amount, centre, limit)) return fault;
    if (most == 0 || current.halved == halvings * static_cast<int>(box.size())) continue;
    for (const bool upper : {false, true}) {
      Box half = current;
      ++half.halved;
      (upper ? half.sides[widest].low : half.sides[widest].high) = centre[widest];
      open.push_back(std::move(half));
    }
  }
  return std::nullopt;
}

}  // namespace parsel
