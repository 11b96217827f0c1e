#include "core/prove/range.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/base/tolerance.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

Range range(const Shape& shape, const Statement& s, double limit) {
  return find_range(shape, hand::program(shape, {s}), 0, -limit, limit);
}

}  // namespace

TEST_CASE("a slider stops where a part would collapse") {
  const Shape shape = hand::chair();
  // The volume is 1 + x of that at rest; collapse_ratio of it is left at x = -0.95.
  const Range scale = range(shape, statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1"), 2);
  CHECK(scale.min == doctest::Approx(-0.95).epsilon(1e-4));
  CHECK(scale.min >= -0.95);
  CHECK(scale.min_reason == "seat would collapse");
  CHECK(scale.max == 2);
  CHECK(scale.max_reason == "limit");

  const Range cube = range(shape, statement(Op::scale_3d, "seat", Vec3::UnitX(), "x1"), 2);
  CHECK(cube.min == doctest::Approx(std::cbrt(0.05) - 1).epsilon(1e-4));

  // The face at x = +0.4 moves towards the one at -0.4, 0.8 away.
  Statement face = statement(Op::translate, "seat", -Vec3::UnitX(), "x1");
  face.feature = {1, 0, 0};
  const Range moved = range(shape, face, 1);
  CHECK(moved.max == doctest::Approx(0.95 * 0.8).epsilon(1e-4));
  CHECK(moved.min == -1);

  const Range rigid = range(shape, statement(Op::rotate, "seat", Vec3::UnitY(), "x1"), tau);
  CHECK(rigid.min == -tau);
  CHECK(rigid.max == tau);
}

TEST_CASE("a slider stops where an amount ends, and at the first failure even if it passes") {
  const Shape shape = hand::chair();
  const Range root = range(shape, statement(Op::translate, "seat", Vec3::UnitX(), "sqrt(0.1-x1)-sqrt(0.1)"), tau);
  CHECK(root.max == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(root.max_reason == "the amount of seat would be undefined");
  CHECK(root.min == -tau);
  const Range steep = range(shape, statement(Op::translate, "seat", Vec3::UnitX(), "50*x1"), tau);
  CHECK(steep.max == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(steep.min_reason == "the amount of seat would be too large");
  // 16(x - 1/4)² - 1 is 0 at 0 and beyond 1/2, and -1 between, where the seat is flat.
  const Range dip = range(shape, statement(Op::scale_1d, "seat", Vec3::UnitX(), "16*(x1-0.25)^2-1"), 1);
  CHECK(dip.max == doctest::Approx(0.25 - std::sqrt(0.05 / 16)).epsilon(1e-3));
}

TEST_CASE("instances of a group are looked at too, and a shape that fails at once has no range") {
  const Shape shape = hand::slats();
  const Range row = range(shape, statement(Op::scale_1d, "slats", Vec3::UnitX(), "x1"), 2);
  CHECK(row.min == doctest::Approx(-0.95).epsilon(1e-4));
  Statement flat = statement(Op::scale_1d, "rail", Vec3::UnitX(), "x1-1");
  const Range none = range(shape, flat, tau);
  CHECK(none.min == 0);
  CHECK(none.max == 0);
  CHECK(none.max_reason == "rail would collapse");
}

TEST_CASE("a slider stops where a row that had room runs into itself") {
  const Shape shape = hand::slats();
  const RelationIndex t1 = *shape.find_relation("t1");
  const Translation& row = std::get<Translation>(shape.relations[t1].detail);
  const Corners& slat = shape.parts[shape.relations[t1].parts[0]].hexahedron.corners;
  const double thickness = slat.col(0).maxCoeff() - slat.col(0).minCoeff();
  const double extent = (row.end - row.start).norm();
  REQUIRE(extent / 2 > 1.1 * thickness);

  const auto of_group = [&](Op op, const std::string& amount, Anchor anchor) {
    return find_range(shape, hand::program(shape, {hand::group_statement(op, "t1", amount, anchor)}), 0, -1, 1);
  };
  const Range closer = of_group(Op::change_delta, "x1", Anchor::middle);
  CHECK(closer.min == doctest::Approx(thickness / (extent / 2) - 1).epsilon(1e-3));
  CHECK(closer.min_reason.find("would run into each other") != std::string::npos);
  CHECK(closer.max == 1);
  // n slats fit while (n - 1) thicknesses do.
  const Range more = of_group(Op::change_count, "100*x1", Anchor::fit);
  const double most = std::floor(extent / thickness + 1e-9) + 1;
  CHECK(more.max == doctest::Approx((most + 1 - 3) / 100).epsilon(1e-2));
  CHECK(more.max_reason == closer.min_reason);
}
