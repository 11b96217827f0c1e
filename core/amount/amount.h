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
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace parsel {

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

/// An immutable closed-form expression.
class Amount {
 public:
  Amount();  ///< zero
  /// Made of real parameters, real numbers, + - * / ^, pi and the functions of the grammar; asin, acos and atan are
  /// taken as atan2. Doubles that are short decimals become exact. Other functions are a programmer's error.
  explicit Amount(const GiNaC::ex& expression);
  /// Finite. Exact when it is a decimal of at most 12 digits or the double nearest to a fraction p/q, q ≤ 1,000.
  static Amount constant(double value);
  static Amount parameter(const std::string& name);

  const GiNaC::ex& expression() const { return expression_; }
  /// Names of the parameters that occur, sorted.
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
};

/// The symbol of a parameter: one per name, process-wide, as GiNaC compares symbols by identity.
const GiNaC::symbol& parameter_symbol(const std::string& name);

/// Whether it matches the grammar's `parameter`.
bool is_parameter_name(std::string_view name);

/// Error place is "column N", 1-based: the first character of the token that is wrong, the function's name for a wrong
/// number of arguments, one past the end when something is missing.
Result<Amount> parse_amount(std::string_view text);

}  // namespace parsel
