#include "core/shape/ground.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/base/tolerance.h"
#include "core/check/check.h"
#include "core/edit/evaluate.h"
#include "core/prove/prove.h"
#include "core/shape/words.h"
#include "tests/core/hand_shapes.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using fixture::box;
using fixture::Named;

namespace {

std::set<std::string> standing(const Shape& shape, bool active_only = true) {
  std::set<std::string> ids;
  for (const RelationIndex r : shape.relations.indices()) {
    if (shape.relations[r].kind != RelationKind::ground || (active_only && !is_active(shape, r))) continue;
    ids.insert(shape.parts[shape.relations[r].parts[0]].id);
  }
  return ids;
}

const Ground& ground_of(const Shape& shape, const std::string& part) {
  for (const Relation& r : shape.relations) {
    if (r.kind == RelationKind::ground && shape.parts[r.parts[0]].id == part) return std::get<Ground>(r.detail);
  }
  FAIL("it does not stand");
  return std::get<Ground>(shape.relations[RelationIndex(0)].detail);
}

std::vector<Named> turned(std::vector<Named> parts, const Vec3& axis, double angle) {
  for (Named& part : parts) part.mesh = fixture::turned(part.mesh, Vec3::Zero(), axis, angle);
  return parts;
}

const std::set<std::string> four_legs = {"leg_back_left", "leg_back_right", "leg_front_left", "leg_front_right"};

}  // namespace

TEST_CASE("the legs of a table stand on the floor with the corners of their feet, the top does not") {
  const Shape shape = fixture::shape(fixture::table());
  CHECK(standing(shape) == four_legs);
  const Ground& ground = ground_of(shape, "leg_front_left");
  REQUIRE(ground.local.size() == 4);
  for (const Vec3& local : ground.local) CHECK(local.cwiseAbs() == Vec3::Ones());
  for (const Vec3& local : ground.local) CHECK(local.y() == -1);
}

TEST_CASE("a table that lies on its side stands on what is lowest then, upside down on its top") {
  CHECK(standing(fixture::shape(turned(fixture::table(), Vec3::UnitX(), pi))) == std::set<std::string>{"top"});
  CHECK(standing(fixture::shape(turned(fixture::table(), Vec3::UnitY(), 0.5))).size() == 4);
}

TEST_CASE("what hangs or leans does not stand") {
  // A lamp: a heavy bulb above a narrow tip.
  std::vector<Named> lamp = {{"shade", box({0, 1, 0}, {0.6, 0.3, 0.6})},
                             {"bulb", box({0, 0.75, 0}, {0.05, 0.3, 0.05})}};
  CHECK(standing(fixture::shape(lamp)).empty());
  // A picture in its frame: a narrow edge below.
  std::vector<Named> picture = {{"picture", box({0, 0.5, 0}, {0.7, 1, 0.02})},
                                {"frame", box({0, 0.5, 0}, {0.8, 1.1, 0.03})}};
  CHECK(standing(fixture::shape(picture)).empty());
  // A table of which one end has no legs.
  std::vector<Named> half = fixture::table();
  std::erase_if(half, [](const Named& part) { return part.name != "top" && part.mesh.positions[0].x() < 0; });
  REQUIRE(half.size() == 3);
  CHECK(standing(fixture::shape(half)).empty());
}

TEST_CASE("feet that are a little short stand, shelves above the floor do not") {
  std::vector<Named> parts = fixture::table();
  for (Vec3& p : parts[1].mesh.positions) p.y() += p.y() < 0.1 ? 0.004 : 0;
  parts.push_back({"shelf", box({0, 0.05, 0}, {1.1, 0.02, 0.7})});
  CHECK(standing(fixture::shape(parts)) == four_legs);
}

TEST_CASE("a group stands where its instances do; they do once it is dissolved") {
  const Shape shape = fixture::shape({{"board", box({0, 0.55, 0}, {1, 0.1, 0.4})},
                                      {"trestle", box({-0.4, 0.25, 0}, {0.1, 0.5, 0.4})},
                                      {"trestle", box({0, 0.25, 0}, {0.1, 0.5, 0.4})},
                                      {"trestle", box({0.4, 0.25, 0}, {0.1, 0.5, 0.4})}});
  REQUIRE(fixture::count(shape, RelationKind::translation) == 1);
  CHECK(standing(shape) == std::set<std::string>{"trestle_group"});
  CHECK(standing(shape, false).size() == 4);
  const Ground& ground = ground_of(shape, "trestle_group");
  REQUIRE(ground.local.size() == 4);
  for (const Vec3& local : ground.local) CHECK(local.cwiseAbs() == Vec3::Ones());
}

TEST_CASE("a roller stands on a narrow strip") {
  const auto prism = [](int sides, double radius, double length) {
    fixture::Mesh mesh;
    for (int k = 0; k < sides; ++k) {
      const double angle = 2 * pi * k / sides - pi / 2;
      for (const double x : {-length / 2, length / 2}) {
        mesh.positions.push_back({x, radius + radius * std::sin(angle), radius * std::cos(angle)});
      }
      const auto i = static_cast<std::uint32_t>(2 * k), j = static_cast<std::uint32_t>(2 * ((k + 1) % sides));
      mesh.triangles.push_back({i, j, i + 1});
      mesh.triangles.push_back({i + 1, j, j + 1});
    }
    return mesh;
  };
  std::vector<Named> cart = {{"bed", box({0, 0.3, 0}, {1, 0.2, 1})}};
  for (const double z : {-0.4, 0.4}) {
    cart.push_back({"roller", prism(8, 0.1, 0.8)});
    for (Vec3& p : cart.back().mesh.positions) p.z() += z;
  }
  const Shape shape = fixture::shape(cart);
  REQUIRE(standing(shape).size() == 2);
  const Ground& ground = ground_of(shape, *standing(shape).begin());
  REQUIRE(ground.points.size() == 4);  // the surface 0.002 above the line is a narrow strip
  double width = 1;
  for (std::size_t i = 1; i < 4; ++i) width = std::min(width, (ground.points[0] - ground.points[i]).norm());
  CHECK(width < 0.02);
}

TEST_CASE("what moves off the floor is reported, certified, and by the independent check alike") {
  const Shape shape = fixture::shape(fixture::table());
  const auto report_of = [&](const Statement& statement, const std::set<std::string>& disabled = {}) {
    Program program = hand::program(shape, {statement});
    program.layers[0].relations = prove_relations(shape, program, 0, disabled);
    const CheckReport checked = check_program(shape, program);
    CHECK(checked.findings.empty());
    for (const RelationReport& report : program.layers[0].relations) {
      const RelationIndex r = *shape.find_relation(report.id);
      if (shape.relations[r].kind == RelationKind::ground) return report;
    }
    FAIL("no ground relation is reported");
    return RelationReport{};
  };
  const RelationReport lifted = report_of(hand::statement(Op::translate, "leg_front_left", Vec3::UnitY(), "x1"));
  CHECK(lifted.status == RelationStatus::broken);
  CHECK(lifted.proof == Proof::certified);
  CHECK(lifted.worst == doctest::Approx(0.35).epsilon(0.01));
  const RelationReport slid = report_of(hand::statement(Op::translate, "leg_front_left", Vec3::UnitX(), "x1"));
  CHECK(slid.status == RelationStatus::held);
  CHECK(slid.worst < 1e-9);
  // The floor does not move, so the narrower tolerance counts although the only part is edited.
  CHECK(report_of(hand::statement(Op::translate, "leg_front_left", Vec3::UnitY(), "0.1*x1")).status ==
        RelationStatus::broken);
  const std::string id = lifted.id;
  for (const std::string& key : {id, std::string("kind:ground")}) {
    CHECK(report_of(hand::statement(Op::translate, "leg_front_left", Vec3::UnitY(), "x1"), {key}).status ==
          RelationStatus::disabled);
  }
}

TEST_CASE("what stands is told in words, but not in those that prompts are made of") {
  const Shape shape = fixture::shape(fixture::table());
  CHECK(describe(shape).find("floor") == std::string::npos);
  CHECK(describe_ground(shape) ==
        "On the floor stand (relation): leg_front_left (g1), leg_front_right (g2), leg_back_left (g3), leg_back_right "
        "(g4).\n");
  CHECK(describe(shape, *shape.find_relation("g1")) == "leg_front_left stands on the floor");
}
