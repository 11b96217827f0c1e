// Plain requests: what is moved, opened or made larger changes what they name, and not what it touches.
#include <doctest/doctest.h>

#include <set>

#include "core/infer/plain_facts.h"
#include "tests/core/plain_measure.h"
#include "tests/core/shape_fixture.h"

using namespace parsel;
using namespace parsel::test;

namespace {

using Ids = std::set<std::string>;

/// The parts and groups whose corners are elsewhere at 0.1 of the slider; a word that says why not, when it is not sure.
Ids changed(const Shape& shape, const std::string& request) {
  const auto reading = read_plainly(shape, {request, {}});
  REQUIRE(reading.ok());
  if (!reading->sure) return {"unsure: " + reading->reason};
  const Result<Propagation> found = propagate(shape, edit_of(shape, *reading));
  REQUIRE(found.ok());
  const State state = Evaluator(found->program, shape)({0.1});
  Ids ids;
  for (const PartIndex p : shape.parts.indices()) {
    const Part& part = shape.parts[p];
    const bool is_there = (state.parts[p] - part.hexahedron.corners).cwiseAbs().maxCoeff() < 1e-9;
    if (!is_there) ids.insert(part.id);
  }
  for (const Part& group : shape.parts) {  // a group speaks for its instances
    if (ids.count(group.id) == 0) continue;
    for (const PartIndex member : group.members) ids.erase(shape.parts[member].id);
  }
  return ids;
}

Ids changed(const char* model, const std::string& request) {
  return changed(gallery_shape(model), request);
}

fixture::Named box(const char* name, const Vec3& low, const Vec3& high) {
  return {name, fixture::box((low + high) / 2, high - low)};
}

Shape arm_lamp() {
  return fixture::shape(
      {box("base", {-0.15, 0, -0.15}, {0.15, 0.03, 0.15}), box("pole", {-0.015, 0.03, -0.015}, {0.015, 1.2, 0.015}),
       box("arm", {-0.015, 1.2, -0.012}, {0.45, 1.224, 0.012}), box("shade", {0.31, 0.95, -0.12}, {0.55, 1.2, 0.12}),
       box("bulb", {0.40, 1.05, -0.03}, {0.46, 1.2, 0.03})});
}

Shape wardrobe() {
  return fixture::shape(
      {box("side_l", {0.49, 0, -0.3}, {0.51, 2, 0.3}), box("side_r", {-0.51, 0, -0.3}, {-0.49, 2, 0.3}),
       box("top", {-0.51, 2, -0.3}, {0.51, 2.02, 0.3}), box("bottom", {-0.49, 0.05, -0.3}, {0.49, 0.07, 0.3}),
       box("leftdoor", {0.001, 0.07, 0.3}, {0.499, 2, 0.32}), box("Right door", {-0.499, 0.07, 0.3}, {-0.001, 2, 0.32}),
       box("door frame", {-0.51, 2.02, 0.28}, {0.51, 2.08, 0.3}),
       box("handle_l", {0.03, 0.95, 0.32}, {0.05, 1.1, 0.34}), box("handle_r", {-0.05, 0.95, 0.32}, {-0.03, 1.1, 0.34}),
       box("shelf", {-0.49, 1, -0.28}, {0.49, 1.02, 0.28}), box("drawer", {-0.48, 0.07, -0.27}, {0.48, 0.3, 0.29})});
}

}  // namespace

TEST_CASE("what is moved slides along what it touches, and takes along what it carries") {
  CHECK(changed("bird_house", "move the entrance down") == Ids{"entrance"});
  CHECK(changed("bar_stool", "lower the foot ring") == Ids{"foot_ring", "spoke_group"});
  CHECK(changed("bed", "raise the headboard") == Ids{"headboard"});
  CHECK(changed(wardrobe(), "move the shelf up") == Ids{"shelf"});
}

TEST_CASE("what is opened goes with its handle, and leaves the rest where it is") {
  CHECK(changed("desk", "pull out the top drawer") == Ids{"drawer_top", "handle_top"});
  CHECK(changed("cabinet", "open the left door") == Ids{"door_left", "handle_left"});
  const Shape shape = wardrobe();
  CHECK(changed(shape, "drawer out") == Ids{"drawer"});
  const Ids open = changed(shape, "open the doors");
  CHECK(open.size() == 4);
  CHECK(open.count("shelf") == 0);
  CHECK(open.count("door_frame") == 0);
}

TEST_CASE("what is made taller or larger leaves what is beside and inside it") {
  CHECK(changed("armchair", "raise the armrests") == Ids{"arm_left", "arm_right"});
  CHECK(changed("armchair", "make only the left arm higher") == Ids{"arm_left"});
  CHECK(changed("floor_lamp", "bigger shade") == Ids{"shade"});
  CHECK(changed(arm_lamp(), "bigger shade") == Ids{"shade"});
}

TEST_CASE("an arm gets longer away from where it is held") {
  const Ids ids = changed(arm_lamp(), "make the arm longer");
  CHECK(ids.count("arm") == 1);
  CHECK(ids.count("shade") == 1);
  CHECK(ids.count("pole") == 0);
}

TEST_CASE("what stands on the floor is not carried: a table grows about its middle, whatever the number of its legs") {
  const Shape table = fixture::shape(
      {box("table", {-0.6, 0.68, -0.25}, {0.6, 0.75, 0.25}), box("leg", {0.5, 0, 0.15}, {0.6, 0.7, 0.25}),
       box("leg", {-0.6, 0, 0.15}, {-0.5, 0.7, 0.25}), box("leg", {0.5, 0, -0.25}, {0.6, 0.7, -0.15}),
       box("leg", {-0.6, 0, -0.25}, {-0.5, 0.7, -0.15})});
  const auto reading = read_plainly(table, {"longer table", {}});
  REQUIRE((reading.ok() && reading->sure));
  CHECK(reading->words.front() == "widen table about its centre, left and right");
  const PartIndex top = *table.find_part("table");
  const ShapeFacts facts(table);
  CHECK(facts.carried_by({top}).empty());
  CHECK(facts.held_end(top, 0) == 0);
}

TEST_CASE("a wider shade has its bulb as it propagates, a bigger one leaves it") {
  CHECK(changed("floor_lamp", "use a wider shade") == Ids{"shade", "bulb"});
}

TEST_CASE("a door that gets wider leaves its wall, a column that gets thinner its foot and its top") {
  CHECK(changed("windmill", "make the door wider") == Ids{"door"});
  CHECK(changed("round_table", "make the lazy susan smaller") == Ids{"lazy_susan"});
  const Shape table = fixture::shape({box("base", {-0.2, 0, -0.2}, {0.2, 0.06, 0.2}),
                                      box("column", {-0.03, 0.05, -0.03}, {0.03, 0.7, 0.03}),
                                      box("top", {-0.4, 0.7, -0.4}, {0.4, 0.73, 0.4})});
  CHECK(changed(table, "column half as thick") == Ids{"column"});
  CHECK(changed(table, "wider base") == Ids{"base"});
}

TEST_CASE("supports that are moved apart leave the planks, unless that is how the bench gets longer") {
  CHECK(changed("bench", "make the bench longer by moving its supports apart").count("plank_group") == 1);
}

TEST_CASE("armrests on a seat grow, and the bench stays") {
  const Shape bench = fixture::shape(
      {box("seat", {-0.7, 0.4, -0.25}, {0.7, 0.45, 0.25}), box("leg_1", {0.57, 0, 0.17}, {0.63, 0.4, 0.23}),
       box("leg_2", {-0.63, 0, 0.17}, {-0.57, 0.4, 0.23}), box("leg_3", {0.57, 0, -0.23}, {0.63, 0.4, -0.17}),
       box("leg_4", {-0.63, 0, -0.23}, {-0.57, 0.4, -0.17}), box("backrest", {-0.7, 0.45, -0.25}, {0.7, 0.9, -0.21}),
       box("armrest_left", {0.62, 0.45, -0.21}, {0.7, 0.65, 0.25}),
       box("armrest_right", {-0.7, 0.45, -0.21}, {-0.62, 0.65, 0.25})});
  CHECK(changed(bench, "raise the armrests") == Ids{"armrest_left", "armrest_right"});
}

TEST_CASE("labels in the plural, with glued sides, or of what the whole is called name parts as well") {
  const auto words = [](const Shape& shape, const char* request) {
    const auto reading = read_plainly(shape, {request, {}});
    REQUIRE(reading.ok());
    return reading->sure ? reading->words.front() : "unsure: " + reading->reason;
  };
  const Shape table = fixture::shape(
      {box("table", {-0.6, 0.7, -0.3}, {0.6, 0.75, 0.3}), box("rightleg", {-0.6, 0, 0.25}, {-0.55, 0.7, 0.3}),
       box("leftleg", {0.55, 0, 0.25}, {0.6, 0.7, 0.3}), box("rightbackleg", {-0.6, 0, -0.3}, {-0.55, 0.7, -0.25}),
       box("leftbackleg", {0.55, 0, -0.3}, {0.6, 0.7, -0.25}),
       box("legfrontleft", {-0.55, 0.2, -0.25}, {0.55, 0.22, 0.25})});
  CHECK(words(table, "make the table top thicker").find("table") != std::string::npos);
  const Ids longer = changed(table, "longer legs");
  CHECK(longer.count("rightleg") == 1);
  CHECK(longer.count("leftbackleg") == 1);
  const Shape bench = fixture::shape(
      {box("Bench Arms", {0.5, 0.4, -0.2}, {0.6, 0.7, 0.2}), box("Bench Arms", {-0.6, 0.4, -0.2}, {-0.5, 0.7, 0.2}),
       box("centre", {-0.1, 0, -0.2}, {0.1, 0.3, 0.2}), box("seat", {-0.6, 0.3, -0.2}, {0.6, 0.4, 0.2})});
  CHECK(words(bench, "higher armrests").find("bench arms") != std::string::npos);
  const Shape boxes =
      fixture::shape({box("box", {-0.2, 0, -0.1}, {0.2, 0.3, 0.1}), box("lid", {-0.2, 0.3, -0.1}, {0.2, 0.32, 0.1})});
  CHECK(words(boxes, "wider boxes") == "widen box about its centre, left and right");
  CHECK(words(bench, "make the centre panel wider") == "widen centre about its centre, left and right");
}
