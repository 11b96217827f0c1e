#include "core/amount/amount_range.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "core/base/result.h"

namespace parsel {

namespace {

using Op = CompiledAmount::Op;

/// Pieces narrower than this share of the box are not halved. A pole in so thin a piece cannot be told from one beside
/// it; a coarser limit would refuse 1/(x*x + 1e-12), a finer one makes every pole take more boxes.
constexpr double narrowest = 1e-9;
/// What rounding outward adds to a value that just reaches the limit, and more.
constexpr double limit_slack = 1e-9;

/// Larger angles have no sine worth the name, and larger numbers no whole part: what two libraries make of x1^3 differs
/// in the last place, which at 1e15 is an eighth of a turn. At 1e6 it is 1e-10.
constexpr double largest_argument = 1e6;

/// What may go wrong somewhere on a box.
enum class Trouble { none, division, root, power, infinite };

struct Bound {
  Interval values;
  Trouble trouble = Trouble::none;
};

/// A root may be forgiven, see the header.
bool is_root(Trouble trouble) {
  return trouble == Trouble::root || trouble == Trouble::power;
}

Bound troubled(Trouble trouble) {
  return {Interval::everything(), trouble};
}

bool is_integer(const Interval& a) {
  return a.low == a.high && a.low == std::floor(a.low);
}

Bound raised(const Interval& base, const Interval& exponent) {
  if (is_integer(exponent)) {
    if (exponent.low < 0 && base.contains(0)) return troubled(Trouble::division);
    return {integer_power(base, exponent.low)};
  }
  if (base.low < -amount_noise) return troubled(Trouble::power);
  const Interval real(std::max(base.low, 0.0), std::max(base.high, 0.0));
  if (real.low <= 0 && exponent.low < 0) return troubled(Trouble::division);
  // As a limit 0^0 has no value.
  if (real.low <= 0 && exponent.low <= 0) return troubled(Trouble::infinite);
  return {power(real, exponent)};
}

Bound turned(const Interval& y, const Interval& x) {
  return {may_meet_cut(y, x) ? atan2(Interval(-1, 1), Interval(-1, 1)) : atan2(y, x)};
}

Bound unary(Op op, const Interval& a) {
  switch (op) {
    case Op::negate:
      return {-a};
    case Op::sqrt:
      if (a.low < -amount_noise) return troubled(Trouble::root);
      return {sqrt(a)};
    case Op::abs:
      return {abs(a)};
    case Op::floor:
      if (a.magnitude() > largest_argument) return troubled(Trouble::infinite);
      return {counted(a)};
    case Op::sin:
      if (a.magnitude() > largest_argument) return troubled(Trouble::infinite);
      return {sin(a)};
    case Op::cos:
      if (a.magnitude() > largest_argument) return troubled(Trouble::infinite);
      return {cos(a)};
    case Op::tan:
      return {tan(a)};
    case Op::constant:
    case Op::parameter:
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::atan2:
    case Op::min:
    case Op::max:
      break;
  }
  PARSEL_ASSERT(false, "the operation takes one operand");
  return {};
}

Bound binary(Op op, const Interval& a, const Interval& b) {
  switch (op) {
    case Op::add:
      return {a + b};
    case Op::subtract:
      return {a - b};
    case Op::multiply:
      return {a * b};
    case Op::divide:
      if (b.contains(0)) return troubled(Trouble::division);
      return {a / b};
    case Op::power:
      return raised(a, b);
    case Op::atan2:
      return turned(a, b);
    case Op::min:
      return {min(a, b)};
    case Op::max:
      return {max(a, b)};
    case Op::constant:
    case Op::parameter:
    case Op::negate:
    case Op::sqrt:
    case Op::abs:
    case Op::floor:
    case Op::sin:
    case Op::cos:
    case Op::tan:
      break;
  }
  PARSEL_ASSERT(false, "the operation takes two operands");
  return {};
}

/// The first trouble in the order of the code counts.
Bound bound(const CompiledAmount& amount, const std::vector<Interval>& box) {
  std::vector<Interval> stack;
  stack.reserve(amount.depth());
  for (const CompiledAmount::Instruction& instruction : amount.code()) {
    Bound result;
    if (instruction.op == Op::constant) {
      result.values = instruction.constant;
    } else if (instruction.op == Op::parameter) {
      result.values = box[instruction.parameter];
    } else if (arity(instruction.op) == 1) {
      result = unary(instruction.op, stack.back());
      stack.pop_back();
    } else {
      const Interval b = stack.back();
      stack.pop_back();
      result = binary(instruction.op, stack.back(), b);
      stack.pop_back();
    }
    if (result.trouble != Trouble::none) return result;
    if (!std::isfinite(result.values.low) || !std::isfinite(result.values.high)) return troubled(Trouble::infinite);
    stack.push_back(result.values);
  }
  return {stack.back()};
}

std::string words(Trouble trouble) {
  switch (trouble) {
    case Trouble::none:
      return "a value that grows without bound";
    case Trouble::division:
      return "a division by zero";
    case Trouble::root:
      return "the square root of a negative number";
    case Trouble::power:
      return "a power that has no value";
    case Trouble::infinite:
      return "no finite value";
  }
  return "";
}

std::vector<double> middle(const std::vector<Interval>& box) {
  std::vector<double> at;
  for (const Interval& side : box) at.push_back((side.low + side.high) / 2);
  return at;
}

class Judge {
 public:
  Judge(const CompiledAmount& amount, const std::vector<Interval>& whole, double limit, int& budget)
      : amount_(amount), whole_(whole), limit_(limit), budget_(budget) {}

  std::optional<RangeFault> run() {
    for (const bool high : {false, true}) {
      std::vector<double> corner;
      for (const Interval& side : whole_) corner.push_back(high ? side.high : side.low);
      if (auto fault = fault_at(corner)) return fault;
    }
    std::deque<std::vector<Interval>> open = {whole_};
    for (int boxes = 0; !open.empty() && budget_ >= 0; ++boxes) {
      const std::vector<Interval> box = std::move(open.front());
      open.pop_front();
      const Bound range = look(box);
      if (fits(range)) continue;
      const std::vector<double> at = middle(box);
      if (auto fault = fault_at(at)) return fault;
      const auto [side, share] = widest(box);
      if (share > narrowest && boxes < boxes_per_amount) {
        for (const bool upper : {false, true}) {
          open.push_back(box);
          (upper ? open.back()[side].low : open.back()[side].high) = at[side];
        }
      } else if (!is_root(range.trouble)) {
        return RangeFault{at, words(range.trouble)};
      }
    }
    return std::nullopt;
  }

 private:
  Bound look(const std::vector<Interval>& box) {
    budget_ -= static_cast<int>(amount_.code().size());
    return bound(amount_, box);
  }

  bool fits(const Bound& range) const {
    return range.trouble == Trouble::none && range.values.magnitude() <= limit_ * (1 + limit_slack);
  }

  std::optional<RangeFault> fault_at(const std::vector<double>& at) {
    const Bound range = look(std::vector<Interval>(at.begin(), at.end()));
    if (range.trouble == Trouble::none && range.values.mignitude() <= limit_) return std::nullopt;
    return RangeFault{at, words(range.trouble)};
  }

  std::pair<std::size_t, double> widest(const std::vector<Interval>& box) const {
    std::pair<std::size_t, double> found{0, 0};
    for (std::size_t i = 0; i < box.size(); ++i) {
      const double all = whole_[i].high - whole_[i].low;
      const double share = all > 0 ? (box[i].high - box[i].low) / all : 0;
      if (share > found.second) found = {i, share};
    }
    return found;
  }

  const CompiledAmount& amount_;
  const std::vector<Interval>& whole_;
  double limit_;
  int& budget_;
};

}  // namespace

std::optional<Interval> enclose(const CompiledAmount& amount, const std::vector<Interval>& box) {
  const Bound range = bound(amount, box);
  if (range.trouble != Trouble::none) return std::nullopt;
  return range.values;
}

std::optional<RangeFault> find_fault(const CompiledAmount& amount, const std::vector<Interval>& box, double limit,
                                     int& budget) {
  return Judge(amount, box, limit, budget).run();
}

}  // namespace parsel
