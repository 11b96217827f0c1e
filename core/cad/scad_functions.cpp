// The functions that OpenSCAD provides.
#include <algorithm>
#include <cmath>

#include "core/base/text.h"
#include "core/base/tolerance.h"
#include "core/cad/scad_token.h"
#include "core/cad/scad_value.h"

namespace parsel::cad {

double sin_degrees(double angle) {
  const double turn = std::fmod(angle, 360.0), a = turn < 0 ? turn + 360 : turn;
  if (a == 0 || a == 180) return 0;
  if (a == 90) return 1;
  if (a == 270) return -1;
  if (a == 30 || a == 150) return 0.5;
  if (a == 210 || a == 330) return -0.5;
  return std::sin(a * pi / 180);
}

double cos_degrees(double angle) {
  return sin_degrees(angle + 90);
}

namespace {

using Function = double (*)(double);
constexpr double degrees = 180 / pi;

struct OfNumber {
  std::string_view name;
  Function function;
};
constexpr OfNumber of_number[] = {
    {"abs", [](double x) { return std::abs(x); }},
    {"sign", [](double x) { return double((x > 0) - (x < 0)); }},
    {"floor", [](double x) { return std::floor(x); }},
    {"ceil", [](double x) { return std::ceil(x); }},
    {"round", [](double x) { return std::round(x); }},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"exp", [](double x) { return std::exp(x); }},
    {"ln", [](double x) { return std::log(x); }},
    {"log", [](double x) { return std::log10(x); }},
    {"sin", sin_degrees},
    {"cos", cos_degrees},
    {"tan", [](double x) { return sin_degrees(x) / cos_degrees(x); }},
    {"asin", [](double x) { return std::asin(x) * degrees; }},
    {"acos", [](double x) { return std::acos(x) * degrees; }},
    {"atan", [](double x) { return std::atan(x) * degrees; }},
};

Result<Value> extreme(std::string_view function, const Vector& given) {
  const Vector& elements = given.size() == 1 && given[0].vector() ? *given[0].vector() : given;
  if (elements.empty()) return Value();
  const Value* best = nullptr;
  for (const Value& element : elements) {
    if (!element.number()) return Value();
    const double x = element.number()->value;
    if (!best || (function == "min" ? x < best->number()->value : x > best->number()->value)) best = &element;
  }
  return *best;
}

Result<Value> of_vectors(std::string_view function, const Vector& given) {
  const Vector* a = given.empty() ? nullptr : given[0].vector();
  const Vector* b = given.size() < 2 ? nullptr : given[1].vector();
  const auto at = [](const Vector& v, std::size_t i) { return v[i].number() ? v[i].number()->value : NAN; };
  if (function == "norm") {
    if (!a) return Value();
    double sum = 0;
    for (std::size_t i = 0; i < a->size(); ++i) sum += at(*a, i) * at(*a, i);
    return std::isnan(sum) ? Value() : Value(std::sqrt(sum));
  }
  if (!a || !b || a->size() != 3 || b->size() != 3) return Value();
  Vector made;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    made.push_back(at(*a, j) * at(*b, k) - at(*a, k) * at(*b, j));
  }
  return Value(std::move(made));
}

/// Linear interpolation in a table of [key, value], constant beyond its ends.
Value looked_up(double key, const Vector& table) {
  const Number *low_key = nullptr, *low = nullptr, *high_key = nullptr, *high = nullptr;
  for (const Value& entry : table) {
    const Vector* pair = entry.vector();
    if (!pair || pair->size() < 2 || !(*pair)[0].number() || !(*pair)[1].number()) return {};
    const Number *k = (*pair)[0].number(), *v = (*pair)[1].number();
    if (k->value <= key && (!low_key || k->value > low_key->value)) low_key = k, low = v;
    if (k->value >= key && (!high_key || k->value < high_key->value)) high_key = k, high = v;
  }
  if (!low && !high) return {};
  if (!low || !high) return Value(low ? low->value : high->value);
  if (low_key->value == high_key->value) return Value(low->value);
  return Value(low->value + (high->value - low->value) * (key - low_key->value) / (high_key->value - low_key->value));
}

}  // namespace

Result<Value> builtin_value(std::string_view function, const Vector& given, const Operation& operation) {
  const auto is = [&](std::string_view name) { return function == name; };
  const auto number_at = [&](std::size_t i) { return i < given.size() ? given[i].number() : nullptr; };
  for (const OfNumber& known : of_number) {
    if (!is(known.name)) continue;
    if (!number_at(0)) return Value();
    const double x = known.function(number_at(0)->value);
    if (std::isinf(x)) return refusal(operation.place, "the result is larger than any number", "use other numbers");
    return std::isnan(x) ? Value() : Value(x);
  }
  if (is("min") || is("max")) return extreme(function, given);
  if (is("norm") || is("cross")) return of_vectors(function, given);
  if (is("pow") && number_at(0) && number_at(1)) return binary_value("^", given[0], given[1], operation);
  if (is("atan2") && number_at(0) && number_at(1)) {
    return Value(std::atan2(number_at(0)->value, number_at(1)->value) * degrees);
  }
  if (is("len") && given.size() == 1) {
    if (given[0].vector()) return Value(double(given[0].vector()->size()));
    if (given[0].string()) return Value(double(count_characters(*given[0].string())));
    return Value();
  }
  if (is("concat")) {
    Vector made;
    for (const Value& one : given) {
      const std::size_t more = one.vector() ? one.vector()->size() : 1;
      if (more > operation.budget) return refusal(operation.place, "the vectors are too large", "use smaller ones");
      operation.budget -= more;
      if (one.vector()) {
        made.insert(made.end(), one.vector()->begin(), one.vector()->end());
      } else {
        made.push_back(one);
      }
    }
    return Value(std::move(made));
  }
  if (is("str")) {
    std::string text;
    for (const Value& one : given) text += to_string(one, 2'000);
    if (text.size() > 10'000)
      return refusal(operation.place, "the string is longer than 10,000 bytes", "make it shorter");
    return Value(std::move(text));
  }
  if (is("lookup") && number_at(0) && given.size() == 2 && given[1].vector()) {
    return looked_up(number_at(0)->value, *given[1].vector());
  }
  if (given.size() == 1) {
    if (is("is_undef")) return Value(given[0].is_undefined());
    if (is("is_num")) return Value(given[0].number() != nullptr);
    if (is("is_bool")) return Value(given[0].boolean() != nullptr);
    if (is("is_string")) return Value(given[0].string() != nullptr);
    if (is("is_list")) return Value(given[0].vector() != nullptr);
  }
  if (is("version_num")) return Value(20210100.0);  // that of Debian 12 and 13
  if (is("version")) return Value(Vector{Value(2021.0), Value(1.0)});
  for (const std::string_view known :
       {"pow", "atan2", "len", "lookup", "is_undef", "is_num", "is_bool", "is_string", "is_list"}) {
    if (is(known)) return Value();
  }
  return refusal(operation.place, "there is no function '" + printable(function, 40) + "' here",
                 "define it, or open the .csg that OpenSCAD writes of this program");
}

}  // namespace parsel::cad
