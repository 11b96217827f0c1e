// Recursive descent over the grammar of amount.h, building GiNaC expressions. Hostile text is harmless: length and
// depth are limited, and numbers are refused before they grow beyond `bits_limit` (9^9^9 would else be computed
// exactly). What GiNaC would throw about is refused beforehand as far as it is known, since GiNaC leaks the node it
// throws from.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"

namespace parsel {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

constexpr std::size_t length_limit = 4096;
constexpr int depth_limit = 64;
constexpr double bits_limit = 65536;

struct Function {
  std::string_view name;
  CompiledAmount::Op op;
  std::size_t least, most;  ///< numbers of arguments
};
constexpr std::array<Function, 9> functions = {{{"sqrt", CompiledAmount::Op::sqrt, 1, 1},
                                                {"abs", CompiledAmount::Op::abs, 1, 1},
                                                {"floor", CompiledAmount::Op::floor, 1, 1},
                                                {"sin", CompiledAmount::Op::sin, 1, 1},
                                                {"cos", CompiledAmount::Op::cos, 1, 1},
                                                {"tan", CompiledAmount::Op::tan, 1, 1},
                                                {"atan2", CompiledAmount::Op::atan2, 2, 2},
                                                {"min", CompiledAmount::Op::min, 2, length_limit},
                                                {"max", CompiledAmount::Op::max, 2, length_limit}}};

const Function* find_function(std::string_view name) {
  for (const Function& function : functions) {
    if (function.name == name) return &function;
  }
  return nullptr;
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}
bool continues_name(char c) {
  return is_letter(c) || is_digit(c) || c == '_';
}

/// A value and an upper bound of the bits that the numbers in it take before the point or, exact ones, in all; 1 takes
/// none, a power multiplies, sums and products add.
struct Term {
  ex value;
  double bits = 0;
};

double bits_of(const numeric& value) {
  if (value.is_zero()) return 0;
  if (!value.is_rational()) return std::abs(std::log2(std::abs(value.to_double())));
  return value.numer().int_length() + value.denom().int_length() - 2;
}

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Result<Amount> run() {
    if (text_.size() > length_limit) {
      return fault(length_limit, "the amount is longer than 4,096 characters", "shorten it");
    }
    try {
      const Term term = sum();
      if (!failure_) expect_end();
      if (!failure_ && !fits_double(term.value)) no_value(operation_);
      if (failure_) return *failure_;
      return Amount(term.value, written());
    } catch (const std::exception&) {
      no_value(operation_);
      return *failure_;
    }
  }

 private:
  using Op = CompiledAmount::Op;

  /// Appends an operation to the code; one on constants is done at once. What GiNaC makes of the expression has other
  /// roundings.
  void emit(Op op) {
    if (failure_) return;
    const auto operands = static_cast<std::size_t>(arity(op));
    const auto is_constant = [](const CompiledAmount::Instruction& i) { return i.op == Op::constant; };
    if (code_.size() < operands ||
        !std::all_of(code_.end() - static_cast<std::ptrdiff_t>(operands), code_.end(), is_constant)) {
      code_.push_back({op});
      return;
    }
    const double last = code_.back().constant;
    if (operands == 2) code_.pop_back();
    double& value = code_.back().constant;
    value = operands == 2 ? apply_operation(op, value, last) : apply_operation(op, last, 0);
  }

  void emit_parameter(const std::string& name) {
    const auto found = std::find(names_.begin(), names_.end(), name);
    code_.push_back({Op::parameter, static_cast<std::uint32_t>(found - names_.begin())});
    if (found == names_.end()) names_.push_back(name);
  }

  /// With the parameters numbered in the order of their names.
  WrittenAmount written() {
    WrittenAmount result{std::string(text_), names_, std::move(code_)};
    std::sort(result.names.begin(), result.names.end());
    for (CompiledAmount::Instruction& i : result.code) {
      if (i.op != Op::parameter) continue;
      const auto place = std::find(result.names.begin(), result.names.end(), names_[i.parameter]);
      i.parameter = static_cast<std::uint32_t>(place - result.names.begin());
    }
    return result;
  }

  static Error fault(std::size_t at, std::string cause, std::string fix) {
    return {"edit/amount", "column " + std::to_string(at + 1), std::move(cause), std::move(fix)};
  }
  /// Notes the first failure; from then on every function returns at once.
  Term fail(std::size_t at, std::string cause, std::string fix) {
    if (!failure_) failure_ = fault(at, std::move(cause), std::move(fix));
    return {};
  }

  Term no_value(std::size_t at) {
    return fail(at, "this has no finite value", "check for division by zero and numbers out of range");
  }

  void skip_blanks() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\r' || text_[at_] == '\n')) {
      ++at_;
    }
  }
  /// The next character after blanks, 0 at the end.
  char peek() {
    skip_blanks();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (failure_ || peek() != c || at_ == text_.size()) return false;
    operation_ = at_++;
    return true;
  }
  /// The token at the reading position, for messages.
  std::string here() {
    if (peek() == '\0' && at_ == text_.size()) return "the end";
    if (static_cast<unsigned char>(text_[at_]) >= 0x80 || static_cast<unsigned char>(text_[at_]) < 0x20) {
      return "a character that is not ASCII";
    }
    std::size_t end = at_ + 1;
    if (continues_name(text_[at_])) {
      while (end < text_.size() && end < at_ + 20 && continues_name(text_[end])) ++end;
    }
    return "'" + std::string(text_.substr(at_, end - at_)) + "'";
  }
  void expect_end() {
    if (peek() == '\0' && at_ == text_.size()) return;
    fail(at_, "there should be an operator or the end, not " + here(), "write * between factors, as in 2*x1");
  }

  bool enter() {
    if (++depth_ <= depth_limit) return true;
    fail(operation_, "the amount is nested deeper than 64 levels", "simplify it");
    return false;
  }

  Term bounded(Term term, std::size_t at) {
    if (term.bits > bits_limit) return fail(at, "the numbers in this amount become too large", "use decimals");
    if (is_a<numeric>(term.value) && !ex_to<numeric>(term.value).is_real()) {
      return fail(at, "this is not a real number", "check for roots of negative numbers");
    }
    return term;
  }

  Term sum() {
    Term left = product();
    while (!failure_) {
      const bool plus = take('+');
      if (!plus && !take('-')) break;
      const std::size_t at = operation_;
      const Term right = product();
      if (failure_) break;
      operation_ = at;
      emit(plus ? Op::add : Op::subtract);
      left = bounded({plus ? left.value + right.value : left.value - right.value, left.bits + right.bits + 1}, at);
    }
    return left;
  }

  Term product() {
    Term left = unary();
    while (!failure_) {
      const bool times = take('*');
      if (!times && !take('/')) break;
      const std::size_t at = operation_;
      const Term right = unary();
      if (failure_) break;
      operation_ = at;
      emit(times ? Op::multiply : Op::divide);
      if (left.bits + right.bits > bits_limit) return bounded({0, left.bits + right.bits}, at);
      if (!times && right.value.is_zero()) return no_value(at);
      left = bounded({times ? left.value * right.value : left.value / right.value, left.bits + right.bits}, at);
    }
    return left;
  }

  Term unary() {
    const bool minus = take('-');
    if (!minus && !take('+')) return power();
    if (!enter()) return {};
    Term operand = unary();
    --depth_;
    if (minus) emit(Op::negate);
    return minus ? Term{-operand.value, operand.bits} : operand;
  }

  Term power() {
    const Term base = primary();
    if (!take('^')) return base;
    const std::size_t at = operation_;
    if (!enter()) return {};
    const Term exponent = unary();
    --depth_;
    if (failure_) return {};
    operation_ = at;
    emit(Op::power);
    return raised(base, exponent.value, at);
  }

  Term raised(const Term& base, const ex& exponent, std::size_t at) {
    double bits = base.bits;
    if (is_a<numeric>(exponent)) {
      const numeric n = ex_to<numeric>(exponent);
      if (bits > 0) bits *= std::max(1.0, std::abs(n.to_double()));
      if (base.value.is_zero() && !n.is_positive()) return no_value(at);
      if (is_a<numeric>(base.value) && ex_to<numeric>(base.value).is_negative() && !n.is_integer()) {
        return fail(at, "a root or fractional power of a negative number is not real", "take it of a positive number");
      }
    }
    if (bits > bits_limit) return bounded({0, bits}, at);
    return bounded({pow(base.value, exponent), bits}, at);
  }

  Term primary() {
    if (failure_) return {};
    const char c = peek();
    if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]))) return number();
    if (is_letter(c)) return name();
    if (!take('(')) {
      return fail(at_, "there should be a number, a parameter, a function or '(', not " + here(),
                  "complete the expression; names are lower-case");
    }
    if (!enter()) return {};
    Term inside = sum();
    if (!failure_ && !take(')')) return fail(at_, "there should be ')', not " + here(), "close the parenthesis");
    --depth_;
    return inside;
  }

  Term number() {
    const std::size_t start = at_;
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    if (at_ < text_.size() && text_[at_] == '.') ++at_;
    while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
    int exponent = 0;
    std::size_t end = at_;
    if (end < text_.size() && (text_[end] == 'e' || text_[end] == 'E')) {
      ++end;
      if (end < text_.size() && (text_[end] == '+' || text_[end] == '-')) ++end;
      const std::size_t digits = end;
      while (end < text_.size() && is_digit(text_[end])) {
        exponent = std::min(exponent * 10 + (text_[end++] - '0'), 10000);
      }
      if (end > digits) at_ = end;
    }
    const std::string token(text_.substr(start, at_ - start));
    const double value = std::strtod(token.c_str(), nullptr);
    if (exponent > 308 || !std::isfinite(value)) {
      return fail(start, "the number is out of range", "numbers go up to 1.7e308 with exponents from -308 to 308");
    }
    code_.push_back({Op::constant, 0, value});
    if (const auto exact = exact_decimal(token)) return {*exact, bits_of(*exact)};
    return {inexact(value), bits_of(inexact(value))};
  }

  Term name() {
    const std::size_t start = at_;
    while (at_ < text_.size() && continues_name(text_[at_])) ++at_;
    const std::string word(text_.substr(start, at_ - start));
    if (word == "pi") {
      code_.push_back({Op::constant, 0, std::numbers::pi});
      return {GiNaC::Pi, 0};
    }
    const Function* function = find_function(word);
    const bool called = peek() == '(';
    if (function != nullptr) {
      if (called) return call(*function, start);
      return fail(start, "the function " + word + " needs its argument in parentheses", "write " + word + "(…)");
    }
    if (called) {
      return fail(start, "there is no function " + word.substr(0, 40),
                  "the functions are sqrt, abs, floor, sin, cos, tan, atan2, min and max");
    }
    emit_parameter(word);
    return {parameter_symbol(word), 0};
  }

  Term call(const Function& function, std::size_t start) {
    take('(');
    if (!enter()) return {};
    std::vector<Term> arguments;
    do {
      arguments.push_back(sum());
      if (failure_) return {};
      // min(a, b, c) is min(min(a, b), c).
      if (arguments.size() > 1) emit(function.op);
    } while (take(','));
    if (!take(')')) return fail(at_, "there should be ',' or ')', not " + here(), "close the parenthesis");
    --depth_;
    if (arguments.size() < function.least || arguments.size() > function.most) {
      return fail(start,
                  std::string(function.name) + " does not take " + std::to_string(arguments.size()) + " argument" +
                      (arguments.size() == 1 ? "" : "s"),
                  "give it " + std::to_string(function.least) + (function.most > function.least ? " or more" : ""));
    }
    operation_ = start;
    if (arguments.size() == 1) emit(function.op);
    if (function.name == "sqrt") return raised(arguments[0], numeric(1, 2), start);
    double bits = 0;
    for (const Term& argument : arguments) bits += argument.bits;
    return bounded({applied(function.name, arguments), bits}, start);
  }

  static ex applied(std::string_view name, const std::vector<Term>& arguments) {
    const ex& a = arguments[0].value;
    if (name == "abs") return abs(a);
    if (name == "floor") return real_floor(a);
    if (name == "sin") return sin(a);
    if (name == "cos") return cos(a);
    if (name == "tan") return tan(a);
    if (name == "atan2") return atan2(a, arguments[1].value);
    ex folded = a;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
      const ex& b = arguments[i].value;
      folded = name == "min" ? ex(real_min(folded, b)) : ex(real_max(folded, b));
    }
    return folded;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t operation_ = 0;  ///< where the operator or function stands that is being applied
  int depth_ = 0;
  std::optional<Error> failure_;
  std::vector<CompiledAmount::Instruction> code_;  ///< of what has been read, in postfix order: that of reading
  std::vector<std::string> names_;                 ///< of the parameters, in the order of reading
};

}  // namespace

bool is_parameter_name(std::string_view name) {
  if (name.empty() || !is_letter(name[0]) || name == "pi" || find_function(name) != nullptr) return false;
  for (const char c : name) {
    if (!continues_name(c)) return false;
  }
  return true;
}

Result<Amount> parse_amount(std::string_view text) {
  return Parser(text).run();
}

}  // namespace parsel
