#include "core/edit/operators.h"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <set>

#include "core/base/random.h"
#include "core/check/replay_operator.h"
#include "core/edit/operator_table.h"
#include "core/propagate/candidates.h"
#include "core/shape/hexahedron.h"

using namespace parsel;

namespace {

Vec3 random_vector(Random& random) {
  return {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
}

constexpr std::array<Op, 7> geometric = {Op::translate, Op::rotate, Op::scale_1d,  Op::scale_2d,
                                         Op::scale_3d,  Op::shear,  Op::keep_fixed};

/// Supplement table 2 as an affine map x → M x + t.
Eigen::Affine3d matrix_form(const ResolvedOperator& op, double a) {
  const Vec3 o = op.origin, d = op.direction, n = op.normal;
  Mat3 linear = Mat3::Identity();
  switch (op.op) {
    case Op::translate:
      return Eigen::Affine3d(Eigen::Translation3d(a * d));
    case Op::rotate:
      linear = Eigen::AngleAxisd(a, d).toRotationMatrix();
      break;
    case Op::scale_1d:
      linear += a * d * d.transpose();
      break;
    case Op::scale_2d:
      linear += a * (Mat3::Identity() - n * n.transpose());
      break;
    case Op::scale_3d:
      linear *= 1 + a;
      break;
    case Op::shear:
      linear += a * d * n.transpose();
      break;
    default:
      break;
  }
  return Eigen::Translation3d(o) * linear * Eigen::Translation3d(-o);
}

}  // namespace

TEST_CASE("names of operators and anchors read back") {
  for (int i = 0; i <= static_cast<int>(Op::keep_fixed); ++i) {
    const Op op = static_cast<Op>(i);
    CHECK(op_from_string(to_string(op)) == op);
  }
  for (int i = 0; i <= static_cast<int>(Anchor::fit); ++i) {
    const Anchor anchor = static_cast<Anchor>(i);
    CHECK(anchor_from_string(to_string(anchor)) == anchor);
  }
  CHECK_FALSE(op_from_string("Translate"));
  CHECK_FALSE(op_from_string(""));
  CHECK_FALSE(anchor_from_string("center"));
}

TEST_CASE("the 27 features select 8, 4, 2 or 1 corners") {
  std::set<std::set<int>> sets;
  for (int f = 0; f < 27; ++f) {
    const LocalTriple feature = {f % 3 - 1, f / 3 % 3 - 1, f / 9 - 1};
    std::set<int> corners;
    for (int k = 0; k < 8; ++k) {
      if (selects(feature, k)) corners.insert(k);
    }
    int fixed = 0;
    for (const int i : feature) fixed += i != 0;
    CHECK(corners.size() == std::size_t{8} >> fixed);
    for (const int k : corners) {
      for (int i = 0; i < 3; ++i) {
        const int wanted = feature[static_cast<std::size_t>(i)];
        CHECK((wanted == 0 || wanted == corner_sign(k, i)));
      }
    }
    sets.insert(corners);
  }
  CHECK(sets.size() == 27);
}

TEST_CASE("operators are the affine maps of the paper on the selected corners and nothing on the others") {
  Random random(2);
  for (const Op op : geometric) {
    for (int round = 0; round < 40; ++round) {
      ResolvedOperator resolved;
      resolved.op = op;
      resolved.origin = random_vector(random);
      resolved.direction = random_vector(random).normalized();
      resolved.normal = random_vector(random).normalized();
      for (int& i : resolved.feature) i = static_cast<int>(random.below(3)) - 1;
      const double amount = random.uniform(-1.5, 1.5);
      Corners before;
      for (int k = 0; k < 8; ++k) before.row(k) = random_vector(random).transpose();
      Corners after = before;
      apply_operator(resolved, amount, after);
      const Eigen::Affine3d map = matrix_form(resolved, amount);
      for (int k = 0; k < 8; ++k) {
        const Vec3 corner = before.row(k).transpose();
        const Vec3 expected = selects(resolved.feature, k) ? Vec3(map * corner) : corner;
        CHECK((after.row(k).transpose() - expected).norm() < 1e-12);
      }
      Corners still = before;
      apply_operator(resolved, 0, still);
      CHECK((still - before).cwiseAbs().maxCoeff() < 1e-15);
    }
  }
}

TEST_CASE("the table gives every operator a name of its own, a hint that exists, and what the checker says it needs") {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(Op::keep_fixed); ++i) {
    const Op op = static_cast<Op>(i);
    CAPTURE(to_string(op));
    CHECK(op_from_string(to_string(op)) == op);
    CHECK(names.insert(to_string(op)).second);
    CHECK(hint_from_string(hint_of(op)).has_value());
    const replay::Needs needs = replay::needs_of(op);
    CHECK(needs_origin(op) == needs.origin);
    CHECK(needs_direction(op) == needs.direction);
    CHECK(needs_normal(op) == needs.normal);
  }
  CHECK(listed_operators(" or ") ==
        "translate, rotate, scale_1d, scale_2d, scale_3d, shear, change_count, change_delta or keep_fixed");
}
