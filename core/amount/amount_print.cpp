// Prints an expression in the grammar of amount.h, so that parsing the text gives an equal expression.
//
// Numbers: a rational is a decimal when it ends within 6 places or is shorter so, else a fraction; a double has its
// shortest text, which exact_decimal() refuses, so that it is read as a double again.
#include <algorithm>
#include <sstream>
#include <string>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"
#include "core/amount/number.h"
#include "core/base/result.h"

namespace parsel {

namespace {

using GiNaC::ex;
using GiNaC::ex_to;
using GiNaC::is_a;
using GiNaC::numeric;

/// How tightly a text binds: what may stand unbracketed as an operand of what.
enum Level { level_sum, level_product, level_power, level_primary };

struct Text {
  std::string text;
  Level level;
};

Text print(const ex& e);

std::string bracketed(const Text& text, Level needed) {
  return text.level >= needed ? text.text : "(" + text.text + ")";
}
std::string print_at(const ex& e, Level needed) {
  return bracketed(print(e), needed);
}

std::string integer_text(const numeric& value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

/// A non-negative rational as an exact decimal; empty when it does not end or has more than 12 digits.
std::string decimal_text(const numeric& value, int places_limit) {
  numeric scaled = value;
  int places = 0;
  while (!scaled.is_integer()) {
    if (++places > places_limit) return {};
    scaled = scaled * 10;
  }
  std::string digits = integer_text(scaled);
  if (places == 0) return digits;
  if (digits.size() > 12) return {};
  if (static_cast<int>(digits.size()) <= places) {
    digits.insert(0, static_cast<std::size_t>(places) + 1 - digits.size(), '0');
  }
  digits.insert(digits.size() - static_cast<std::size_t>(places), ".");
  return digits;
}

/// A non-negative number. A fraction p/q is a product.
Text print_magnitude(const numeric& value) {
  PARSEL_ASSERT(value.is_real(), "amounts are real");
  if (!value.is_rational()) return {shortest_decimal(value.to_double()), level_primary};
  const std::string decimal = decimal_text(value, 6);
  if (!decimal.empty()) return {decimal, level_primary};
  const std::string fraction = integer_text(value.numer()) + "/" + integer_text(value.denom());
  const std::string longer = decimal_text(value, 24);
  if (!longer.empty() && longer.size() < fraction.size()) return {longer, level_primary};
  return {fraction, level_product};
}

Text print_number(const numeric& value) {
  if (!value.is_negative()) return print_magnitude(value);
  return {"-" + print_magnitude(-value).text, level_product};
}

Text print_power(const ex& base, const ex& exponent) {
  if (exponent.is_equal(numeric(1, 2))) return {"sqrt(" + print(base).text + ")", level_primary};
  return {print_at(base, level_primary) + "^" + print_at(exponent, level_primary), level_power};
}

std::string joined(const std::vector<std::string>& factors) {
  std::string text;
  for (const std::string& factor : factors) text += (text.empty() ? "" : "*") + factor;
  return text;
}

/// p·A…/q/B…·S…, S the sums. GiNaC distributes a number over a sum that it meets alone, as in 2*(x + 1)*y read from the
/// left, which would not give back the same product: so the sums stand where no number meets them.
Text print_product(const ex& product) {
  numeric coefficient = 1;
  std::vector<std::string> above;
  std::vector<std::string> below;
  std::vector<std::string> sums;
  for (std::size_t i = 0; i < product.nops(); ++i) {
    const ex factor = product.op(i);
    if (is_a<numeric>(factor)) {
      coefficient = coefficient * ex_to<numeric>(factor);
    } else if (is_a<GiNaC::add>(factor)) {
      sums.push_back(print_at(factor, level_power));
    } else if (is_a<GiNaC::power>(factor) && is_a<numeric>(factor.op(1)) &&
               ex_to<numeric>(factor.op(1)).is_negative()) {
      const ex inverse = -factor.op(1);
      const Text text = inverse.is_equal(1) ? print(factor.op(0)) : print_power(factor.op(0), inverse);
      below.push_back(bracketed(text, level_power));
    } else {
      above.push_back(print_at(factor, level_power));
    }
  }
  std::sort(above.begin(), above.end());
  std::sort(below.begin(), below.end());
  std::sort(sums.begin(), sums.end());

  if (above.empty() && below.empty() && !coefficient.is_equal(1)) {
    above.push_back("(" + joined(sums) + ")");
    sums.clear();
  } else if (above.empty() && coefficient.is_equal(1)) {
    above.swap(sums);
  }
  const numeric magnitude = abs(coefficient);
  const Text number = print_magnitude(magnitude);
  const bool fraction = number.level == level_product;
  const std::string numerator = fraction ? integer_text(magnitude.numer()) : number.text;
  if (above.empty() || numerator != "1") above.insert(above.begin(), numerator);
  if (fraction) below.insert(below.begin(), integer_text(magnitude.denom()));
  std::string text = (coefficient.is_negative() ? "-" : "") + joined(above);
  for (const std::string& factor : below) text += "/" + factor;
  for (const std::string& factor : sums) text += "*" + factor;
  return {text, level_product};
}

/// Terms in the order of their text without sign, numbers last: 0.5*x1 - y + 2.
Text print_sum(const ex& sum) {
  struct Term {
    bool number;
    std::string text;
    bool negative;
  };
  std::vector<Term> terms;
  for (std::size_t i = 0; i < sum.nops(); ++i) {
    std::string text = print_at(sum.op(i), level_product);
    const bool negative = text[0] == '-';
    terms.push_back({is_a<numeric>(sum.op(i)), negative ? text.substr(1) : text, negative});
  }
  std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) {
    return std::tie(a.number, a.text, a.negative) < std::tie(b.number, b.text, b.negative);
  });
  std::string text;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    if (i > 0) {
      text += terms[i].negative ? " - " : " + ";
    } else if (terms[i].negative) {
      text += "-";
    }
    text += terms[i].text;
  }
  return {text, level_sum};
}

Text print_function(const ex& e) {
  const std::string_view name = function_name(e);
  PARSEL_ASSERT(!name.empty(), "amounts are made of the grammar's functions");
  std::vector<std::string> arguments;
  for (std::size_t i = 0; i < e.nops(); ++i) arguments.push_back(print(e.op(i)).text);
  if (name == "atan") return {"atan2(" + arguments[0] + ", 1)", level_primary};
  if (name == "min" || name == "max") std::sort(arguments.begin(), arguments.end());
  std::string text = std::string(name) + "(" + arguments[0];
  for (std::size_t i = 1; i < arguments.size(); ++i) text += ", " + arguments[i];
  return {text + ")", level_primary};
}

Text print(const ex& e) {
  if (is_a<numeric>(e)) return print_number(ex_to<numeric>(e));
  if (is_a<GiNaC::symbol>(e)) return {ex_to<GiNaC::symbol>(e).get_name(), level_primary};
  if (e.is_equal(GiNaC::Pi)) return {"pi", level_primary};
  if (is_a<GiNaC::add>(e)) return print_sum(e);
  if (is_a<GiNaC::mul>(e)) return print_product(e);
  if (is_a<GiNaC::power>(e)) {
    // A lone x^-2 is 1/x^2 as well.
    const bool inverse = is_a<numeric>(e.op(1)) && ex_to<numeric>(e.op(1)).is_negative();
    if (!inverse) return print_power(e.op(0), e.op(1));
    const ex exponent = -e.op(1);
    const Text below = exponent.is_equal(1) ? print(e.op(0)) : print_power(e.op(0), exponent);
    return {"1/" + bracketed(below, level_power), level_product};
  }
  return print_function(e);
}

}  // namespace

std::string amount_text(const ex& e) {
  return print(e).text;
}

std::string Amount::text() const {
  return amount_text(expression_);
}

}  // namespace parsel
