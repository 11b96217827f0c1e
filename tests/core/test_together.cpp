#include "core/prove/together.h"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

/// Layers of one parameter each, x1 and x2, over the same range.
Program stack(const Shape& shape, std::vector<Statement> first, std::vector<Statement> second, double min, double max) {
  Program program = hand::program(shape, std::move(first), min, max);
  Layer layer = hand::program(shape, std::move(second), min, max).layers[0];
  layer.parameter.name = "x2";
  program.layers.push_back(std::move(layer));
  REQUIRE_MESSAGE(validate(program, shape).ok(), validate(program, shape).error().message());
  return program;
}

Statement face(double side, const std::string& amount) {
  Statement moved = statement(Op::translate, "seat", {-side, 0, 0}, amount);
  moved.feature = {static_cast<int>(side), 0, 0};
  return moved;
}

/// Both sides of the seat, which is 0.8 wide, move inwards.
Program narrowing(const Shape& shape) {
  return stack(shape, {face(1, "x1")}, {face(-1, "x2")}, 0, 0.5);
}

/// Widens the seat about its middle, the legs at ±0.3 with it.
std::vector<Statement> widening(const std::string& x) {
  return {statement(Op::scale_1d, "seat", Vec3::UnitX(), x),
          statement(Op::translate, "leg_left", Vec3::UnitX(), "0.3*" + x),
          statement(Op::translate, "leg_right", Vec3::UnitX(), "-0.3*" + x)};
}

}  // namespace

TEST_CASE("sliders that are sound alone may turn a part inside out together") {
  const Shape shape = hand::chair();
  const Together together(shape, narrowing(shape));
  CHECK(together.fault({0, 0}).empty());
  CHECK(together.fault({0.5, 0}).empty());
  CHECK(together.fault({0, 0.5}).empty());
  CHECK(together.fault({0.37, 0.38}).empty());
  CHECK(together.fault({0.38, 0.39}) == "seat would collapse");  // less than 0.05 of 0.8 is left
  CHECK(together.fault({0.5, 0.5}) == "seat would turn inside out");
}

TEST_CASE("a relation that each slider keeps may break between them; one that a slider breaks is not missed") {
  const Shape shape = hand::chair();
  const Together together(shape, stack(shape, widening("x1"), widening("x2"), -0.5, 0.5));
  CHECK(together.fault({0.5, 0}).empty());
  CHECK(together.fault({0.35, 0.35}).empty());  // the legs are off by 0.3·x1·x2, and 0.0433 is allowed
  CHECK(together.fault({0.5, 0.5}).starts_with("no longer true: "));
  CHECK(together.fault({0.5, 0.5}).find("seat") != std::string::npos);
  const Together::Count rest = together.relations({0, 0}), end = together.relations({0.5, 0.5});
  CHECK(rest.kept == rest.of);
  CHECK(end.of == rest.of);
  CHECK(end.kept < end.of);
}

TEST_CASE("siblings are drawn evenly from the ranges, are sound, and the same for one seed") {
  const Shape shape = hand::chair();
  const Program program = narrowing(shape);
  const auto drawn = draw_siblings(shape, program, 1000, 7);
  REQUIRE(drawn.ok());
  REQUIRE(drawn->values.size() == 1000);
  double mean = 0;
  const Together together(shape, program);
  for (const std::vector<double>& values : drawn->values) {
    REQUIRE(values.size() == 2);
    CHECK((values[0] >= 0 && values[0] <= 0.5 && values[1] >= 0 && values[1] <= 0.5));
    CHECK(values[0] + values[1] <= 0.76 + 1e-9);
    CHECK(together.fault(values).empty());
    mean += values[0] / 1000;
  }
  CHECK(mean > 0.2);
  CHECK(mean < 0.25);  // less than the middle of the range: that corner is left out
  // Left out is the triangle beyond x1 + x2 = 0.76: 0.24²/2 of 0.5².
  const double share = drawn->rejected / (1000.0 + drawn->rejected);
  CHECK(share == doctest::Approx(0.1152).epsilon(0.25));
  int reasons = 0;
  for (const auto& [reason, count] : drawn->reasons) reasons += count;
  CHECK(reasons == drawn->rejected);
  CHECK(draw_siblings(shape, program, 1000, 7)->values == drawn->values);
  CHECK(draw_siblings(shape, program, 1000, 8)->values != drawn->values);
  CHECK(to_json(*drawn)["reasons"][0]["count"].get<int>() >= 1);
}

TEST_CASE("what cannot be drawn is refused") {
  const Shape shape = hand::chair();
  const Program program = narrowing(shape);
  CHECK(draw_siblings(shape, program, 0, 1).error().place == "count");
  CHECK(draw_siblings(shape, program, most_siblings + 1, 1).error().place == "count");
  Program none = program;
  none.layers.clear();
  CHECK(draw_siblings(shape, none, 1, 1).error().place == "/layers");
  // Nowhere sound: the second slider has no range but where it spoils the first one's end.
  Program never = program;
  for (Layer& layer : never.layers) {
    layer.statements[0].amount = *parse_amount("0.45+0*" + layer.parameter.name);
  }
  const auto refused = draw_siblings(shape, never, 1, 1);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().cause.find("none is sound") != std::string::npos);
}
