#include "core/prove/reach.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "box_shapes.h"
#include "core/base/tolerance.h"
#include "core/check/check.h"
#include "core/edit/evaluate.h"
#include "core/propagate/propagate.h"
#include "core/prove/clearance.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;
using nlohmann::json;

namespace {

SliderReach reach(const Shape& shape, const Program& program, double low, double high) {
  return reach_of_layer(shape, program, 0, {}, tau, low, high);
}

const RelationReport& report_of(const std::vector<RelationReport>& reports, const std::string& id) {
  const auto found = std::find_if(reports.begin(), reports.end(), [&](const RelationReport& r) { return r.id == id; });
  REQUIRE(found != reports.end());
  return *found;
}

Propagation run(const Shape& shape, const json& seed) {
  const auto request = edit_request_from_json({{"seed", json::array({seed})}});
  if (!request.ok()) FAIL(request.error().message());
  auto found = propagate(shape, *request);
  if (!found.ok()) FAIL(found.error().message());
  const CheckReport checked = check_program(shape, found->program, to_json(found->trace), 0);
  for (const Finding& finding : checked.findings) FAIL_CHECK(finding.place << ": " << finding.text);
  return std::move(found.value());
}

void check_certified(const Propagation& found) {
  for (const RelationReport& report : found.program.layers[0].relations) {
    CAPTURE(report.id);
    CHECK(report.status == RelationStatus::held);
    CHECK(report.proof == Proof::certified);
  }
}

double extent(const Corners& corners, int axis) {
  return corners.col(axis).maxCoeff() - corners.col(axis).minCoeff();
}

/// Everything of hand::chair() goes up by x1, but leg_left by the amount given.
Program raised(const Shape& shape, const std::string& leg) {
  std::vector<Statement> statements;
  for (const char* part : {"seat", "leg_right", "back", "handle"})
    statements.push_back(statement(Op::translate, part, Vec3::UnitY(), "x1"));
  statements.push_back(statement(Op::translate, "leg_left", Vec3::UnitY(), leg));
  return hand::program(shape, statements);
}

}  // namespace

TEST_CASE("a slider ends where a joint that holds begins to come apart") {
  const Shape shape = hand::chair();
  const Program drifting = raised(shape, "x1+0.02*x1^3");
  const SliderReach found = reach(shape, drifting, -2, 2);
  CHECK(found.range.max == doctest::Approx(std::cbrt(clean_drift / 0.02)).epsilon(0.01));
  CHECK(found.range.max < std::cbrt(clean_drift / 0.02));
  CHECK(found.range.min == doctest::Approx(-found.range.max).epsilon(1e-3));
  CHECK(found.range.max_reason.find("leg_left") != std::string::npos);
  CHECK(report_of(found.relations, "a1").status == RelationStatus::held);
  CHECK(report_of(found.relations, "a1").proof == Proof::certified);

  SUBCASE("what is exact goes all the way") {
    const SliderReach all_the_way = reach(shape, raised(shape, "x1"), -2, 2);
    CHECK(all_the_way.range.min == -2);
    CHECK(all_the_way.range.max == 2);
    CHECK(all_the_way.range.max_reason == "limit");
  }
  SUBCASE("what is off by more already goes no farther where it would get worse") {
    // 0.035 at 0.35, which two parts that move may be off by; it gets no worse downwards.
    const SliderReach inexact = reach(shape, raised(shape, "x1+0.05*(x1+abs(x1))"), -2, 2);
    CHECK(report_of(inexact.relations, "a1").status == RelationStatus::held);
    CHECK(inexact.range.min == -2);
    // Upwards the leg goes into the seat, by a tenth of how far the slider goes.
    CHECK(inexact.range.max == doctest::Approx(seen_depth / 0.1).epsilon(1e-2));
    CHECK(inexact.range.max_reason == "leg_left and seat would run into each other");
  }
  SUBCASE("what is broken at 0.35 ends nothing") {
    const SliderReach torn = reach(shape, raised(shape, "2*x1"), -2, 2);
    CHECK(report_of(torn.relations, "a1").status == RelationStatus::broken);
    CHECK(torn.range.min == -2);
    // Upwards the leg goes into the seat.
    CHECK(torn.range.max == doctest::Approx(seen_depth).epsilon(1e-1));
    CHECK(torn.range.max_reason == "leg_left and seat would run into each other");
  }
}

TEST_CASE("a slider ends where parts run into each other that did not touch") {
  test::BoxShape s;
  s.box("block", {0, 0, 0}, {0.1, 0.1, 0.1});
  s.box("wall", {0.7, 0, 0}, {0.05, 0.5, 0.5});
  const Shape shape = s.shape();
  // 0.55 of room, and what nobody sees: sides of 0.2 by 0.2 meet.
  const double room = 0.55 + seen_volume / (0.2 * 0.2);
  const Program pushed = hand::program(shape, {statement(Op::translate, "block", Vec3::UnitX(), "x1")});
  const SliderReach found = reach(shape, pushed, -1, 1);
  CHECK(found.range.max == doctest::Approx(room).epsilon(1e-3));
  CHECK(found.range.max_reason == "block and wall would run into each other");
  CHECK(found.range.min == -1);
  // What touches already goes into it a little deeper until it is seen.
  test::BoxShape t;
  t.box("block", {0.55, 0, 0}, {0.1, 0.1, 0.1});
  t.box("wall", {0.7, 0, 0}, {0.05, 0.5, 0.5});
  const Shape touching = t.shape();
  const Program pressed = hand::program(touching, {statement(Op::translate, "block", Vec3::UnitX(), "0.02*x1")});
  CHECK(reach(touching, pressed, -1, 1).range.max == doctest::Approx(seen_depth / 0.02).epsilon(1e-3));
  // Twice as fast it ends half as far.
  const Program rammed = hand::program(shape, {statement(Op::translate, "block", Vec3::UnitX(), "2*x1")});
  CHECK(reach(shape, rammed, -1, 1).range.max == doctest::Approx(room / 2).epsilon(1e-3));
  CHECK(reach(shape, rammed, -1, 1).range.min == -1);
  // What is in the wall early ends there as well, where there is another side to go to.
  const Program shot = hand::program(shape, {statement(Op::translate, "block", Vec3::UnitX(), "6*x1")});
  CHECK(reach(shape, shot, -1, 1).range.max == doctest::Approx(room / 6).epsilon(1e-2));
  CHECK(reach(shape, shot, -1, 1).range.max_reason == "block and wall would run into each other");
  CHECK(reach(shape, shot, -1, 1).range.min < -tau);
  // Between two walls it may go on, but no farther than the search looked.
  s.box("other_wall", {-0.7, 0, 0}, {0.05, 0.5, 0.5});
  const Shape between = s.shape();
  const SliderReach stuck = reach(between, hand::program(between, {shot.layers[0].statements[0]}), -1, 1);
  CHECK(stuck.range.min == -tau);
  CHECK(stuck.range.max == tau);
  CHECK(stuck.range.min_reason == "block and other_wall would run into each other");
}

TEST_CASE("a slider ends where what slides comes off, and not where a part is pulled off") {
  test::BoxShape s;
  const PartIndex stile = s.box("stile", {0, 0, 0}, {0.02, 0.5, 0.02});
  const PartIndex rung = s.box("rung", {0.12, 0.2, 0}, {0.1, 0.02, 0.02});
  s.attach(stile, rung, {{0.02, 0.2, 0}});
  const Shape shape = s.shape();
  const auto moved = [&](const Vec3& direction) {
    return reach(shape, hand::program(shape, {statement(Op::translate, "rung", direction, "x1")}), -1, 1).range;
  };
  // Upwards its lower edge, at 0.18, leaves the stile's upper end at 0.5; downwards its upper one, at 0.22.
  const Range along = moved(Vec3::UnitY());
  CHECK(along.max == doctest::Approx(0.32 + seen_gap).epsilon(1e-3));
  CHECK(along.max_reason == "rung and stile would come apart");
  CHECK(along.min == doctest::Approx(-0.72 - seen_gap).epsilon(1e-3));
  CHECK(moved(Vec3::UnitX()).max == 1);
}

TEST_CASE("surfaces that part within their boxes end a slider, and those that slide do not") {
  test::BoxShape s;
  const PartIndex bowl = s.box("bowl", {0, 0, 0}, {0.4, 0.2, 0.4});
  const PartIndex ball = s.box("ball", {0, 0.05, 0}, {0.1, 0.1, 0.1});
  s.attach(bowl, ball, {{0, -0.05, 0}});
  Shape shape = s.shape();
  ContactPatch patch;  // the ball lies on the bowl's ground, deep in its box
  patch.centre = Vec3(0, -0.05, 0);
  patch.half_sides = {Vec3(0.05, 0, 0), Vec3(0, 0, 0.05)};
  for (std::size_t k = 0; k < 4; ++k) {
    const Vec3 corner = patch.centre + corner_sign(static_cast<int>(k), 0) * patch.half_sides[0] +
                        corner_sign(static_cast<int>(k), 1) * patch.half_sides[1];
    patch.local_a[k] = shape.parts[bowl].hexahedron.local(corner);
    patch.local_b[k] = shape.parts[ball].hexahedron.local(corner);
  }
  std::get<Attachment>(shape.relations[RelationIndex(0)].detail).patch = patch;
  const auto moved = [&](const Vec3& direction, const std::string& amount) {
    return reach(shape, hand::program(shape, {statement(Op::translate, "ball", direction, amount)}), -1, 1).range;
  };
  // 0.05 x1 is at seen_gap at 0.28.
  CHECK(moved(Vec3::UnitY(), "0.05*x1").max == doctest::Approx(seen_gap / 0.05).epsilon(1e-3));
  CHECK(moved(Vec3::UnitX(), "0.05*x1").max == 1);
}

TEST_CASE("a chair becomes half or twice as wide, with all it holds") {
  const Shape shape = test::chair();
  const Propagation found = run(shape, {{"op", "scale_1d"},
                                        {"part", "seat"},
                                        {"origin", {{"part", "seat"}, {"at", {0, 0, 0}}}},
                                        {"direction", {1, 0, 0}},
                                        {"amount", "x"}});
  const Parameter& slider = found.program.layers[0].parameter;
  CHECK(slider.min == -0.5);
  CHECK(slider.max == 1);
  check_certified(found);
  const Evaluator evaluate(found.program, shape);
  for (const double x : {-0.5, 0.4, 1.0}) {
    const State state = evaluate({x});
    CHECK(extent(state.parts[*shape.find_part("seat")], 0) == doctest::Approx(0.8 * (1 + x)));
    CHECK(extent(state.parts[*shape.find_part("back")], 0) == doctest::Approx(0.8 * (1 + x)));
    const Corners& leg = state.parts[*shape.find_part("leg_front_left")];
    CHECK(leg.col(0).mean() == doctest::Approx(0.3 * (1 + x)));
    CHECK(extent(leg, 0) == doctest::Approx(0.06));
  }
}

TEST_CASE("a door opens to 110 degrees, its body stays, and it does not open inwards") {
  const Shape shape = test::cabinet();
  const Propagation found = run(shape, {{"op", "rotate"},
                                        {"part", "door"},
                                        {"origin", {{"part", "door"}, {"at", {-1, 0, -1}}}},
                                        {"axis", {0, 1, 0}},
                                        {"amount", "-x"}});
  const Parameter& slider = found.program.layers[0].parameter;
  const double open = 110 * pi / 180;
  CHECK(slider.max == doctest::Approx(open).epsilon(1e-3));
  CHECK(slider.min > -0.02);
  check_certified(found);
  const State state = Evaluator(found.program, shape)({slider.max});
  const PartIndex body = *shape.find_part("body"), door = *shape.find_part("door");
  CHECK((state.parts[body] - shape.parts[body].hexahedron.corners).cwiseAbs().maxCoeff() < 1e-12);
  // Its free inner edge, at (0.4, 0.3) at rest, from the hinge at (-0.4, 0.3) in x and z.
  CHECK(state.parts[door](1, 0) == doctest::Approx(-0.4 + 0.8 * std::cos(slider.max)));
  CHECK(state.parts[door](1, 2) == doctest::Approx(0.3 + 0.8 * std::sin(slider.max)));
}

TEST_CASE("the thickness of a thin panel changes by what can be seen") {
  test::BoxShape s;
  const PartIndex panel = s.box("panel", {0, 0, 0}, {0.6, 0.01, 0.4});
  for (const int x : {1, -1}) {
    const PartIndex side = s.box(x > 0 ? "left" : "right", {0.57 * x, -0.31, 0}, {0.03, 0.3, 0.4});
    s.attach(panel, side, {{0.57 * x, -0.01, 0.4}, {0.57 * x, -0.01, -0.4}});
  }
  const Shape shape = s.shape();
  const Propagation found = run(shape, {{"op", "scale_1d"},
                                        {"part", "panel"},
                                        {"origin", {{"part", "panel"}, {"at", {0, -1, 0}}}},
                                        {"direction", {0, 1, 0}},
                                        {"amount", "x"}});
  const Parameter& slider = found.program.layers[0].parameter;
  const State state = Evaluator(found.program, shape)({slider.max});
  // 0.1 half-diagonals are some twenty pixels of a picture; ±0.35 of 0.02 were two.
  CHECK(extent(state.parts[panel], 1) == doctest::Approx(0.1).epsilon(1e-3));
  check_certified(found);
}

TEST_CASE("the number of a long row doubles") {
  test::BoxShape s;
  const PartIndex rail = s.box("rail", {0, 0.55, 0}, {0.8, 0.05, 0.03});
  const PartIndex row = s.row("picket", 9, {-0.72, 0, 0}, {0.72, 0, 0}, {0.02, 0.5, 0.02}, 0);
  s.attach(rail, row, {{-0.74, 0.5, 0}, {0.74, 0.5, 0}});
  const Shape shape = s.shape();
  const Propagation found = run(shape, {{"op", "change_count"}, {"relation", "t1"}, {"amount", "8*x"}});
  const Parameter& slider = found.program.layers[0].parameter;
  const Evaluator evaluate(found.program, shape);
  const RelationIndex t1 = *shape.find_relation("t1");
  CHECK(evaluate({slider.max}).groups[t1].instances.size() == 18);
  CHECK(evaluate({slider.min}).groups[t1].instances.size() == 5);
}

TEST_CASE("a joint that is given up ends no slider where its parts part, nor does one of what goes along") {
  test::BoxShape s;
  const PartIndex frame = s.box("frame", {-0.53, 0, 0}, {0.03, 0.5, 0.02});
  const PartIndex door = s.box("door", {0, 0, 0}, {0.5, 0.5, 0.02});
  const PartIndex plate = s.box("plate", {-0.47, 0, 0.03}, {0.03, 0.1, 0.01});
  s.attach(frame, door, {{-0.5, 0, 0}});
  s.attach(door, plate, {{-0.47, 0, 0.02}});
  s.attach(frame, plate, {{-0.5, 0, 0.02}});
  const Shape shape = s.shape();
  // Along the frame they slide, and come off at its end.
  const Program lifted = hand::program(shape, {statement(Op::translate, "door", Vec3::UnitY(), "x1"),
                                               statement(Op::translate, "plate", Vec3::UnitY(), "x1")});
  const Range kept = reach(shape, lifted, -2, 2).range;
  CHECK(kept.max == doctest::Approx(0.6 + seen_gap).epsilon(1e-3));
  CHECK(kept.max_reason == "frame and plate would come apart");
  const Range given_up = reach_of_layer(shape, lifted, 0, {"a1"}, tau, -2, 2).range;
  CHECK(given_up.max == 2);
  CHECK(given_up.min == -2);
  // A plate that goes with neither ends it.
  const Program slower = hand::program(shape, {statement(Op::translate, "door", Vec3::UnitY(), "x1"),
                                               statement(Op::translate, "plate", Vec3::UnitY(), "0.25*x1")});
  const Range slid = reach_of_layer(shape, slower, 0, {"a1"}, tau, -2, 2).range;
  CHECK(slid.max == doctest::Approx((0.6 + seen_gap) / 0.75).epsilon(1e-3));
  CHECK(slid.max_reason == "door and plate would come apart");
}
