// Ranges cut to where nothing comes apart, and stretched as far as they go.
#include "core/propagate/clean.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/check/check.h"
#include "core/prove/prove.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

Program proved(const Shape& shape, std::vector<Statement> statements, double min, double max) {
  Program program = hand::program(shape, std::move(statements), min, max);
  program.layers[0].relations = prove_relations(shape, program, 0, {});
  return program;
}

bool all_held(const Program& program) {
  for (const RelationReport& report : program.layers[0].relations) {
    if (report.status != RelationStatus::held) return false;
  }
  return !program.layers[0].relations.empty();
}

/// The seat wider, with legs that follow by `legs` (each way) and a back as wide as the seat.
std::vector<Statement> wider(const std::string& legs) {
  return {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1"),
          statement(Op::translate, "leg_left", Vec3::UnitX(), legs),
          statement(Op::translate, "leg_right", -Vec3::UnitX(), legs),
          statement(Op::scale_1d, "back", Vec3::UnitX(), "x1"), statement(Op::scale_1d, "handle", Vec3::UnitX(), "x1")};
}

}  // namespace

TEST_CASE("a range is cut to where the first joint comes apart") {
  const Shape shape = hand::chair();
  // The back is joined to the seat at x = ±0.4, so that it is off by 0.4 |x|.
  Program program = proved(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1")}, -tau, tau);
  REQUIRE_FALSE(all_held(program));
  program.layers[0].parameter.value = 0.3;
  cut_to_clean(shape, program, 0);
  const Parameter& range = program.layers[0].parameter;
  CHECK(range.max == doctest::Approx(delta_one_edited / 0.4).epsilon(0.03));
  CHECK(range.max <= delta_one_edited / 0.4);
  CHECK(range.min == -range.max);
  CHECK(range.value == range.max);
  CHECK(all_held(program));
  CHECK(check_program(shape, program).accepted());
}

TEST_CASE("a clean range stays as it is, also where a relation was given up on purpose") {
  const Shape shape = hand::chair();
  Program program = proved(shape, wider("0.3*x1"), -tau, tau);
  REQUIRE(all_held(program));
  cut_to_clean(shape, program, 0);
  CHECK(program.layers[0].parameter.min == -tau);
  CHECK(program.layers[0].parameter.max == tau);
}

TEST_CASE("a range is stretched as far as parts keep their right side out") {
  const Shape shape = hand::chair();
  Program program = proved(shape, wider("0.3*x1"), -0.1, 0.1);
  extend_range(shape, program, 0, 2);
  CHECK(program.layers[0].parameter.max == 2);
  CHECK(program.layers[0].parameter.min == -0.1);
  extend_range(shape, program, 0, -3);
  CHECK(program.layers[0].parameter.min == doctest::Approx(-0.95).epsilon(1e-3));
  CHECK(all_held(program));
  CHECK(check_program(shape, program).accepted());
  const Program before = program;
  extend_range(shape, program, 0, 1);
  CHECK(program.layers[0].parameter.max == before.layers[0].parameter.max);
}

TEST_CASE("a range is stretched as far as what was held is held") {
  const Shape shape = hand::chair();
  // Off by 0.3 x² where both parts move.
  Program program = proved(shape, wider("0.3*x1-0.3*x1^2"), -0.1, 0.1);
  REQUIRE(all_held(program));
  extend_range(shape, program, 0, 2);
  CHECK(program.layers[0].parameter.max == doctest::Approx(std::sqrt(delta_both_edited / 0.3)).epsilon(0.02));
  CHECK(all_held(program));
  CHECK(validate(program, shape).ok());
}

TEST_CASE("a slider that would do nothing clean is refused") {
  const Shape shape = hand::chair();
  EditRequest request{{statement(Op::scale_1d, "seat", Vec3::UnitX(), "x")}, {}, {}};
  const auto found = propagate_cleanly(shape, request);
  REQUIRE_MESSAGE(found.ok(), (found.ok() ? "" : found.error().message()));
  CHECK(all_held(found->program));
  for (const char* id : {"leg_left", "back"}) request.hints[id] = Hint::keep_fixed;
  const auto refused = propagate_cleanly(shape, request);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().stage == "propagate/clean");
}
