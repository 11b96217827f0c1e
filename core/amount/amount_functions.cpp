#include "core/amount/amount_functions.h"

#include <cln/cln.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "core/amount/number.h"

namespace parsel {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

bool is_number(const ex& e) {
  return is_a<numeric>(e);
}

ex real_floor_eval(const ex& a) {
  if (!is_number(a)) return real_floor(a).hold();
  static const numeric slack = numeric(1, 1'000'000'000);  // counting_slack, exact
  return numeric(cln::floor1(cln::the<cln::cl_R>((ex_to<numeric>(a) + slack).to_cl_N())));
}
ex real_floor_evalf(const ex& a) {
  return real_floor_eval(a);
}
ex real_floor_derivative(const ex&, unsigned) {
  return 0;
}

ex real_min_eval(const ex& a, const ex& b) {
  if (is_number(a) && is_number(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? a : b;
  if (a.is_equal(b)) return a;
  return real_min(a, b).hold();
}
/// min(a, b) = (a + b - |a - b|)/2 and max(a, b) = (a + b + |a - b|)/2, so that derivatives stay in the grammar.
ex selection_derivative(const ex& a, const ex& b, unsigned parameter, int sign) {
  const ex slope = sign * (a - b) / abs(a - b);
  return (1 + (parameter == 0 ? slope : ex(-slope))) / 2;
}
ex real_min_derivative(const ex& a, const ex& b, unsigned parameter) {
  return selection_derivative(a, b, parameter, -1);
}

ex real_max_eval(const ex& a, const ex& b) {
  if (is_number(a) && is_number(b)) return ex_to<numeric>(a) < ex_to<numeric>(b) ? b : a;
  if (a.is_equal(b)) return a;
  return real_max(a, b).hold();
}
ex real_max_derivative(const ex& a, const ex& b, unsigned parameter) {
  return selection_derivative(a, b, parameter, 1);
}

// All our parameters are real, and so are these functions of them.
ex real_floor_conjugate(const ex& a) {
  return real_floor(a).hold();
}
ex real_min_conjugate(const ex& a, const ex& b) {
  return real_min(a, b).hold();
}
ex real_max_conjugate(const ex& a, const ex& b) {
  return real_max(a, b).hold();
}
bool unary_info(const ex&, unsigned flag) {
  return flag == GiNaC::info_flags::real;
}
bool binary_info(const ex&, const ex&, unsigned flag) {
  return flag == GiNaC::info_flags::real;
}

/// People write fewer; a double that comes out of a computation has fewer once in ten thousand.
constexpr std::size_t exact_digits = 12;

constexpr std::array<std::pair<std::string_view, std::string_view>, 9> names = {{{"abs", "abs"},
                                                                                 {"real_floor", "floor"},
                                                                                 {"sin", "sin"},
                                                                                 {"cos", "cos"},
                                                                                 {"tan", "tan"},
                                                                                 {"atan", "atan"},
                                                                                 {"atan2", "atan2"},
                                                                                 {"real_min", "min"},
                                                                                 {"real_max", "max"}}};

/// The rational of a number whose shortest text is an exact decimal, else the double.
ex canonical_number(const numeric& value) {
  if (!value.is_real() || value.is_rational()) return value;
  const double rounded = value.to_double();
  if (!std::isfinite(rounded)) return value;
  const auto exact = exact_decimal(shortest_decimal(rounded));
  return exact ? *exact : inexact(rounded);
}

struct Canonical : GiNaC::map_function {
  ex operator()(const ex& e) override {
    if (is_number(e)) return canonical_number(ex_to<numeric>(e));
    if (is_a<GiNaC::function>(e)) {
      const std::string name = ex_to<GiNaC::function>(e).get_name();
      if (name == "conjugate") return (*this)(e.op(0));
      if (name == "asin" || name == "acos") {
        const ex x = (*this)(e.op(0));
        const ex other = sqrt(1 - pow(x, 2));
        return name == "asin" ? atan2(x, other) : atan2(other, x);
      }
    }
    return e.nops() == 0 ? e : e.map(*this);
  }
};

}  // namespace

// A symmetric function sorts its arguments, so that min(a, b) equals min(b, a).
REGISTER_FUNCTION(real_floor, eval_func(real_floor_eval)
                                  .evalf_func(real_floor_evalf)
                                  .derivative_func(real_floor_derivative)
                                  .conjugate_func(real_floor_conjugate)
                                  .info_func(unary_info))
REGISTER_FUNCTION(real_min, eval_func(real_min_eval)
                                .evalf_func(real_min_eval)
                                .derivative_func(real_min_derivative)
                                .conjugate_func(real_min_conjugate)
                                .info_func(binary_info)
                                .set_symmetry(GiNaC::sy_symm(0, 1)))
REGISTER_FUNCTION(real_max, eval_func(real_max_eval)
                                .evalf_func(real_max_eval)
                                .derivative_func(real_max_derivative)
                                .conjugate_func(real_max_conjugate)
                                .info_func(binary_info)
                                .set_symmetry(GiNaC::sy_symm(0, 1)))

std::string_view function_name(const ex& e) {
  if (!is_a<GiNaC::function>(e)) return {};
  const std::string own = ex_to<GiNaC::function>(e).get_name();
  for (const auto& [ginac, ours] : names) {
    if (own == ginac) return ours;
  }
  return {};
}

std::optional<numeric> exact_decimal(std::string_view text) {
  const bool negative = !text.empty() && text[0] == '-';
  if (negative) text.remove_prefix(1);
  std::string digits;
  int exponent = 0;
  bool after_point = false;
  std::size_t i = 0;
  for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
    if (text[i] == '.') {
      after_point = true;
      continue;
    }
    if (!digits.empty() || text[i] != '0') digits += text[i];
    if (after_point) --exponent;
    if (digits.size() > 400) return std::nullopt;
  }
  const bool integer = i == text.size() && !after_point;
  if (i < text.size()) exponent += std::stoi(std::string(text.substr(i + 1)));
  if (!integer) {
    while (!digits.empty() && digits.back() == '0') {
      digits.pop_back();
      ++exponent;
    }
    const int magnitude =
        static_cast<int>(digits.size()) + exponent;  // the value is in [10^(magnitude-1), 10^magnitude)
    if (!digits.empty() && (digits.size() > exact_digits || magnitude <= -25 || magnitude > 25)) return std::nullopt;
  }
  if (digits.empty()) return numeric(0);
  numeric value = numeric(digits.c_str());
  if (exponent != 0) value = value * numeric(10).power(exponent);
  return negative ? -value : value;
}

numeric inexact(double value) {
  return std::abs(value) < std::numeric_limits<double>::min() ? numeric(0) : numeric(value);
}

bool fits_double(const ex& e) {
  if (is_number(e) && !std::isfinite(ex_to<numeric>(e).to_double())) return false;
  for (std::size_t i = 0; i < e.nops(); ++i) {
    if (!fits_double(e.op(i))) return false;
  }
  return true;
}

ex canonical(const ex& e) {
  // Exact numbers may make GiNaC rewrite what holds them, (0.5*x + 0.25)^2 for one, and so give rise to new doubles.
  constexpr int passes = 8;
  Canonical map;
  ex result = map(e);
  for (int pass = 1; pass < passes; ++pass) {
    const ex next = map(result);
    if (next.is_equal(result)) break;
    result = next;
  }
  return result;
}

std::vector<ex> ordered_operands(const ex& e) {
  std::vector<std::pair<std::string, ex>> keyed;
  for (std::size_t i = 0; i < e.nops(); ++i) keyed.emplace_back(amount_text(e.op(i)), e.op(i));
  std::stable_sort(keyed.begin(), keyed.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<ex> operands;
  for (auto& [text, operand] : keyed) operands.push_back(operand);
  return operands;
}

}  // namespace parsel
