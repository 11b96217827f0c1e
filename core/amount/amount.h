// Amounts: closed-form expressions of the parameters, on top of GiNaC.
//
// Grammar (the same as web/src/program/parse.ts; tests/golden/expression_vectors.json keeps the two in step):
//   sum     = product { ("+" | "-") product }
//   product = unary { ("*" | "/") unary }
//   unary   = ("-" | "+") unary | power                   so -x^2 = -(x^2)
//   power   = primary [ "^" unary ]                       right-associative; x^-2 is allowed
//   primary = number | "pi" | parameter | function "(" sum { "," sum } ")" | "(" sum ")"
//   function = sqrt abs floor sin cos tan (1 argument), atan2 (y, x), min max (2 or more)
//   number  = (digits ["." [digits]] | "." digits) [("e" | "E") ["+" | "-"] digits], finite as a double
//   parameter = [a-z][a-z0-9_]* that is no function name and not pi; blanks, tabs and line ends separate tokens
// At most 4,096 characters and 64 levels: open parentheses, pending signs and pending right sides of "^" together.
//
// Numbers. A decimal of at most 12 significant digits between 1e-25 and 1e25 is the exact rational that it reads as, so
// that 0.5 is 1/2; an integer without point or exponent is always exact; what else is a double.
//
// Undefined is NaN, never infinity: division by zero, 0 to a negative power, a root or fractional power of a negative
// (but down to -1e-12, the noise of an expanded square, it counts as 0), anything too large for a double. NaN goes
// through every operation. GiNaC simplifies on construction, so that removable singularities vanish: x/x is 1.
//
// An amount that was read from text is evaluated as it is written, operation by operation, as the page does: x1/0.05
// and 20*x1 are one expression and two different doubles, and a screen that rounds down where the export rounds up
// shows another number of slats. So x/x is undefined at 0 there.
//
// Whole numbers: floor(a) is ⌊a + 1e-9⌋, in amounts and for counts. 0.15/0.05 is a hair below 3 in doubles and means 3.
#pragma once

#include <ginac/ginac.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/amount/interval.h"
#include "core/base/result.h"

namespace parsel {

/// What rounding down forgives. Less, and 0.15/0.05 adds 2 instead of 3; much more, and a slider sees a count change
/// before its mark.
inline constexpr double counting_slack = 1e-9;
/// The one rule of whole numbers, for doubles, intervals and jets: what floor() in amounts gives, and how many
/// instances change_count adds.
template <class T>
T counted(const T& amount) {
  using std::floor;
  return floor(amount + T(counting_slack));
}

/// What is under a root may come out as a negative of this size when it is an expanded square: it counts as 0. Next to
/// the cut of atan2, where it jumps by 2π, y may come out below 0 by this share of |x|: it counts as above.
inline constexpr double amount_noise = 1e-12;
/// atan2 where doubles may be on either side of its cut.
inline bool may_meet_cut(const Interval& y, const Interval& x) {
  return !(x.low > 0 || y.low > 0 || y.high < std::min(amount_noise * x.low, 0.0));
}

/// Flat double code for a stack machine: what an Amount is compiled to, so that evaluation never enters GiNaC.
class CompiledAmount {
 public:
  enum class Op : std::uint8_t {
    constant,
    parameter,
    add,
    subtract,
    multiply,
    divide,
    power,
    negate,
    sqrt,
    abs,
    floor,
    sin,
    cos,
    tan,
    atan2,
    min,
    max
  };
  struct Instruction {
    Op op;
    std::uint32_t parameter = 0;  ///< index into the parameter values
    double constant = 0;
  };

  /// `code` in postfix order: operands are pushed, operators take one or two from the stack and push one.
  explicit CompiledAmount(std::vector<Instruction> code);
  /// NaN where the expression is undefined. `parameters` in the order given to compile(). Allocates nothing, unless the
  /// code needs more than 256 values at a time, which no parsed amount does.
  double operator()(const double* parameters) const;
  const std::vector<Instruction>& code() const { return code_; }
  /// The largest number of values on the stack.
  std::size_t depth() const { return depth_; }
  /// The operation that first gives NaN at these parameters; nothing when the amount is defined there.
  std::optional<Op> undefined_operation(const double* parameters) const;

 private:
  std::vector<Instruction> code_;
  std::size_t depth_ = 0;
};

/// Number of operands: 0, 1 or 2.
int arity(CompiledAmount::Op op);

/// What one operation gives; NaN where it is undefined. `b` is not read when the arity is 1.
double apply_operation(CompiledAmount::Op op, double a, double b);

/// An amount's text and the code of its operations as they are written; parameters are numbered as in `names`.
struct WrittenAmount {
  std::string text;
  std::vector<std::string> names;  ///< that occur, sorted
  std::vector<CompiledAmount::Instruction> code;
};

/// An immutable closed-form expression.
class Amount {
 public:
  Amount();  ///< zero
  /// Made of real parameters, real numbers, + - * / ^, pi and the functions of the grammar; asin, acos and atan are
  /// taken as atan2. Doubles that are short decimals become exact. Other functions are a programmer's error.
  explicit Amount(const GiNaC::ex& expression);
  /// What was read from `written`, and is evaluated as it is written.
  Amount(const GiNaC::ex& expression, WrittenAmount written);
  /// Finite. Exact when it is a decimal of at most 12 digits or the double nearest to a fraction p/q, q ≤ 1,000.
  static Amount constant(double value);
  static Amount parameter(const std::string& name);

  const GiNaC::ex& expression() const { return expression_; }
  /// The text as it was read, or else text(), and its code.
  std::shared_ptr<const WrittenAmount> written() const;
  /// Names of the parameters that occur, sorted; as written, so that x1 - x1 has one.
  std::vector<std::string> parameters() const;
  bool is_zero() const;

  /// Text that parse_amount reads back to an equal expression; the same on every machine.
  std::string text() const;
  /// ∂/∂parameter where it exists; floor counts as constant. Nothing when the closed form leaves the grammar: the
  /// parameter stands in an exponent.
  std::optional<Amount> derivative(const std::string& parameter) const;
  /// Coefficients that are within `tolerance` of a simple rational, rational multiple of π or square root are put
  /// exactly on it, others are rounded to a tenth of it, and terms with a coefficient smaller than it are dropped:
  /// 0.4999871*x1 + 1.2e-7 → 0.5*x1. How simple a number must be depends on the tolerance, so that few numbers are near
  /// one by chance. `tolerance` > 0. Multiples of π only where `is_angle`: a length that is near one is so by chance.
  Amount simplified(double tolerance, bool is_angle) const;
  /// Code that reads parameter names[i] from parameters[i]. Every parameter that occurs must be in `names`.
  CompiledAmount compile(const std::vector<std::string>& names) const;

 private:
  GiNaC::ex expression_;
  std::shared_ptr<const WrittenAmount> written_;  ///< nothing when it is the outcome of a computation
};

/// The symbol of a parameter: one per name, process-wide, as GiNaC compares symbols by identity.
const GiNaC::symbol& parameter_symbol(const std::string& name);

/// Whether it matches the grammar's `parameter`.
bool is_parameter_name(std::string_view name);

/// Error place is "column N", 1-based: the first character of the token that is wrong, the function's name for a wrong
/// number of arguments, one past the end when something is missing.
Result<Amount> parse_amount(std::string_view text);

}  // namespace parsel
