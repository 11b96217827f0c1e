#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::box;
using fixture::count;
using fixture::Named;

TEST_CASE("four legs of a table are two reflections each, square or not") {
  for (const double depth : {0.8, 1.2}) {
    const Shape shape = fixture::shape(fixture::table(1.2, depth));
    CHECK(count(shape, RelationKind::reflection) == 4);
    CHECK(count(shape, RelationKind::translation) == 0);
    CHECK(count(shape, RelationKind::rotation) == 0);
  }
}

TEST_CASE("splayed legs are reflections with hexahedra that follow them") {
  auto parts = fixture::table(1.0, 1.0);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    Vec3 top = Vec3::Zero();
    for (const Vec3& p : parts[i].mesh.positions) top += p / 8;
    top.y() = 0.7;
    const Vec3 outward = Vec3(top.x(), 0, top.z()).normalized();
    parts[i].mesh = fixture::turned(parts[i].mesh, top, outward.cross(Vec3::UnitY()).normalized(), -0.15);
  }
  const Shape shape = fixture::shape(parts);
  CHECK(count(shape, RelationKind::reflection) == 4);
  CHECK(count(shape, RelationKind::rotation) == 0);
  const Part& leg = shape.parts[*shape.find_part("leg_front_left")];
  CHECK(leg.hexahedron.half_extents().minCoeff() * shape.frame.scale <
        0.045);  // 0.03 when it follows the splay exactly
}

TEST_CASE("slats, shelves, pickets and rungs are translations with a virtual part") {
  const Shape chair = fixture::shape(fixture::slat_chair(5));
  REQUIRE(count(chair, RelationKind::translation) == 1);
  CHECK(count(chair, RelationKind::reflection) == 4);
  const auto group = chair.find_part("slat_group");
  REQUIRE(group);
  CHECK(chair.parts[*group].members.size() == 5);
  const Translation& t = std::get<Translation>(chair.relations[*chair.parts[*group].group].detail);
  CHECK((t.end - t.start).norm() * chair.frame.scale == doctest::Approx(0.4).epsilon(1e-4));

  std::vector<Named> ladder = {{"left pole", box({0.25, 1, 0}, {0.04, 2, 0.04})},
                               {"right pole", box({-0.25, 1, 0}, {0.04, 2, 0.04})}};
  for (int i = 0; i < 7; ++i) ladder.push_back({"rung", box({0, 0.2 + 0.25 * i, 0}, {0.46, 0.03, 0.03})});
  for (Named& part : ladder) part.mesh = fixture::turned(part.mesh, Vec3::Zero(), Vec3::UnitX(), -0.25);  // it leans
  const Shape leaning = fixture::shape(ladder);
  CHECK(count(leaning, RelationKind::translation) == 1);
  CHECK(count(leaning, RelationKind::reflection) == 1);
  CHECK(leaning.parts[*leaning.find_part("rung_group")].members.size() == 7);
}

TEST_CASE("three round-table legs and the blades of fans are rotations") {
  std::vector<Named> round = {{"top", box({0, 0.72, 0}, {1, 0.04, 1})}};
  for (int k = 0; k < 3; ++k) {
    round.push_back(
        {"leg", fixture::turned(box({0.35, 0.35, 0}, {0.06, 0.7, 0.06}), Vec3::Zero(), Vec3::UnitY(), 2 * pi * k / 3)});
  }
  const Shape table = fixture::shape(round);
  REQUIRE(count(table, RelationKind::rotation) == 1);
  CHECK(count(table, RelationKind::reflection) == 0);
  const Part& group = table.parts[*table.find_part("leg_group")];
  const Rotation& r = std::get<Rotation>(table.relations[*group.group].detail);
  CHECK(r.radius * table.frame.scale == doctest::Approx(0.35).epsilon(1e-3));
  CHECK(r.axis.isApprox(Vec3::UnitY()));
  // Square about the axis, although three legs are not.
  CHECK(group.hexahedron.half_extents()[0] == doctest::Approx(group.hexahedron.half_extents()[2]));

  for (const int blades : {3, 4, 5, 6}) {
    for (const double start : {0.2, pi / 4, 0.0}) {
      CAPTURE(blades);
      CAPTURE(start);
      const Shape fan = fixture::shape(fixture::fan(blades, start));
      CHECK(count(fan, RelationKind::rotation) == 1);
      CHECK(count(fan, RelationKind::reflection) == 0);
    }
  }
}

TEST_CASE("four aprons around a square table are reflections, pair by pair") {
  std::vector<Named> parts = {{"top", box({0, 0.72, 0}, {1, 0.04, 1})}};
  for (const double side : {1.0, -1.0}) {
    parts.push_back({"apron", box({side * 0.4, 0.65, 0}, {0.02, 0.1, 0.78})});
    parts.push_back({"apron", box({0, 0.65, side * 0.4}, {0.78, 0.1, 0.02})});
  }
  const Shape shape = fixture::shape(parts);
  CHECK(count(shape, RelationKind::rotation) == 0);
  CHECK(count(shape, RelationKind::reflection) == 2);
}

TEST_CASE("five legs with one in the middle are no diagonal lines") {
  auto parts = fixture::table(1.2, 0.8);
  parts.push_back({"leg", box({0, 0.35, 0}, {0.06, 0.7, 0.06})});
  const Shape shape = fixture::shape(parts);
  CHECK(count(shape, RelationKind::translation) == 0);
  CHECK(count(shape, RelationKind::reflection) == 4);
}

TEST_CASE("a set of shelves at unequal heights has no group and no chance reflections") {
  std::vector<Named> parts = {{"leftwall", box({0.5, 1, 0}, {0.02, 2, 0.3})},
                              {"rightwall", box({-0.5, 1, 0}, {0.02, 2, 0.3})}};
  for (const double y : {0.2, 0.5, 1.1, 1.9}) parts.push_back({"shelf", box({0, y, 0}, {0.98, 0.02, 0.3})});
  const Shape shape = fixture::shape(parts);
  CHECK(count(shape, RelationKind::translation) == 0);
  CHECK(fixture::relations(shape)[fixture::relations(shape).size() - 1].starts_with("reflection leftwall rightwall"));
  CHECK(count(shape, RelationKind::reflection) == 1);
}

TEST_CASE("two groups that mirror each other are tied by their parents as well as by their instances") {
  std::vector<Named> parts = {{"base", box({0, 0, 0}, {1.2, 0.04, 1.2})}};
  for (const double x : {0.5, -0.5}) {
    for (int i = 0; i < 4; ++i) parts.push_back({"picket", box({x, 0.3, -0.45 + 0.3 * i}, {0.02, 0.56, 0.08})});
  }
  const Shape shape = fixture::shape(parts);
  CHECK(count(shape, RelationKind::translation) == 2);
  CHECK(count(shape, RelationKind::reflection) == 5);  // four pairs of pickets, one of parents
  std::size_t active = 0;
  for (const RelationIndex r : active_relations(shape)) {
    if (shape.relations[r].kind == RelationKind::reflection) ++active;
  }
  CHECK(active == 1);
}

TEST_CASE("parts of one label that differ in shape are not tied") {
  auto parts = fixture::table();
  parts[1].mesh = fixture::box({0.55, 0.35, 0.35}, {0.06, 0.7, 0.12});
  const Shape shape = fixture::shape(parts);
  CHECK(count(shape, RelationKind::reflection) == 2);  // front right with back right, back left with back right
}

TEST_CASE("a mirror image must be one of the surface, not only of the box") {
  // Two wedges with the same box, both sloping the same way.
  const auto wedge = [](double x) {
    fixture::Mesh mesh = box({x, 0.2, 0}, {0.3, 0.4, 0.3});
    for (Vec3& p : mesh.positions) {
      if (p.x() > x && p.y() > 0.3) p.y() = 0.0;
    }
    return mesh;
  };
  const std::vector<Named> parts = {
      {"foot", wedge(0.5)}, {"foot", wedge(-0.5)}, {"board", box({0, 0.42, 0}, {1.4, 0.04, 0.3})}};
  CHECK(count(fixture::shape(parts), RelationKind::reflection) == 0);
}
