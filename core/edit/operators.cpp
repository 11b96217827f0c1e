#include "core/edit/operators.h"

#include <array>

#include "core/edit/displacement.h"

namespace parsel {

namespace {

constexpr std::array<std::string_view, 9> op_names = {
    "translate", "rotate", "scale_1d", "scale_2d", "scale_3d", "shear", "change_count", "change_delta", "keep_fixed"};
constexpr std::array<std::string_view, 4> anchor_names = {"start", "middle", "end", "fit"};

Triple<double> triple(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Displacement<double> displacement_of(const ResolvedOperator& op, double amount) {
  return {op.op, triple(op.direction), triple(op.normal), amount};
}

Vec3 moved(const Displacement<double>& displacement, const Vec3& origin, const Vec3& point) {
  const Triple<double> by = displacement(triple(point - origin));
  return point + Vec3(by[0], by[1], by[2]);
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
  return moved(displacement_of(op, amount), op.origin, point);
}

void apply_operator(const ResolvedOperator& op, double amount, Corners& corners) {
  const Displacement<double> displacement = displacement_of(op, amount);
  for (int k = 0; k < 8; ++k) {
    if (selects(op.feature, k)) {
      const Vec3 corner = corners.row(k).transpose();
      corners.row(k) = moved(displacement, op.origin, corner).transpose();
    }
  }
}

}  // namespace parsel
