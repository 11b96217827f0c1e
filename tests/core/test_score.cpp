#include "core/check/score.h"

#include <doctest/doctest.h>

#include <cmath>

#include "hand_shapes.h"

using namespace parsel;
using hand::statement;

TEST_CASE("a program scores fully against itself") {
  const Shape shape = hand::chair();
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    const Program program = hand::random_program(shape, random);
    const Score score = score_program(shape, program, program);
    CHECK(score.programmatic == 1);
    CHECK(score.geometric == 0);
    CHECK(score.structural == 1);
  }
}

TEST_CASE("the three measures, computed by hand") {
  const Shape shape = hand::chair();
  const Statement widen = statement(Op::scale_1d, "seat", Vec3::UnitX(), "x1");
  const Statement left = statement(Op::translate, "leg_left", Vec3::UnitX(), "0.3*x1");
  const Statement right = statement(Op::translate, "leg_right", -Vec3::UnitX(), "0.3*x1");
  const Program truth = hand::program(shape, {widen, left, right});
  const Program partial = hand::program(shape, {widen, left});
  const Score score = score_program(shape, truth, partial);
  CHECK(score.programmatic == doctest::Approx(2.0 / 3));
  // leg_right's 8 corners are 0.3·0.35 apart each.
  CHECK(score.geometric == doctest::Approx(std::sqrt(8.0) * 0.105));
  // r1, a1, a2, a3 touch edited parts; r1 and a2 are kept by the truth alone, a1 by both, a3 by neither.
  CHECK(score.relations == 4);
  CHECK(score.structural == doctest::Approx(0.5));
}

TEST_CASE("the measures look at 0.35, or at the end of the shorter range") {
  const Shape shape = hand::chair();
  const Program wide = hand::program(shape, {statement(Op::translate, "handle", Vec3::UnitX(), "x1")}, -1, 1);
  const Program still = hand::program(shape, {}, -0.1, 0.1);
  CHECK(score_program(shape, wide, hand::program(shape, {}, -1, 1)).geometric ==
        doctest::Approx(std::sqrt(8.0) * 0.35));
  CHECK(score_program(shape, wide, still).geometric == doctest::Approx(std::sqrt(8.0) * 0.1));
  CHECK(score_program(shape, still, still).programmatic == 1);
}

TEST_CASE("taking a group apart is a state of its relations; missing instances count as the last one") {
  const Shape shape = hand::slats();
  const Program whole = hand::program(shape, {statement(Op::translate, "slats", Vec3::UnitZ(), "x1")});
  const Program apart = hand::program(shape, {statement(Op::translate, "slat_1", Vec3::UnitZ(), "x1")});
  const Score score = score_program(shape, whole, apart);
  CHECK(score.programmatic == 0);
  CHECK(score.geometric == doctest::Approx(2 * std::sqrt(8.0) * 0.35));
  // t1 and a1 count under the truth alone, a2 and a3 under the other alone.
  CHECK(score.relations == 4);
  CHECK(score.structural == 0);

  const Program more = hand::program(shape, {hand::group_statement(Op::change_count, "t1", "10*x1", Anchor::start)});
  // Three instances become six, the further ones 0.2, 0.4, 0.6 from the last.
  CHECK(score_program(shape, hand::program(shape, {}), more).geometric == doctest::Approx(std::sqrt(8.0) * 1.2));
}
