#include "core/edit/operators.h"

#include <array>
#include <cmath>

namespace parsel {

namespace {

constexpr std::array<std::string_view, 9> op_names = {
    "translate", "rotate", "scale_1d", "scale_2d", "scale_3d", "shear", "change_count", "change_delta", "keep_fixed"};
constexpr std::array<std::string_view, 4> anchor_names = {"start", "middle", "end", "fit"};

/// Rodrigues' formula about a unit axis.
Vec3 rotated(const Vec3& v, const Vec3& axis, double cosine, double sine) {
  // Written out: Eigen's cross() needs <Eigen/Geometry>, which costs every build a second.
  const Vec3 cross(axis.y() * v.z() - axis.z() * v.y(), axis.z() * v.x() - axis.x() * v.z(),
                   axis.x() * v.y() - axis.y() * v.x());
  return cosine * v + sine * cross + (1 - cosine) * axis.dot(v) * axis;
}

}  // namespace

std::string_view to_string(Op op) {
  return op_names[static_cast<std::size_t>(op)];
}

std::optional<Op> op_from_string(std::string_view text) {
  for (std::size_t i = 0; i < op_names.size(); ++i) {
    if (op_names[i] == text) return static_cast<Op>(i);
  }
  return std::nullopt;
}

std::string_view to_string(Anchor anchor) {
  return anchor_names[static_cast<std::size_t>(anchor)];
}

std::optional<Anchor> anchor_from_string(std::string_view text) {
  for (std::size_t i = 0; i < anchor_names.size(); ++i) {
    if (anchor_names[i] == text) return static_cast<Anchor>(i);
  }
  return std::nullopt;
}

bool is_geometric(Op op) {
  return op != Op::change_count && op != Op::change_delta;
}

bool needs_origin(Op op) {
  return op == Op::rotate || op == Op::scale_1d || op == Op::scale_2d || op == Op::scale_3d || op == Op::shear;
}

bool needs_direction(Op op) {
  return op == Op::translate || op == Op::rotate || op == Op::scale_1d || op == Op::shear;
}

bool needs_normal(Op op) {
  return op == Op::scale_2d || op == Op::shear;
}

bool selects(const LocalTriple& feature, int corner) {
  for (int i = 0; i < 3; ++i) {
    const int wanted = feature[static_cast<std::size_t>(i)];
    if (wanted != 0 && wanted != corner_sign(corner, i)) return false;
  }
  return true;
}

Vec3 displaced(const ResolvedOperator& op, double amount, const Vec3& point) {
  const Vec3 r = point - op.origin;
  switch (op.op) {
    case Op::translate:
      return point + amount * op.direction;
    case Op::rotate:
      return op.origin + rotated(r, op.direction, std::cos(amount), std::sin(amount));
    case Op::scale_1d:
      return point + amount * op.direction.dot(r) * op.direction;
    case Op::scale_2d:
      return point + amount * (r - op.normal.dot(r) * op.normal);
    case Op::scale_3d:
      return point + amount * r;
    case Op::shear:
      return point + amount * op.normal.dot(r) * op.direction;
    case Op::keep_fixed:
      return point;
    case Op::change_count:
    case Op::change_delta:
      break;
  }
  PARSEL_ASSERT(false, "the group operators move instances, not points");
  return point;
}

void apply_operator(const ResolvedOperator& op, double amount, Corners& corners) {
  for (int k = 0; k < 8; ++k) {
    if (!selects(op.feature, k)) continue;
    const Vec3 corner = corners.row(k).transpose();
    corners.row(k) = displaced(op, amount, corner).transpose();
  }
}

}  // namespace parsel
