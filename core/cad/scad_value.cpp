#include "core/cad/scad_value.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/text.h"
#include "core/base/tolerance.h"
#include "core/cad/scad_token.h"

namespace parsel::cad {

bool Value::is_true() const {
  if (boolean()) return *boolean();
  if (number()) return number()->value != 0;
  if (string()) return !string()->empty();
  if (vector()) return !vector()->empty();
  return !is_undefined();
}

std::string_view Value::type() const {
  constexpr std::string_view names[] = {"undef", "a boolean", "a number", "a string", "a range", "a vector"};
  return names[state_.index()];
}

std::string to_string(const Value& value, std::size_t limit, int depth) {
  if (const bool* held = value.boolean()) return *held ? "true" : "false";
  if (const Number* held = value.number()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", held->value);
    return text;
  }
  if (const std::string* held = value.string()) return depth == 0 ? *held : '"' + *held + '"';
  if (const Range* held = value.range()) {
    return "[" + to_string(Value(held->begin)) + " : " + to_string(Value(held->step)) + " : " +
           to_string(Value(held->end)) + "]";
  }
  if (value.vector() == nullptr) return "undef";
  std::string text = "[";
  for (const Value& element : *value.vector()) {
    if (text.size() > limit || depth > 8) return text + "…]";
    if (text.size() > 1) text += ", ";
    text += to_string(element, limit, depth + 1);
  }
  return text + "]";
}

namespace {

constexpr int deepest = 16;  // vectors of vectors that operators go through

Result<Value> number_result(double value, const Place& place) {
  if (std::isfinite(value) || std::isnan(value)) return std::isnan(value) ? Value() : Value(value);
  return refusal(place, "the result is larger than any number", "use smaller numbers");
}

Result<Value> scaled(const Vector& elements, const Value& factor, const Operation& operation, int depth);
Result<Value> combined(std::string_view sign, const Value& a, const Value& b, const Operation& operation, int depth);

bool equal(const Value& a, const Value& b, const Operation& operation, int depth) {
  if (operation.budget == 0 || depth > deepest) return false;
  --operation.budget;
  if (a.number() && b.number()) return a.number()->value == b.number()->value;
  if (a.boolean() && b.boolean()) return *a.boolean() == *b.boolean();
  if (a.string() && b.string()) return *a.string() == *b.string();
  if (a.vector() && b.vector()) {
    const Vector &u = *a.vector(), &v = *b.vector();
    return std::equal(u.begin(), u.end(), v.begin(), v.end(),
                      [&](const Value& x, const Value& y) { return equal(x, y, operation, depth + 1); });
  }
  if (a.range() && b.range()) {
    return a.range()->begin == b.range()->begin && a.range()->step == b.range()->step &&
           a.range()->end == b.range()->end;
  }
  return a.is_undefined() && b.is_undefined();
}

/// A dot product, a row times a matrix, or a matrix times whatever its rows can be multiplied by.
Result<Value> product(const Vector& u, const Value& b, const Operation& operation, int depth) {
  const Vector& v = *b.vector();
  if (u.empty() || v.empty()) return Value();
  if (u[0].vector()) {
    Vector made;
    for (const Value& row : u) {
      if (!row.vector()) return Value();
      Result<Value> one = combined("*", row, b, operation, depth + 1);
      if (!one) return one;
      made.push_back(std::move(*one));
    }
    return Value(std::move(made));
  }
  if (u.size() != v.size()) return Value();
  Value sum;
  for (std::size_t i = 0; i < u.size(); ++i) {
    Result<Value> one = combined("*", u[i], v[i], operation, depth + 1);
    if (!one) return one;
    Result<Value> more = i == 0 ? std::move(one) : combined("+", sum, *one, operation, depth + 1);
    if (!more) return more;
    sum = std::move(*more);
  }
  return sum;
}

Result<Value> scaled(const Vector& elements, const Value& factor, const Operation& operation, int depth) {
  Vector made;
  for (const Value& element : elements) {
    Result<Value> one = combined("*", element, factor, operation, depth + 1);
    if (!one) return one;
    made.push_back(std::move(*one));
  }
  return Value(std::move(made));
}

Result<Value> combined(std::string_view sign, const Value& a, const Value& b, const Operation& operation, int depth) {
  if (depth > deepest) return Value();
  if (operation.budget == 0) return refusal(operation.place, "the vectors are too large", "use smaller ones");
  --operation.budget;
  const Vector *u = a.vector(), *v = b.vector();
  if ((sign == "/" || sign == "%") && b.number() && b.number()->value == 0) {
    return refusal(operation.place, "it divides by zero", "give the divisor another value");
  }
  if (a.number() && b.number()) {
    const double x = a.number()->value, y = b.number()->value;
    return number_result(sign == "+"   ? x + y
                         : sign == "-" ? x - y
                         : sign == "*" ? x * y
                         : sign == "^" ? std::pow(x, y)
                         : sign == "/" ? x / y
                                       : std::fmod(x, y),
                         operation.place);
  }
  if ((sign == "+" || sign == "-") && u && v) {  // as long as the shorter
    Vector made;
    for (std::size_t i = 0; i < std::min(u->size(), v->size()); ++i) {
      Result<Value> element = combined(sign, (*u)[i], (*v)[i], operation, depth + 1);
      if (!element) return element;
      made.push_back(std::move(*element));
    }
    return Value(std::move(made));
  }
  if (sign == "*" && u && v) return product(*u, b, operation, depth);
  if (sign == "*" && u && b.number()) return scaled(*u, b, operation, depth);
  if (sign == "*" && a.number() && v) return scaled(*v, a, operation, depth);
  if (sign == "/" && u && b.number()) return scaled(*u, Value(1 / b.number()->value), operation, depth);
  return Value();
}

}  // namespace

Result<Value> unary_value(std::string_view sign, const Value& operand, const Operation& operation) {
  if (sign == "!") return Value(!operand.is_true());
  if (sign == "+") return operand;
  return combined("*", operand, Value(-1.0), operation, 0);
}

Result<Value> binary_value(std::string_view sign, const Value& a, const Value& b, const Operation& operation) {
  if (sign == "==") return Value(equal(a, b, operation, 0));
  if (sign == "!=") return Value(!equal(a, b, operation, 0));
  if (sign != "<" && sign != ">" && sign != "<=" && sign != ">=") return combined(sign, a, b, operation, 0);
  int order = 0;
  if (a.number() && b.number()) {
    order = (a.number()->value > b.number()->value) - (a.number()->value < b.number()->value);
  } else if (a.string() && b.string()) {
    order = a.string()->compare(*b.string());
  } else {
    return Value();
  }
  return Value(sign == "<" ? order < 0 : sign == ">" ? order > 0 : sign == "<=" ? order <= 0 : order >= 0);
}

}  // namespace parsel::cad
