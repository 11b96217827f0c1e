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
// Numbers. A decimal of at most 15 significant digits between 1e-25 and 1e25 is the exact rational that it reads as, so
// that 0.5 is 1/2; an integer without point or exponent is always exact; what else is a double.
//
// Undefined is NaN, never infinity: division by zero, 0 to a negative power, the square root of a negative (down to
// -1e-12, the noise of an expanded square, it is 0), a fractional power of a negative, anything too large for a double.
// NaN goes through every operation. GiNaC simplifies on construction, so that removable singularities vanish: x/x is 1.
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <map>
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

  explicit CompiledAmount(std::vector<Instruction> code) : code_(std::move(code)) {}
  /// NaN where the expression is undefined. `parameters` in the order given to compile().
  double operator()(const double* parameters) const;
  const std::vector<Instruction>& code() const { return code_; }

 private:
  std::vector<Instruction> code_;
};

/// An immutable closed-form expression.
class Amount {
 public:
  Amount();  ///< zero
  explicit Amount(GiNaC::ex expression);
  static Amount constant(double value);  ///< exact when the double is a short decimal or a simple fraction
  static Amount parameter(const std::string& name);

  const GiNaC::ex& expression() const { return expression_; }
  /// Names of the parameters that occur, sorted.
  std::vector<std::string> parameters() const;
  bool is_zero() const;

  /// Text that parse_amount reads back to an equal expression.
  std::string text() const;
  /// ∂/∂parameter.
  Amount derivative(const std::string& parameter) const;
  /// Coefficients that are within `tolerance` of a simple rational (or a rational multiple of π) are put exactly on it,
  /// terms smaller than it are dropped: 0.4999871*x1 + 1.2e-7 → x1/2.
  Amount simplified(double tolerance) const;
  /// Code that reads parameter names[i] from parameters[i]. Every parameter that occurs must be in `names`.
  CompiledAmount compile(const std::vector<std::string>& names) const;

 private:
  GiNaC::ex expression_;
};

/// The symbol of a parameter: one per name, process-wide, as GiNaC compares symbols by identity.
const GiNaC::symbol& parameter_symbol(const std::string& name);

/// Error place is "column N" (1-based).
Result<Amount> parse_amount(std::string_view text);

}  // namespace parsel
