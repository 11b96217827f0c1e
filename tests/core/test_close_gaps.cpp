// What an edit pulls apart is closed by the part that can grow, and by nothing else; what cannot is left and named.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/export/apply.h"
#include "core/gallery/gallery.h"
#include "core/shape/abstraction.h"
#include "tests/core/box_shapes.h"

using namespace parsel;

namespace {

/// A top on two legs, with a rail between them, all touching.
struct Table {
  test::BoxShape boxes;
  PartIndex top = boxes.box("top", {0, 0.5, 0}, {0.6, 0.05, 0.3});
  PartIndex left = boxes.box("leg_left", {-0.5, 0.05, 0}, {0.05, 0.4, 0.05});
  PartIndex right = boxes.box("leg_right", {0.5, 0.05, 0}, {0.05, 0.4, 0.05});
  PartIndex rail = boxes.box("rail", {0, 0, 0}, {0.45, 0.05, 0.02});
  Shape shape;
  State state;

  Table() {
    boxes.attach(top, left, {{-0.5, 0.45, 0}});
    boxes.attach(top, right, {{0.5, 0.45, 0}});
    boxes.attach(rail, left, {{-0.45, 0, 0}});
    boxes.attach(rail, right, {{0.45, 0, 0}});
    shape = boxes.shape();
    state = rest_state(shape);
  }
  void move(PartIndex part, const Vec3& by) { state.parts[part].rowwise() += by.transpose(); }
  Vec3 low(PartIndex part) const { return state.parts[part].colwise().minCoeff(); }
  Vec3 high(PartIndex part) const { return state.parts[part].colwise().maxCoeff(); }
};

}  // namespace

TEST_CASE("gaps: none at rest, and none where a part slides along another") {
  Table table;
  CHECK(find_gaps(table.shape, table.state).empty());
  table.move(table.top, {0.02, 0, 0.05});
  CHECK(find_gaps(table.shape, table.state).empty());
  const State before = table.state;
  CHECK(close_gaps(table.shape, table.state).extensions.empty());
  for (const PartIndex p : table.shape.parts.indices()) CHECK(table.state.parts[p] == before.parts[p]);
}

TEST_CASE("gaps: below a top that was raised the legs grow, at their upper ends alone") {
  Table table;
  table.move(table.top, {0, 0.1, 0});
  const State before = table.state;
  const auto open = find_gaps(table.shape, table.state);
  REQUIRE(open.size() == 2);
  CHECK(open[0].width == doctest::Approx(0.1));
  const ClosedGaps closed = close_gaps(table.shape, table.state);
  CHECK(closed.before.size() == 2);
  CHECK(closed.left.empty());
  REQUIRE(closed.extensions.size() == 2);
  for (const Extension& made : closed.extensions) CHECK(made.length == doctest::Approx(0.1));
  CHECK(table.state.parts[table.top] == before.parts[table.top]);
  CHECK(table.state.parts[table.rail] == before.parts[table.rail]);
  for (const PartIndex leg : {table.left, table.right}) {
    CHECK(table.high(leg).y() == doctest::Approx(0.55));
    CHECK(table.low(leg).y() == doctest::Approx(-0.35));
    CHECK(table.high(leg).x() - table.low(leg).x() == doctest::Approx(0.1));
  }
  CHECK(find_gaps(table.shape, table.state).empty());
}

TEST_CASE("gaps: between legs that were moved apart the rail grows at both ends") {
  Table table;
  table.move(table.left, {-0.05, 0, 0});
  table.move(table.right, {0.05, 0, 0});
  const ClosedGaps closed = close_gaps(table.shape, table.state);
  CHECK(closed.left.empty());
  for (const Extension& made : closed.extensions) CHECK(made.part == table.rail);
  CHECK(table.low(table.rail).x() == doctest::Approx(-0.5));
  CHECK(table.high(table.rail).x() == doctest::Approx(0.5));
}

TEST_CASE("gaps: a leaning part grows along its own edges, and its face stays as it leans") {
  Table table;
  for (int k = 0; k < 8; ++k) {
    if (corner_sign(k, 1) > 0) table.state.parts[table.left](k, 0) += 0.08;  // its upper end, to the right
  }
  table.move(table.top, {0, 0.1, 0});
  const ClosedGaps closed = close_gaps(table.shape, table.state);
  CHECK(closed.left.empty());
  CHECK(table.high(table.left).y() == doctest::Approx(0.55));
  CHECK(table.high(table.left).x() == doctest::Approx(-0.45 + 0.08 * 0.9 / 0.8));
}

TEST_CASE("gaps: a part does not grow to more than twice its length, nor out of a joint, nor into another part") {
  Table table;
  table.move(table.top, {0, 1.2, 0});
  ClosedGaps closed = close_gaps(table.shape, table.state);
  CHECK(closed.extensions.empty());
  CHECK(closed.left.size() == 2);

  // What stands in the way of the one leg, a hair below the top that was raised.
  Table blocked;
  const PartIndex lamp = blocked.boxes.box("lamp", {-0.5, 0.5, 0.2}, {0.02, 0.04, 0.02});
  blocked.shape = blocked.boxes.shape();
  blocked.state = rest_state(blocked.shape);
  blocked.move(blocked.top, {0, 0.2, 0});
  blocked.move(lamp, {0, 0, -0.2});  // onto the leg's end
  closed = close_gaps(blocked.shape, blocked.state);
  REQUIRE(closed.left.size() == 1);
  const auto json = to_json(blocked.shape, closed);
  CHECK(json["gaps"] == 2);
  CHECK(json["closed"].size() == 1);
  CHECK(json["closed"][0]["part"] == "leg_right");
  CHECK(json["left"][0]["parts"] == nlohmann::json{"top", "leg_left"});
  CHECK(json["left"][0]["width"].get<double>() == doctest::Approx(0.2 * blocked.shape.frame.scale));
}

TEST_CASE("gaps: what has slid off altogether is left") {
  Table table;
  table.move(table.top, {1.5, 0.1, 0});
  const ClosedGaps closed = close_gaps(table.shape, table.state);
  CHECK(closed.extensions.empty());
  CHECK(closed.left.size() == 2);
}

TEST_CASE("gaps: a file whose gaps were closed is found joined again, with the same parts") {
  const auto asset = build(*find_gallery_model("dining_table"));
  REQUIRE(asset.ok());
  const auto model = abstract_shape(asset->glb, "dining_table");
  REQUIRE(model.ok());
  const Shape& shape = model->shape;
  const auto joints = [](const Shape& found) {
    return std::count_if(found.relations.begin(), found.relations.end(),
                         [](const Relation& relation) { return relation.is_attachment(); });
  };
  Program program;
  program.shape_name = shape.name;
  program.shape_sha256 = shape.sha256;
  Statement lift;  // the top alone: nothing follows it
  lift.op = Op::translate;
  lift.part = "node:0";
  lift.direction = Vec3(Vec3::UnitY());
  lift.amount = Amount::parameter("x1");
  program.layers.push_back({"Raise the top.", {"x1", 0, 0.2, 0}, {lift}, {}});
  REQUIRE(validate(program, shape).ok());
  ApplyOptions options;
  const auto torn = apply_program(asset->glb, shape, program, {0.1}, std::nullopt, options);
  options.repair = true;
  const auto closed = apply_program(asset->glb, shape, program, {0.1}, std::nullopt, options);
  REQUIRE(torn.ok());
  REQUIRE(closed.ok());
  CHECK(torn->gaps.before.empty());  // nobody has looked
  CHECK(closed->gaps.before.size() > 3);
  CHECK(closed->gaps.left.empty());
  const auto torn_again = abstract_shape(torn->glb, "torn"), closed_again = abstract_shape(closed->glb, "closed");
  REQUIRE(torn_again.ok());
  REQUIRE(closed_again.ok());
  CHECK(closed_again->shape.parts.size() == shape.parts.size());
  CHECK(joints(torn_again->shape) < joints(shape));
  CHECK(joints(closed_again->shape) == joints(shape));
}
