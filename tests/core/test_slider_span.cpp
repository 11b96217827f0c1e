#include "core/propagate/slider_span.h"

#include <doctest/doctest.h>

#include <cmath>

#include "box_shapes.h"
#include "core/base/tolerance.h"
#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

namespace {

SliderSpan span(const Shape& shape, std::vector<Statement> statements) {
  for (Statement& s : statements) {
    if (!s.why) s.why = Why{WhyKind::seed, {}};
  }
  return span_of_seeds(shape, hand::program(shape, std::move(statements)).layers[0], tau);
}

void check_span(const SliderSpan& found, double low, double high) {
  CHECK(found.low == doctest::Approx(low).epsilon(1e-3));
  CHECK(found.high == doctest::Approx(high).epsilon(1e-3));
}

}  // namespace

TEST_CASE("a scale goes from half to twice, whatever multiple of the parameter it is") {
  const Shape shape = test::chair();
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1")}), -0.5, 1);
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "0.1*x1")}), -5, 10);
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "-x1")}), -1, 0.5);
  // Never less than ±0.35, and no farther for an amount that never gets there.
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "4*x1")}), -0.35, 0.35);
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "0.2*sin(x1)")}), -0.35, 0.35);
  // What follows has no say; of two seeds the one that is enough first has.
  Statement follower = statement(Op::scale_1d, "back", Vec3::UnitX(), "3*x1");
  follower.why = Why{WhyKind::attachment, {}};
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1"), follower}), -0.5, 1);
  check_span(span(shape, {statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1"),
                          statement(Op::scale_1d, "back", Vec3::UnitX(), "2*x1")}),
             -0.35, 0.5);
}

TEST_CASE("a thin part is scaled until it is seen") {
  test::BoxShape s;
  s.box("sheet", {0, 0, 0}, {0.5, 0.01, 0.5});
  s.box("foil", {0, 0.5, 0}, {0.5, 0.001, 0.5});
  check_span(span(s.shape(), {statement(Op::scale_1d, "sheet", Vec3::UnitY(), "x1")}), -0.5, 4);
  check_span(span(s.shape(), {statement(Op::scale_1d, "foil", Vec3::UnitY(), "x1")}), -0.5, 4);
  check_span(span(s.shape(), {statement(Op::scale_1d, "sheet", Vec3::UnitX(), "x1")}), -0.5, 1);
  check_span(span(s.shape(), {statement(Op::scale_2d, "sheet", {}, "x1", Vec3::Zero(), Vec3::UnitX())}), -0.5, 1);
}

TEST_CASE("a part is moved by half the model, a face until the part is half or twice as long") {
  const Shape shape = test::chair();  // 1.4 high: from -0.65 to 0.75
  check_span(span(shape, {statement(Op::translate, "seat", Vec3::UnitY(), "x1")}), -0.7, 0.7);
  Statement face = statement(Op::translate, "back", Vec3::UnitY(), "x1");
  face.feature = {0, 1, 0};
  check_span(span(shape, {face}), -0.35, 0.7);
  face.feature = {0, -1, 0};
  check_span(span(shape, {face}), -0.7, 0.35);
}

TEST_CASE("what hangs or spins turns far, what stands leans") {
  const double open = 110 * pi / 180, lean = 30 * pi / 180;
  const Shape cabinet = test::cabinet();
  const Statement door = statement(Op::rotate, "door", Vec3::UnitY(), "x1", {-0.4, 0, 0.3});
  check_span(span(cabinet, {door}), -open, open);
  Statement handle = statement(Op::rotate, "handle", Vec3::UnitY(), "x1", {-0.4, 0, 0.3});
  handle.why = Why{WhyKind::neighbour, {}};
  check_span(span(cabinet, {door, handle}), -open, open);
  // Something else gives way: no door.
  Statement body = statement(Op::translate, "body", Vec3::UnitX(), "0.3*sin(x1)");
  body.why = Why{WhyKind::attachment, {}};
  check_span(span(cabinet, {door, body}), -lean, lean);
  // A flap hangs from its upper edge, a wheel turns about its own axle; a back stands up, a leg stands on the floor.
  check_span(span(cabinet, {statement(Op::rotate, "door", Vec3::UnitX(), "x1", {0, 0.5, 0.3})}), -open, open);
  check_span(span(cabinet, {statement(Op::rotate, "door", Vec3::UnitZ(), "x1", {0, 0, 0.3})}), -open, open);
  const Shape chair = test::chair();
  check_span(span(chair, {statement(Op::rotate, "back", Vec3::UnitX(), "x1", {0, 0.05, -0.37})}), -lean, lean);
  check_span(span(chair, {statement(Op::rotate, "leg_front_left", Vec3::UnitX(), "x1", {0.3, -0.05, 0.3})}), -lean,
             lean);
}

TEST_CASE("a row gets half to twice as many instances, and as far apart") {
  const Shape shape = hand::slats();
  const SliderSpan count = span(shape, {hand::group_statement(Op::change_count, "t1", "2*x1", Anchor::fit)});
  // Three slats: two from -0.5 on, six from 1.5 on and no seventh.
  check_span(count, -0.5, 1.75);
  check_span(span(shape, {hand::group_statement(Op::change_delta, "t1", "x1", Anchor::middle)}), -0.5, 1);
}
