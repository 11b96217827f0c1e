// Flat postfix code of an expression, and its evaluation in doubles.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"
#include "core/base/result.h"

namespace parsel {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;
using Op = CompiledAmount::Op;
using Code = std::vector<CompiledAmount::Instruction>;

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t stack_size = 256;

double without_root_noise(double value) {
  return value < 0 && value >= -amount_noise ? 0 : value;
}

double turn_of(double y, double x) {
  x += 0.0;  // -0 is 0
  if (x < 0 && y <= 0 && y >= amount_noise * x) y = 0;
  return std::atan2(y, x);
}

double power_of(double base, double exponent) {
  // C gives pow(1, NaN) = pow(NaN, 0) = 1; for us NaN goes through everything.
  if (std::isnan(base) || std::isnan(exponent)) return undefined;
  if (exponent != std::floor(exponent)) base = without_root_noise(base);
  if (base == 0 && exponent < 0) return undefined;
  return std::pow(base, exponent);
}

class Compiler {
 public:
  explicit Compiler(const std::vector<std::string>& names) : names_(names) {}

  Code compile(const ex& e) {
    emit(e);
    return std::move(code_);
  }

 private:
  void push(Op op) { code_.push_back({op}); }
  void push_constant(double value) { code_.push_back({Op::constant, 0, value}); }

  static bool is_constant(const ex& e) {
    if (is_a<GiNaC::symbol>(e)) return false;
    for (std::size_t i = 0; i < e.nops(); ++i) {
      if (!is_constant(e.op(i))) return false;
    }
    return true;
  }

  void emit(const ex& e) {
    if (is_a<numeric>(e)) {
      push_constant(ex_to<numeric>(e).is_real() ? ex_to<numeric>(e).to_double() : undefined);
    } else if (e.is_equal(GiNaC::Pi)) {
      push_constant(std::numbers::pi);
    } else if (is_a<GiNaC::symbol>(e)) {
      const auto found = std::find(names_.begin(), names_.end(), ex_to<GiNaC::symbol>(e).get_name());
      PARSEL_ASSERT(found != names_.end(), "every parameter that occurs must be among the names");
      code_.push_back({Op::parameter, static_cast<std::uint32_t>(found - names_.begin())});
    } else {
      const std::size_t start = code_.size();
      if (is_a<GiNaC::add>(e)) {
        emit_sum(e);
      } else if (is_a<GiNaC::mul>(e)) {
        emit_product(e);
      } else if (is_a<GiNaC::power>(e)) {
        emit_power(e);
      } else {
        emit_function(e);
      }
      if (is_constant(e)) fold(start);
    }
  }

  /// Replaces the code from `start` on, which reads no parameter, by its value.
  void fold(std::size_t start) {
    const CompiledAmount part(Code(code_.begin() + static_cast<std::ptrdiff_t>(start), code_.end()));
    code_.resize(start);
    push_constant(part(nullptr));
  }

  void emit_sum(const ex& sum) {
    bool first = true;
    for (const ex& term : ordered_operands(sum)) {
      const bool negative = !first && is_a<GiNaC::mul>(term) && has_negative_coefficient(term);
      emit(negative ? ex(-term) : term);
      if (!first) push(negative ? Op::subtract : Op::add);
      first = false;
    }
  }

  static bool has_negative_coefficient(const ex& product) {
    const ex last = product.op(product.nops() - 1);
    return is_a<numeric>(last) && ex_to<numeric>(last).is_negative();
  }

  /// Constant factors are multiplied beforehand; negative powers become divisions.
  void emit_product(const ex& product) {
    ex constant = 1;
    std::vector<ex> above;
    std::vector<ex> below;
    for (const ex& factor : ordered_operands(product)) {
      if (is_constant(factor)) {
        constant = constant * factor;
      } else if (is_inverse(factor)) {
        below.push_back(1 / factor);
      } else {
        above.push_back(factor);
      }
    }
    const bool negate = constant.is_equal(-1) && !above.empty();
    const bool scaled = above.empty() || !(constant.is_equal(1) || negate);
    if (scaled) {
      const std::size_t start = code_.size();
      emit_constant_product(constant);
      fold(start);
    }
    for (std::size_t i = 0; i < above.size(); ++i) {
      emit(above[i]);
      if (i > 0 || scaled) push(Op::multiply);
    }
    for (const ex& factor : below) {
      emit(factor);
      push(Op::divide);
    }
    if (negate) push(Op::negate);
  }

  void emit_constant_product(const ex& constant) {
    if (!is_a<GiNaC::mul>(constant)) return emit(constant);
    for (std::size_t i = 0; i < constant.nops(); ++i) {
      emit(constant.op(i));
      if (i > 0) push(Op::multiply);
    }
  }

  static bool is_inverse(const ex& e) {
    return is_a<GiNaC::power>(e) && is_a<numeric>(e.op(1)) && ex_to<numeric>(e.op(1)).is_negative();
  }

  void emit_power(const ex& e) {
    if (is_inverse(e)) {
      push_constant(1);
      emit(1 / e);
      return push(Op::divide);
    }
    emit(e.op(0));
    if (e.op(1).is_equal(numeric(1, 2))) return push(Op::sqrt);
    emit(e.op(1));
    push(Op::power);
  }

  void emit_function(const ex& e) {
    static constexpr std::array<std::pair<std::string_view, Op>, 8> ops = {{{"abs", Op::abs},
                                                                            {"floor", Op::floor},
                                                                            {"sin", Op::sin},
                                                                            {"cos", Op::cos},
                                                                            {"tan", Op::tan},
                                                                            {"atan2", Op::atan2},
                                                                            {"min", Op::min},
                                                                            {"max", Op::max}}};
    for (std::size_t i = 0; i < e.nops(); ++i) emit(e.op(i));
    const std::string_view name = function_name(e);
    if (name == "atan") {
      push_constant(1);
      return push(Op::atan2);
    }
    for (const auto& [text, op] : ops) {
      if (text == name) return push(op);
    }
    PARSEL_ASSERT(false, "amounts are made of the grammar's functions");
  }

  const std::vector<std::string>& names_;
  Code code_;
};

/// Runs `code`; `seen(op, result)` is called after each operation and ends the run by returning false.
template <class Seen>
double run(const Code& code, const double* parameters, double* stack, Seen seen) {
  double* top = stack;  // one past the last value
  for (const CompiledAmount::Instruction& instruction : code) {
    if (instruction.op == Op::constant) {
      *top++ = instruction.constant;
    } else if (instruction.op == Op::parameter) {
      *top++ = parameters[instruction.parameter];
    } else if (arity(instruction.op) == 1) {
      top[-1] = apply_operation(instruction.op, top[-1], 0);
    } else {
      --top;
      top[-1] = apply_operation(instruction.op, top[-1], top[0]);
    }
    if (!seen(instruction.op, top[-1])) break;
  }
  return top[-1];
}

template <class Seen>
double run(const Code& code, std::size_t depth, const double* parameters, Seen seen) {
  if (depth <= stack_size) {
    std::array<double, stack_size> stack;  // left uninitialised: every value is pushed before it is read
    return run(code, parameters, stack.data(), seen);
  }
  std::vector<double> stack(depth);
  return run(code, parameters, stack.data(), seen);
}

}  // namespace

int arity(Op op) {
  switch (op) {
    case Op::constant:
    case Op::parameter:
      return 0;
    case Op::negate:
    case Op::sqrt:
    case Op::abs:
    case Op::floor:
    case Op::sin:
    case Op::cos:
    case Op::tan:
      return 1;
    case Op::add:
    case Op::subtract:
    case Op::multiply:
    case Op::divide:
    case Op::power:
    case Op::atan2:
    case Op::min:
    case Op::max:
      return 2;
  }
  return 0;
}

double apply_operation(Op op, double a, double b) {
  double result = undefined;
  switch (op) {
    case Op::constant:
    case Op::parameter:
      PARSEL_ASSERT(false, "constants and parameters are no operations");
      break;
    case Op::add:
      result = a + b;
      break;
    case Op::subtract:
      result = a - b;
      break;
    case Op::multiply:
      result = a * b;
      break;
    case Op::divide:
      result = b == 0 ? undefined : a / b;
      break;
    case Op::power:
      result = power_of(a, b);
      break;
    case Op::negate:
      result = -a;
      break;
    case Op::sqrt:
      result = std::sqrt(without_root_noise(a));
      break;
    case Op::abs:
      result = std::abs(a);
      break;
    case Op::floor:
      result = counted(a);
      break;
    case Op::sin:
      result = std::sin(a);
      break;
    case Op::cos:
      result = std::cos(a);
      break;
    case Op::tan:
      result = std::tan(a);
      break;
    case Op::atan2:
      result = turn_of(a, b);
      break;
    case Op::min:
      result = std::isnan(a) || a < b ? a : b;
      break;
    case Op::max:
      result = std::isnan(a) || a > b ? a : b;
      break;
  }
  return std::isfinite(result) ? result : undefined;
}

CompiledAmount::CompiledAmount(std::vector<Instruction> code) : code_(std::move(code)) {
  std::size_t size = 0;
  for (const Instruction& instruction : code_) {
    const auto taken = static_cast<std::size_t>(arity(instruction.op));
    PARSEL_ASSERT(size >= taken, "an operator needs its operands on the stack");
    size += 1 - taken;
    depth_ = std::max(depth_, size);
  }
  PARSEL_ASSERT(size == 1, "code leaves one value");
}

double CompiledAmount::operator()(const double* parameters) const {
  return run(code_, depth_, parameters, [](Op, double) { return true; });
}

std::optional<Op> CompiledAmount::undefined_operation(const double* parameters) const {
  std::optional<Op> first;
  run(code_, depth_, parameters, [&first](Op op, double value) {
    if (std::isfinite(value)) return true;
    first = op;
    return false;
  });
  return first;
}

CompiledAmount Amount::compile(const std::vector<std::string>& names) const {
  if (!written_) return CompiledAmount(Compiler(names).compile(expression_));
  std::vector<std::uint32_t> places;
  for (const std::string& name : written_->names) {
    const auto found = std::find(names.begin(), names.end(), name);
    PARSEL_ASSERT(found != names.end(), "every parameter that occurs must be among the names");
    places.push_back(static_cast<std::uint32_t>(found - names.begin()));
  }
  Code code = written_->code;
  for (CompiledAmount::Instruction& instruction : code) {
    if (instruction.op == Op::parameter) instruction.parameter = places[instruction.parameter];
  }
  return CompiledAmount(std::move(code));
}

}  // namespace parsel
