// Certificates under attack: spikes narrower than any sampling, steps, jumps and kinks, whose places the test knows.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "core/amount/number.h"
#include "core/edit/evaluate.h"
#include "core/prove/deviation.h"
#include "core/prove/prove.h"
#include "core/prove/range.h"
#include "core/prove/scope.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

constexpr double reach = 0.35;

struct Hostile {
  std::string amount;
  std::vector<double> places;  ///< of its spikes, steps, jumps and kinks
  double width = 1e-3;         ///< of what is narrowest
};

std::string text(double value) {
  return "(" + shortest_decimal(value) + ")";
}

/// About 0.3 high at most, often about as high as the tolerances.
Hostile hostile(Random& random) {
  const double place = random.uniform(-0.9 * reach, 0.9 * reach);
  const std::array<double, 5> heights = {0.3, 0.05, 0.02, 0.0145, 0.0144};
  const double height = heights[random.below(heights.size())];
  const double width = std::pow(10, -random.uniform(2, 10));
  const std::string from = "(x1-" + text(place) + ")";
  switch (random.below(8)) {
    case 0: {
      const std::string square = text(width * width);
      return {text(height) + "*" + square + "/(" + from + "^2+" + square + ")", {place}, width};
    }
    case 1: {
      const std::string square = text(width * width);
      return {text(height) + "*" + square + "/(" + from + "*" + from + "+" + square + ")", {place}, width};
    }
    case 2:
      return {text(height) + "*atan2(" + from + "," + text(width) + ")", {place}, width};
    case 3: {
      const double steps = 1 + static_cast<double>(random.below(6));
      Hostile result{text(height) + "*floor(" + text(steps) + "*" + from + ")", {}, 1e-9};
      for (double k = -8; k <= 8; ++k) result.places.push_back((k - counting_slack) / steps + place);
      return result;
    }
    case 4:
      return {text(height) + "*abs(" + from + ")", {place}, width};
    case 5:  // a tooth
      return {text(height) + "*max(0,1-abs(" + from + ")/" + text(width) + ")",
              {place, place - width, place + width},
              width};
    case 6:
      return {text(height) + "*floor(3*abs(" + from + "))",
              {place, place + (1 - counting_slack) / 3, place - (1 - counting_slack) / 3},
              1e-9};
    default:
      return {text(height) + "*min(1,floor(1+" + from + "/" + text(width) + ")^2)",
              {place, place - width, place + width},
              width};
  }
}

/// Where to look: evenly, and ever nearer to the places.
std::vector<double> points(const std::vector<Hostile>& all, double low, double high) {
  std::vector<double> result;
  for (int i = 0; i <= 300; ++i) result.push_back(low + (high - low) * i / 300);
  for (const Hostile& one : all) {
    for (const double place : one.places) {
      for (const double sign : {-1.0, 1.0}) {
        for (double scale = 1e-4; scale < 1e4; scale *= 2.5) result.push_back(place + sign * scale * one.width);
        double beside = place;
        for (int i = 0; i < 4; ++i) result.push_back(beside = std::nextafter(beside, sign));
      }
      result.push_back(place);
    }
  }
  std::vector<double> inside;
  for (const double x : result) {
    if (low <= x && x <= high) inside.push_back(x);
  }
  return inside;
}

/// Largest deviation that was found.
double found_worst(const Shape& shape, const Program& program, RelationIndex relation, const std::vector<double>& at) {
  const Evaluator evaluator(program, shape);
  const Constraint constraint = make_constraint(shape, relation);
  double worst = 0;
  for (const double x : at) worst = std::max(worst, deviation(constraint, evaluator({x})));
  return worst;
}

}  // namespace

TEST_CASE("no certificate is violated by spikes, steps, jumps and kinks") {
  const Shape shape = hand::chair();
  Random random(23);
  int certified = 0;
  int reports = 0;
  int below = 0;
  for (int round = 0; round < 300; ++round) {
    const Hostile first = hostile(random);
    const Hostile second = hostile(random);
    const std::string both = first.amount + "+" + second.amount;
    // The leg follows the seat, exactly, in other words, or but for a spike.
    const std::string follows = random.below(3) == 0   ? first.amount
                                : random.below(2) == 0 ? both + "-" + second.amount
                                                       : both;
    const Program program =
        hand::program(shape, {statement(Op::translate, "seat", Vec3::UnitX(), first.amount),
                              statement(random.below(2) == 0 ? Op::translate : Op::scale_1d, "leg_left", Vec3::UnitX(),
                                        follows, Vec3(random.uniform(-1, 1), 0, 0)),
                              statement(Op::rotate, "back", Vec3::UnitY(), second.amount)});
    const Scope scope = scope_of(shape, program, 0, {});
    const std::vector<double> at = points({first, second}, -reach, reach);
    for (const RelationReport& report : prove_relations(shape, program, 0, {})) {
      const RelationIndex relation = *shape.find_relation(report.id);
      const double tolerance = tolerance_of(shape.relations[relation], scope);
      ++reports;
      if (report.proof != Proof::certified) {
        CHECK(report.samples.value_or(0) >= 257);
        continue;
      }
      CHECK(!report.samples);
      ++certified;
      const double worst = found_worst(shape, program, relation, at);
      CAPTURE(report.id);
      CAPTURE(first.amount);
      CAPTURE(second.amount);
      CAPTURE(follows);
      // Doubles round where the bound speaks of exact numbers.
      CHECK(worst <= report.worst + 1e-9);
      if (report.status == RelationStatus::broken) below += worst <= tolerance - 1e-9;
      if (report.status == RelationStatus::held) CHECK(worst <= tolerance + 1e-9);
    }
  }
  CHECK(below == 0);
  MESSAGE(certified << " of " << reports << " certified");
  CHECK(certified > reports / 2);
}

TEST_CASE("a spike that no slider shows is no proof of the rest") {
  const Shape shape = hand::chair();
  // 0.3 high and 1e-9 wide, at a place that neither samples nor halving meet.
  const auto reports =
      prove_relations(shape,
                      hand::program(shape, {statement(Op::translate, "seat", Vec3::UnitX(), "x1"),
                                            statement(Op::translate, "leg_left", Vec3::UnitX(),
                                                      "x1+0.3*1e-18/((x1-0.123456789)*(x1-0.123456789)+1e-18)")}),
                      0, {});
  for (const RelationReport& report : reports) {
    if (report.id == "a1" && report.proof == Proof::certified) CHECK(report.worst >= 0.3 - 1e-6);
  }
}

TEST_CASE("what jumps as one is certified as one") {
  const Shape shape = hand::chair();
  for (const std::string amount :
       {"0.1*floor(10*x1)", "abs(x1-0.1)", "max(0.1,x1)", "0.2*floor(7*abs(x1))", "min(x1,0.1)+floor(9*x1)/50"}) {
    CAPTURE(amount);
    const auto reports =
        prove_relations(shape,
                        hand::program(shape, {statement(Op::translate, "seat", Vec3::UnitX(), amount),
                                              statement(Op::translate, "leg_left", Vec3::UnitX(), amount)}),
                        0, {});
    for (const RelationReport& report : reports) {
      if (report.id != "a1") continue;
      CHECK(report.status == RelationStatus::held);
      CHECK(report.proof == Proof::certified);
      CHECK(report.worst < 1e-12);
    }
  }
}

TEST_CASE("a part that turns inside out between two steps ends the range") {
  const Shape shape = hand::chair();
  for (const double width : {1e-2, 1e-4, 1e-6}) {
    for (const double place : {0.123456789, -0.2718281828}) {
      CAPTURE(width);
      CAPTURE(place);
      const std::string square = text(width * width);
      const std::string amount = "-1.5*" + square + "/((x1-" + text(place) + ")^2+" + square + ")";
      const Range range = find_range(
          shape, hand::program(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), amount)}), 0, -reach, reach);
      const double end = place > 0 ? range.max : range.min;
      CHECK(std::abs(end) <= std::abs(place));
      CHECK(std::abs(end) >= std::abs(place) - width - 1e-3);
      CHECK((place > 0 ? range.max_reason : range.min_reason) != "limit");
      CHECK((place > 0 ? range.min : range.max) == (place > 0 ? -reach : reach));
    }
  }
}
