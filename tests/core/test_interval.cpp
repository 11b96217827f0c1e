#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/amount/interval.h"
#include "core/base/random.h"
#include "core/prove/casework.h"
#include "hand_shapes.h"

using namespace parsel;

namespace {

Interval random_interval(Random& random) {
  const double scales[] = {1e-300, 1e-8, 0.1, 1, 10, 1e8};
  const double scale = scales[random.below(6)];
  const double a = random.uniform(-scale, scale);
  if (random.below(4) == 0) return a;
  const double b = a + scale * random.unit() * (random.below(2) == 0 ? 1 : 1e-12);
  return {a, b};
}

double inside(const Interval& interval, Random& random) {
  const double x = interval.low + (interval.high - interval.low) * random.unit();
  return std::min(std::max(x, interval.low), interval.high);
}

bool holds(const Interval& interval, long double exact) {
  // An end that is NaN, after an overflow, excludes nothing.
  return !(exact < static_cast<long double>(interval.low)) && !(exact > static_cast<long double>(interval.high));
}

}  // namespace

TEST_CASE("interval operations contain the exact results of their members") {
  Random random(1);
  int wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const Interval a = random_interval(random);
    const Interval b = random_interval(random);
    const long double x = inside(a, random);
    const long double y = inside(b, random);
    wrong += !holds(a + b, x + y);
    wrong += !holds(a - b, x - y);
    wrong += !holds(a * b, x * y);
    if (!b.contains(0)) wrong += !holds(a / b, x / y);
    wrong += !holds(2.5 * a, 2.5L * x);
    if (a.low >= 0) wrong += !holds(sqrt(a), std::sqrt(x));
    if (a.low > 0) wrong += !holds(power(a, -1.5), std::pow(x, -1.5L));
    if (a.magnitude() < 1e5) {
      wrong += !holds(sin(a), std::sin(x));
      wrong += !holds(cos(a), std::cos(x));
    }
    wrong += !holds(atan2(a, b), std::atan2(x, y));
    wrong += !holds(abs(a), std::abs(x));
    wrong += !holds(floor(a), std::floor(x));
    wrong += !holds(min(a, b), std::min(x, y));
    wrong += !holds(max(a, b), std::max(x, y));
  }
  CHECK(wrong == 0);
}

TEST_CASE("ranges of sine and cosine reach 1 exactly where a crest lies inside") {
  CHECK(sin(Interval(1, 2)).high == 1);
  CHECK(sin(Interval(0, 1)).high < 0.8415);
  CHECK(cos(Interval(-0.1, 0.2)).high == 1);
  CHECK(cos(Interval(3, 3.3)).low == -1);
  CHECK(cos(Interval(0.1, 3)).low > -0.99);
  CHECK(sin(Interval(0, 7)).low == -1);
  CHECK(sin(Interval(0, 7)).high == 1);
}

TEST_CASE("what cannot be bounded is bounded by nothing, and never by accident") {
  const double infinity = std::numeric_limits<double>::infinity();
  CHECK((Interval(1, 2) / Interval(-1, 1)).magnitude() == infinity);
  CHECK((Interval(0, 0) * Interval::everything()).magnitude() == infinity);
  CHECK(Interval(std::nan(""), 1).magnitude() == infinity);
  CHECK(power(Interval(-1, 1), 0.5).magnitude() == infinity);
}

TEST_CASE("jets bound random closed forms over their range, tightly after cancellation") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const std::string text = "(" + hand::random_amount(random) + ")*(" + hand::random_amount(random) + ")+sin(2*(" +
                             hand::random_amount(random) + "))";
    CAPTURE(text);
    const CompiledAmount amount = parse_amount(text).value().compile({"x1"});
    const double middle = random.uniform(-0.2, 0.2);
    const double radius = random.uniform(0.001, 0.15);
    const Interval piece(middle - radius, middle + radius);
    const Jet variable = Jet::variable(middle);
    const Jet range = Jet::variable(piece);
    const Jet at_middle = evaluate(amount, &variable);
    const Jet over = evaluate(amount, &range);
    REQUIRE(over.defined);
    REQUIRE(over.smooth);
    const double limit = bound(at_middle, over, radius);
    double worst = 0;
    for (int k = 0; k <= 20; ++k) {
      const double x = std::min(std::max(middle - radius + 2 * radius * k / 20, piece.low), piece.high);
      const double value = amount(&x);
      worst = std::max(worst, std::abs(value));
      CHECK(over.c[0].contains(value));
    }
    CHECK(worst <= limit + 1e-15);
    const Jet near = Jet::variable(Interval(middle - radius / 16, middle + radius / 16));
    const Jet over_near = evaluate(amount, &near);
    CHECK(bound(at_middle - at_middle, over_near - over_near, radius / 16) < 1e-8);
  }
}

TEST_CASE("kinks, jumps and singularities inside the range are told apart") {
  const auto over = [](const std::string& text, double low, double high) {
    const Jet range = Jet::variable(Interval(low, high));
    return evaluate(parse_amount(text).value().compile({"x1"}), &range);
  };
  CHECK(over("abs(x1)", 0.1, 0.2).smooth);
  CHECK_FALSE(over("abs(x1)", -0.1, 0.2).smooth);
  CHECK(over("abs(x1)", -0.1, 0.2).defined);
  CHECK(over("floor(10*x1)", 0.11, 0.19).smooth);
  CHECK_FALSE(over("floor(10*x1)", 0.11, 0.21).smooth);
  CHECK_FALSE(over("min(x1,0.1)", 0, 0.2).smooth);
  CHECK(over("max(x1,0.1)", 0.2, 0.3).smooth);
  CHECK_FALSE(over("1/x1", -0.1, 0.1).defined);
  CHECK_FALSE(over("sqrt(x1)", -0.1, 0.1).defined);
  CHECK_FALSE(over("sqrt(x1)", 0, 0.1).smooth);
  CHECK_FALSE(over("2^x1", 0, 0.1).defined);
  CHECK_FALSE(over("atan2(x1,x1-1)", -0.1, 0.1).smooth);
  CHECK(over("(1+x1)^-3", -0.1, 0.1).defined);
}
