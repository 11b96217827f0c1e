// Values of OpenSCAD's expressions, its operators and its functions of numbers and vectors.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/cad/model.h"

namespace parsel::cad {

class Value;
using Vector = std::vector<Value>;

struct Range {
  double begin = 0, step = 1, end = 0;
};

/// A number knows the literal that it was written as; what is computed does not.
struct Number {
  double value = 0;
  Place literal;
};

struct Undefined {};

/// Copies share strings and the elements of vectors, which never change.
class Value {
 public:
  Value() = default;
  Value(bool value) : state_(value) {}
  Value(double value, Place literal = {}) : state_(Number{value, literal}) {}
  Value(std::string value) : state_(std::make_shared<const std::string>(std::move(value))) {}
  Value(Range value) : state_(value) {}
  Value(Vector value) : state_(std::make_shared<const Vector>(std::move(value))) {}

  bool is_undefined() const { return std::holds_alternative<Undefined>(state_); }
  const bool* boolean() const { return std::get_if<bool>(&state_); }
  const Number* number() const { return std::get_if<Number>(&state_); }
  const std::string* string() const {
    const auto* held = std::get_if<std::shared_ptr<const std::string>>(&state_);
    return held == nullptr ? nullptr : held->get();
  }
  const Range* range() const { return std::get_if<Range>(&state_); }
  const Vector* vector() const {
    const auto* held = std::get_if<std::shared_ptr<const Vector>>(&state_);
    return held == nullptr ? nullptr : held->get();
  }
  /// As a condition: undef, false, 0, "" and [] are not.
  bool is_true() const;
  std::string_view type() const;

 private:
  std::variant<Undefined, bool, Number, std::shared_ptr<const std::string>, Range, std::shared_ptr<const Vector>>
      state_;
};

/// As echo and str write it, cut to `limit` bytes and some; numbers with six digits.
std::string to_string(const Value& value, std::size_t limit = 200, int depth = 0);

/// Where an operator stands, and how many more elements all operators together may touch: vectors share their elements,
/// so that a short text can spell an endless sum.
struct Operation {
  Place place;
  std::size_t& budget;
};

/// What OpenSCAD leaves undefined is undef; a division by zero is an error, as are numbers beyond a double.
Result<Value> unary_value(std::string_view sign, const Value& operand, const Operation& operation);
Result<Value> binary_value(std::string_view sign, const Value& a, const Value& b, const Operation& operation);

/// A function that OpenSCAD provides, or an error that names it when there is none. Angles are in degrees.
Result<Value> builtin_value(std::string_view function, const Vector& arguments, const Operation& operation);

/// Sine and cosine of degrees, exact at multiples of 30 and 90 as in OpenSCAD.
double sin_degrees(double angle);
double cos_degrees(double angle);

}  // namespace parsel::cad
