#include "core/propagate/alternatives.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "box_shapes.h"
#include "core/check/check.h"
#include "core/edit/evaluate.h"
#include "core/propagate/contact.h"
#include "core/propagate/propagate.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using nlohmann::json;

namespace {

Propagation run(const Shape& shape, const json& edit, bool alternatives = true) {
  const auto request = edit_request_from_json(edit);
  if (!request.ok()) FAIL(request.error().message());
  PropagateOptions options;
  options.alternatives = alternatives;
  auto found = propagate(shape, *request, options);
  if (!found.ok()) FAIL(found.error().message());
  const CheckReport checked = check_program(shape, found->program, to_json(found->trace), 0);
  for (const Finding& finding : checked.findings) FAIL_CHECK(finding.place << ": " << finding.text);
  return std::move(found.value());
}

json move(const std::string& part, const Vec3& direction) {
  return {{"op", "translate"},
          {"part", part},
          {"direction", {direction.x(), direction.y(), direction.z()}},
          {"amount", "x"}};
}

/// How far the farthest corner of a part is from where it was, with the slider at 0.2.
double moved(const Shape& shape, const Propagation& found, PartIndex part) {
  const State state = Evaluator(found.program, shape)({0.2});
  return (state.parts[part] - shape.parts[part].hexahedron.corners).cwiseAbs().maxCoeff();
}

/// The states in which a program leaves the relations of parts that stand on the floor.
std::set<RelationStatus> feet(const Shape& shape, const Propagation& found) {
  std::set<RelationStatus> states;
  for (const RelationReport& report : found.program.layers[0].relations) {
    if (shape.relations[*shape.find_relation(report.id)].kind == RelationKind::ground) states.insert(report.status);
  }
  return states;
}

}  // namespace

TEST_CASE("a seat that is raised stretches its legs and takes its back along; the feet stay on the floor") {
  const Shape shape = test::chair();
  const json edit = {{"seed", {move("seat", Vec3::UnitY())}}};
  const auto part = [&](const char* id) { return *shape.find_part(id); };
  const Propagation found = run(shape, edit);
  const State state = Evaluator(found.program, shape)({0.2});
  for (const char* leg : {"leg_front_left", "leg_front_right", "leg_back_left", "leg_back_right"}) {
    CHECK(state.parts[part(leg)].col(1).minCoeff() == doctest::Approx(-0.65));
    CHECK(state.parts[part(leg)].col(1).maxCoeff() == doctest::Approx(0.15));
  }
  CHECK(moved(shape, found, part("back")) == doctest::Approx(0.2));
  CHECK(feet(shape, found) == std::set{RelationStatus::held});

  SUBCASE("without them the whole chair leaves the floor") {
    const Propagation without = run(shape, edit, false);
    const State flying = Evaluator(without.program, shape)({0.2});
    CHECK(flying.parts[part("leg_front_left")].col(1).minCoeff() == doctest::Approx(-0.45));
    CHECK(feet(shape, without) == std::set{RelationStatus::broken});
  }
  SUBCASE("a floor that does not count is said to be disabled") {
    json free = edit;
    free["disabled"] = {"kind:ground"};
    CHECK(feet(shape, run(shape, free)) == std::set{RelationStatus::disabled});
  }
}

TEST_CASE("a drawer that is pulled comes out of its chest with its knob; the chest stays") {
  test::BoxShape s;
  const PartIndex left = s.box("side_left", {0.53, 0, 0}, {0.03, 0.5, 0.4});
  const PartIndex right = s.box("side_right", {-0.53, 0, 0}, {0.03, 0.5, 0.4});
  const PartIndex top = s.box("top", {0, 0.53, 0}, {0.56, 0.03, 0.4});
  const PartIndex drawer = s.box("drawer", {0, 0, 0}, {0.5, 0.2, 0.4});
  const PartIndex knob = s.box("knob", {0, 0, 0.43}, {0.04, 0.04, 0.03});
  s.attach(top, left, {{0.53, 0.5, -0.4}, {0.53, 0.5, 0.4}});
  s.attach(top, right, {{-0.53, 0.5, -0.4}, {-0.53, 0.5, 0.4}});
  s.attach(drawer, left, {{0.5, 0, -0.4}, {0.5, 0, 0.4}});
  s.attach(drawer, right, {{-0.5, 0, -0.4}, {-0.5, 0, 0.4}});
  s.attach(knob, drawer, {{0, 0, 0.4}});
  const Shape& shape = s.shape();
  const Propagation found = run(shape, {{"seed", {move("drawer", Vec3::UnitZ())}}});
  CHECK(moved(shape, found, drawer) == doctest::Approx(0.2));
  CHECK(moved(shape, found, knob) == doctest::Approx(0.2));
  for (const PartIndex part : {left, right, top}) CHECK(moved(shape, found, part) == 0);
}

TEST_CASE("a shelf that is raised slides between the walls of its bookcase, which stays on its legs") {
  test::BoxShape s;
  const PartIndex shelf = s.box("shelf", {0, 0.18, 0}, {0.6, 0.02, 0.3});
  const PartIndex base = s.box("base", {0, -0.34, 0}, {0.64, 0.02, 0.3});
  const PartIndex top = s.box("top", {0, 0.69, 0}, {0.64, 0.02, 0.3});
  std::vector<PartIndex> others = {base, top};
  for (const double side : {-1.0, 1.0}) {
    const std::string name = side < 0 ? "left" : "right";
    const PartIndex wall = s.box("wall_" + name, {side * 0.62, 0.175, 0}, {0.02, 0.495, 0.3});
    const PartIndex leg = s.box("leg_" + name, {side * 0.6, -0.53, 0}, {0.04, 0.17, 0.3});
    const auto line = [&](double x, double y) { return std::vector<Vec3>{{x, y, -0.3}, {x, y, 0.3}}; };
    s.attach(wall, shelf, line(side * 0.6, 0.18));
    s.attach(wall, base, line(side * 0.62, -0.32));
    s.attach(wall, top, line(side * 0.62, 0.67));
    s.attach(leg, base, line(side * 0.6, -0.36));
    s.stand(leg);
    others.insert(others.end(), {wall, leg});
  }
  const Shape& shape = s.shape();
  const Propagation found = run(shape, {{"seed", {move("shelf", Vec3::UnitY())}}});
  CHECK(moved(shape, found, shelf) == doctest::Approx(0.2));
  for (const PartIndex part : others) CHECK(moved(shape, found, part) == doctest::Approx(0));
  CHECK(found.program.layers[0].parameter.max < 0.49);  // it stops under the top
}

TEST_CASE("an amount that grows faster is the same edit") {
  const Shape shape = test::chair();
  const auto raised = [&](const char* amount) {
    json seed = move("seat", Vec3::UnitY());
    seed["amount"] = amount;
    return run(shape, {{"seed", {seed}}});
  };
  const Propagation plain = raised("x"), fast = raised("-3*x");
  const State expected = Evaluator(plain.program, shape)({0.3}), same = Evaluator(fast.program, shape)({-0.1});
  for (const PartIndex part : shape.parts.indices()) {
    CHECK((expected.parts[part] - same.parts[part]).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("one of the drawers on the front of a pedestal comes off it; the others, the pedestal and its top stay") {
  test::BoxShape s;
  const PartIndex pedestal = s.box("pedestal", {0, 0, 0}, {0.3, 0.4, 0.4});
  const PartIndex top = s.box("top", {0, 0.43, 0}, {0.35, 0.03, 0.45});
  s.stand(pedestal);
  s.attach(top, pedestal, {{-0.3, 0.4, 0}, {0.3, 0.4, 0}});
  const PartIndex row = s.row("drawer", 3, {0, -0.25, 0.41}, {0, 0.25, 0.41}, {0.25, 0.1, 0.01}, 1);
  const auto drawer = [&](int i) { return *s.shape().find_part("drawer_" + std::to_string(i)); };
  for (int i = 1; i <= 3; ++i) {
    const double y = 0.25 * (i - 2);
    s.attach(pedestal, drawer(i),
             {{-0.25, y - 0.1, 0.4}, {0.25, y - 0.1, 0.4}, {-0.25, y + 0.1, 0.4}, {0.25, y + 0.1, 0.4}});
  }
  s.attach(pedestal, row, {{-0.25, -0.35, 0.4}, {0.25, -0.35, 0.4}, {-0.25, 0.35, 0.4}, {0.25, 0.35, 0.4}});
  const Shape& shape = s.shape();
  const Propagation found = run(shape, {{"seed", {move("drawer_2", Vec3::UnitZ())}}});
  CHECK(moved(shape, found, drawer(2)) == doctest::Approx(0.2));
  for (const PartIndex part : {pedestal, top, drawer(1), drawer(3)}) CHECK(moved(shape, found, part) == 0);
  // Asked of the row, all come off or the pedestal grows with them.
  const Propagation all = run(shape, {{"seed", {move("drawers", Vec3::UnitZ())}}});
  for (int i = 1; i <= 3; ++i) CHECK(moved(shape, all, drawer(i)) == doctest::Approx(0.2));
}

TEST_CASE("a door opens on its hinges and takes its handle along; the cabinet and the other door stay") {
  test::BoxShape s;
  const PartIndex body = s.box("body", {0, 0, 0}, {0.4, 0.5, 0.2});
  const PartIndex left = s.box("door_left", {0.2, 0, 0.22}, {0.2, 0.5, 0.02});
  const PartIndex right = s.box("door_right", {-0.2, 0, 0.22}, {0.2, 0.5, 0.02});
  const PartIndex handle = s.box("handle", {0.04, 0, 0.25}, {0.01, 0.08, 0.01});
  s.stand(body);
  // The points lie in the middle of what the boxes have in common, not on the hinge.
  s.attach(body, left, {{0.2, -0.5, 0.2}, {0.2, 0.5, 0.2}});
  s.attach(body, right, {{-0.2, -0.5, 0.2}, {-0.2, 0.5, 0.2}});
  s.attach(handle, left, {{0.04, 0, 0.24}});
  const Shape& shape = s.shape();
  const auto opened = [&](const Vec3& hinge) {
    return run(shape, {{"seed",
                        {{{"op", "rotate"},
                          {"part", "door_left"},
                          {"origin", {hinge.x(), hinge.y(), hinge.z()}},
                          {"axis", {0, 1, 0}},
                          {"amount", "x"}}}}});
  };
  // On the outer edge behind, within the door, and in front of it.
  for (const double depth : {0.2, 0.22, 0.24}) {
    const Propagation found = opened({0.4, 0, depth});
    for (const PartIndex part : {body, right}) CHECK(moved(shape, found, part) == 0);
    const State state = Evaluator(found.program, shape)({0.3});
    const Vec3 arm = shape.parts[handle].hexahedron.point(Vec3::Zero()) - Vec3(0.4, 0, depth);
    const Vec3 at = state.parts[handle].colwise().mean().transpose();
    const Vec3 turned(std::cos(0.3) * arm.x() + std::sin(0.3) * arm.z(), arm.y(),
                      std::cos(0.3) * arm.z() - std::sin(0.3) * arm.x());
    CHECK((at - Vec3(0.4, 0, depth) - turned).norm() < 1e-6);
  }
}

TEST_CASE("what holds every relation and the floor is left as the greedy search found it") {
  const Shape shape = test::chair();
  const json wider = {{"op", "scale_1d"},
                      {"part", "seat"},
                      {"origin", {{"part", "seat"}, {"at", {0, 0, 0}}}},
                      {"direction", {1, 0, 0}},
                      {"amount", "x"}};
  const json edit = {{"seed", {wider}}};
  const Propagation with = run(shape, edit);
  const Propagation without = run(shape, edit, false);
  CHECK(to_json(with.program) == to_json(without.program));
}

TEST_CASE("a hint to move a part moves it as it is, and stretches nothing") {
  const Shape shape = test::chair();
  const PartIndex seat = *shape.find_part("seat");
  const json stretched = {{"op", "scale_1d"},
                          {"part", "back"},
                          {"origin", {{"part", "back"}, {"at", {0, 1, 0}}}},
                          {"direction", {0, 1, 0}},
                          {"amount", "x"}};
  const Propagation found = run(shape, {{"seed", {stretched}}, {"hints", {{"seat", "translate"}}}});
  const State state = Evaluator(found.program, shape)({0.2});
  const Corners& rest = shape.parts[seat].hexahedron.corners;
  CHECK(state.parts[seat].col(1).maxCoeff() - state.parts[seat].col(1).minCoeff() ==
        doctest::Approx(rest.col(1).maxCoeff() - rest.col(1).minCoeff()));
}

TEST_CASE("what one of four legs is asked to do all four do, however little it is") {
  const Shape shape = fixture::shape(fixture::table());
  std::vector<PartIndex> legs;
  for (const PartIndex p : shape.parts.indices()) {
    if (shape.parts[p].label == "leg" && !shape.parts[p].is_virtual()) legs.push_back(p);
  }
  REQUIRE(legs.size() == 4);
  const json thinner = {{"op", "scale_2d"},
                        {"part", shape.parts[legs[0]].id},
                        {"origin", {{"part", shape.parts[legs[0]].id}, {"at", {0, 0, 0}}}},
                        {"normal", {0, 1, 0}},
                        {"amount", "-x"}};
  const Propagation found = run(shape, {{"seed", {thinner}}});
  for (const PartIndex leg : legs) CHECK(moved(shape, found, leg) == doctest::Approx(moved(shape, found, legs[0])));
}

TEST_CASE("contacts: a box on another is across their common face, slides, comes off and enters") {
  const auto box = [](const Vec3& centre, const Vec3& half) {
    return make_box(centre, Mat3::Identity(), half).corners;
  };
  const Corners table = box({0, 0, 0}, {0.5, 0.1, 0.5}), cup = box({0, 0.2, 0}, {0.1, 0.1, 0.1});
  const auto contact = contact_of(cup, table);
  REQUIRE(contact.has_value());
  CHECK(contact->distance == doctest::Approx(0));
  const auto moved_by = [&](const Vec3& by) { return change_of(*contact, cup.rowwise() + by.transpose(), table); };
  CHECK(moved_by({0.3, 0, 0.1}).apart == doctest::Approx(0));
  CHECK(moved_by({0.3, 0, 0.1}).lost == doctest::Approx(0));
  CHECK(moved_by({0.5, 0, 0}).lost == doctest::Approx(0.5));
  CHECK(moved_by({0.7, 0, 0}).lost == doctest::Approx(1));
  CHECK(moved_by({0, 0.05, 0}).apart == doctest::Approx(0.05));
  CHECK(moved_by({0, -0.05, 0}).apart == doctest::Approx(-0.05));
  CHECK(!contact_of(table, box({0, 0, 0}, {0.4, 0.08, 0.4})).has_value());
}

TEST_CASE("contacts: a ring slides along its column until it comes off, and does not go aside") {
  test::BoxShape s;
  const PartIndex column = s.box("column", {0, 0, 0}, {0.1, 0.5, 0.1});
  const PartIndex ring = s.box("ring", {0, 0.1, 0}, {0.3, 0.05, 0.3});
  const PartIndex apart = s.box("apart", {0.35, 0.1, 0}, {0.05, 0.05, 0.05});
  const Shape shape = s.shape();
  const auto at = [&](PartIndex part) { return shape.parts[part].hexahedron.corners; };
  CHECK(!contact_of(at(column), at(ring)));
  CHECK(!passage_of(at(ring), at(apart)));
  for (const bool first : {true, false}) {
    CAPTURE(first);
    const PartIndex a = first ? column : ring, b = first ? ring : column;
    const auto passage = passage_of(at(a), at(b));
    REQUIRE(passage);
    CHECK(passage->first_passes == first);
    const auto moved = [&](const Vec3& by) {
      const Corners ring_now = at(ring).rowwise() + by.transpose();
      return first ? change_of(*passage, at(a), ring_now) : change_of(*passage, ring_now, at(b));
    };
    CHECK(moved({0, 0.3, 0}).apart == doctest::Approx(0).epsilon(1e-12));
    CHECK(moved({0, 0.3, 0}).lost == doctest::Approx(0).epsilon(1e-12));
    // Its lower edge is at 0.45, of a height of 0.1.
    CHECK(moved({0, 0.4, 0}).lost == doctest::Approx(0.5));
    CHECK(moved({0, 1, 0}).lost == 1);
    CHECK(moved({0.02, -0.3, 0}).apart == doctest::Approx(0.02));
  }
  // A thicker column goes into the ring.
  const auto passage = passage_of(at(column), at(ring));
  Corners thick = at(column);
  thick.col(0) *= 1.5;
  CHECK(change_of(*passage, thick, at(ring)).apart == doctest::Approx(0.05));
}

TEST_CASE("contacts: a lid turns on an edge of its chest, and not on an axis that is farther away than it is thick") {
  const Corners chest = make_box({0, 0, 0}, Mat3::Identity(), {0.5, 0.3, 0.4}).corners;
  const Corners lid = make_box({0, 0.32, 0}, Mat3::Identity(), {0.5, 0.02, 0.4}).corners;
  const auto contact = contact_of(lid, chest);
  REQUIRE(contact.has_value());
  const auto turned = [&](const Vec3& origin, double angle) {
    Mat3 turn = Mat3::Identity();
    turn << 1, 0, 0, 0, std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle);
    return Corners(((lid.rowwise() - origin.transpose()) * turn.transpose()).rowwise() + origin.transpose());
  };
  for (const double angle : {-0.2, -1.0, -1.9}) {
    CHECK(change_of(*contact, turned({0, 0.3, -0.4}, angle), chest).hinged);
    CHECK(change_of(*contact, turned({0, 0.33, -0.4}, angle), chest).hinged);
    CHECK(!change_of(*contact, turned({0, 0.3, -0.5}, angle), chest).hinged);
    CHECK(!change_of(*contact, turned({0, 0.3, 0}, angle), chest).hinged);
  }
  CHECK(!change_of(*contact, lid, chest).hinged);
  CHECK(!change_of(*contact, lid.rowwise() + Vec3(0.01, 0, 0).transpose(), chest).hinged);
}
