// What is seen to go wrong over a slider's range, and what only slides.
#include "core/prove/clearance.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/prove/prove.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

std::vector<SeenFault> seen(const Shape& shape, std::vector<Statement> statements, double min, double max) {
  return seen_faults(shape, hand::program(shape, std::move(statements), min, max), 0);
}

}  // namespace

TEST_CASE("a joint along which a part slides is broken, and nothing is seen") {
  const Shape shape = hand::chair();
  const Program program =
      hand::program(shape, {statement(Op::translate, "leg_left", Vec3::UnitZ(), "x1")}, -0.05, 0.05);
  bool broken = false;
  for (const RelationReport& report : prove_relations(shape, program, 0, {}))
    broken = broken || (report.id == "a1" && report.status == RelationStatus::broken);
  CHECK(broken);
  CHECK(seen_faults(shape, program, 0).empty());
}

TEST_CASE("parts that come apart are named once, with the first step at which it is seen") {
  const std::vector<SeenFault> faults =
      seen(hand::chair(), {statement(Op::translate, "leg_left", -Vec3::UnitY(), "x1")}, 0, 0.24);
  REQUIRE(faults.size() == 1);
  CHECK(std::set<std::string>{faults[0].a, faults[0].b} == std::set<std::string>{"leg_left", "seat"});
  CHECK(faults[0].apart);
  // Steps are 0.01; the first beyond seen_gap.
  CHECK(faults[0].x == doctest::Approx(0.02));
  CHECK(to_json(faults)[0]["apart"] == true);
}

TEST_CASE("parts that run into each other are seen on either side of the range") {
  const Shape shape = hand::chair();
  for (const double sign : {-1.0, 1.0}) {
    const auto faults = seen(shape, {statement(Op::translate, "leg_left", -sign * Vec3::UnitX(), "x1")},
                             sign < 0 ? -0.58 : 0, sign < 0 ? 0 : 0.58);
    bool met = false;
    for (const SeenFault& fault : faults) {
      const bool is_legs = std::set<std::string>{fault.a, fault.b} == std::set<std::string>{"leg_left", "leg_right"};
      if (!is_legs) continue;
      met = true;
      CHECK_FALSE(fault.apart);
      CHECK(fault.x * sign > 0.4);
    }
    CHECK(met);
  }
}
