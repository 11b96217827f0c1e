#include "core/check/replay_operator.h"

#include <cmath>

namespace parsel::replay {

Needs needs_of(Op op) {
  switch (op) {
    case Op::translate:
      return {.direction = true};
    case Op::rotate:
    case Op::scale_1d:
      return {.origin = true, .direction = true};
    case Op::scale_2d:
      return {.origin = true, .normal = true};
    case Op::scale_3d:
      return {.origin = true};
    case Op::shear:
      return {.origin = true, .direction = true, .normal = true};
    case Op::change_count:
    case Op::change_delta:
    case Op::keep_fixed:
      break;
  }
  return {};
}

Mat3 rotation(const Vec3& n, double angle) {
  Mat3 skew;
  skew << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return std::cos(angle) * Mat3::Identity() + std::sin(angle) * skew + (1 - std::cos(angle)) * n * n.transpose();
}

Affine affine_of(Op op, const Vec3& origin, const Vec3& direction, const Vec3& normal, double amount) {
  Affine map;
  map.origin = origin;
  switch (op) {
    case Op::translate:
      map.shift = amount * direction;
      break;
    case Op::rotate:
      map.matrix = rotation(direction, amount);
      break;
    case Op::scale_1d:
      map.matrix += amount * direction * direction.transpose();
      break;
    case Op::scale_2d:
      map.matrix += amount * (Mat3::Identity() - normal * normal.transpose());
      break;
    case Op::scale_3d:
      map.matrix *= 1 + amount;
      break;
    case Op::shear:
      map.matrix += amount * direction * normal.transpose();
      break;
    case Op::change_count:
    case Op::change_delta:
    case Op::keep_fixed:
      break;
  }
  return map;
}

}  // namespace parsel::replay
