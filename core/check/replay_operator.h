// The operators, as the independent checker has them: matrices of the supplement's table 2. Nothing here looks at the
// table that everything else is made from (core/edit/operators.json): that is what this is held against.
#pragma once

#include "core/edit/program.h"

namespace parsel::replay {

/// The references without which an operator does nothing.
struct Needs {
  bool origin = false, direction = false, normal = false;
};
Needs needs_of(Op op);

/// About a unit vector, right-handed.
Mat3 rotation(const Vec3& n, double angle);

/// Every geometric operator is p → o + M (p - o) + t.
struct Affine {
  Mat3 matrix = Mat3::Identity();
  Vec3 origin = Vec3::Zero(), shift = Vec3::Zero();
  Vec3 operator()(const Vec3& p) const { return origin + matrix * (p - origin) + shift; }
};

/// The identity for operators that move no points. `direction` is rotate's axis as well; all unit.
Affine affine_of(Op op, const Vec3& origin, const Vec3& direction, const Vec3& normal, double amount);

}  // namespace parsel::replay
