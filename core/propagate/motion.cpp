#include "core/propagate/motion.h"

#include <cmath>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"
#include "core/base/tolerance.h"

namespace parsel {

using GiNaC::ex;

namespace {

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

const Relation& group_relation(const Shape& shape, PartIndex parent) {
  const Part& part = shape.parts[parent];
  PARSEL_ASSERT(part.is_virtual() && part.group.has_value(), "group operators need the parent of a group");
  return shape.relations[*part.group];
}

/// What change_count counts with (core/edit/evaluate.h): amounts are rounded down, 3 less a rounding error is 3.
double counted(double amount) {
  return std::floor(amount + noise);
}

/// Displacement of the sides that move with the first and the last instance.
Corners side_field(const Translation& group, const Vec3& first, const Vec3& last) {
  Corners field;
  for (int k = 0; k < 8; ++k) {
    const bool is_first = corner_sign(k, group.axis) == -group.direction;
    field.row(k) = (is_first ? first : last).transpose();
  }
  return field;
}

Corners radial_field(const Part& parent, const Rotation& group) {
  const Mat3& axes = parent.hexahedron.axes;
  Corners field = Corners::Zero();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      if (axis != group.parent_axis) field.row(k) += group.radius * corner_sign(k, axis) * axes.row(axis);
    }
  }
  return field;
}

}  // namespace

bool is_too_long(const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    if (Amount(step.amount).text().size() > longest_amount) return true;
  }
  return false;
}

Samples sample_points(double low, double high) {
  return {low, 0.78 * low, 0.41 * low, 0.09 * low, 0.09 * high, 0.41 * high, 0.78 * high, high};
}

Corners unit_field(const ResolvedOperator& what, const Corners& rest) {
  Corners field = Corners::Zero();
  for (int k = 0; k < 8; ++k) {
    if (!selects(what.feature, k)) continue;
    const Vec3 corner = rest.row(k).transpose();
    const Vec3 moved = what.op == Op::rotate ? Vec3(corner - what.origin) : Vec3(displaced(what, 1, corner) - corner);
    field.row(k) = moved.transpose();
  }
  return field;
}

Corners group_field(const Shape& shape, PartIndex parent, Op op, Anchor anchor) {
  const Relation& relation = group_relation(shape, parent);
  if (relation.kind == RelationKind::rotation) {
    if (op == Op::change_count) return Corners::Zero();
    return radial_field(shape.parts[parent], std::get<Rotation>(relation.detail));
  }
  const auto& group = std::get<Translation>(relation.detail);
  const double gaps = static_cast<double>(relation.parts.size()) - 1;
  const Vec3 delta = (group.end - group.start) / gaps;
  // change_delta by 1 adds one delta a gap; change_count by 1 adds one gap.
  const double growth = op == Op::change_delta ? gaps : 1;
  if (op == Op::change_count && anchor == Anchor::fit) return Corners::Zero();
  const double first = anchor == Anchor::start ? 0 : anchor == Anchor::end ? growth : growth / 2;
  return side_field(group, -first * delta, (growth - first) * delta);
}

Vec3 turned(const Vec3& lever, const Vec3& axis, double angle) {
  const Vec3 across = lever - axis.dot(lever) * axis;
  return std::sin(angle) * cross(axis, lever) + (std::cos(angle) - 1) * across;
}

Motion motion_of(const Shape& shape, PartIndex part, const std::vector<Step>& steps) {
  const Corners& rest = shape.parts[part].hexahedron.corners;
  Motion motion;
  for (std::size_t s = 0; s < sample_count; ++s) {
    Corners corners = rest;
    for (const Step& step : steps) {
      if (is_geometric(step.what.op)) {
        apply_operator(step.what, step.values[s], corners);
        continue;
      }
      const double amount = step.what.op == Op::change_count ? counted(step.values[s]) : step.values[s];
      corners += amount * group_field(shape, part, step.what.op, step.anchor);
    }
    motion[s] = corners - rest;
  }
  return motion;
}

ex counted(const ex& amount) {
  return real_floor(amount + Amount::constant(noise).expression()).hold();
}

ex number(double value) {
  return std::abs(value) < 1e-12 ? ex(0) : Amount::constant(value).expression();
}

SymbolicMotion symbolic_motion(const Shape& shape, PartIndex part, const std::vector<Step>& steps) {
  const Corners& rest = shape.parts[part].hexahedron.corners;
  SymbolicMotion moved;
  for (auto& row : moved) row = {0, 0, 0};
  for (const Step& step : steps) {
    const ResolvedOperator& what = step.what;
    if (!is_geometric(what.op)) {
      const Corners field = group_field(shape, part, what.op, step.anchor);
      const ex amount = what.op == Op::change_count ? counted(step.amount) : step.amount;
      for (std::size_t k = 0; k < 8; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          moved[k][c] += number(field(static_cast<int>(k), static_cast<int>(c))) * amount;
        }
      }
      continue;
    }
    for (std::size_t k = 0; k < 8; ++k) {
      if (!selects(what.feature, static_cast<int>(k))) continue;
      // Every operator but rotate adds amount · L(H − o) + amount · t, L linear; rotate adds sin·(n × r) + (cos −
      // 1)·r⊥.
      std::array<ex, 3> r;
      for (std::size_t c = 0; c < 3; ++c) {
        const auto i = static_cast<int>(c);
        r[c] = number(rest(static_cast<int>(k), i) - what.origin[i]) + moved[k][c];
      }
      const auto linear = [&](const Mat3& m, std::size_t row) {
        ex sum = 0;
        for (std::size_t c = 0; c < 3; ++c) sum += number(m(static_cast<int>(row), static_cast<int>(c))) * r[c];
        return sum;
      };
      const Vec3& n = what.direction;
      Mat3 first = Mat3::Zero();
      Mat3 second = Mat3::Zero();  // rotate only: the factor of (cos − 1)
      Vec3 constant = Vec3::Zero();
      switch (what.op) {
        case Op::translate:
          constant = n;
          break;
        case Op::scale_1d:
          first = n * n.transpose();
          break;
        case Op::scale_2d:
          first = Mat3::Identity() - what.normal * what.normal.transpose();
          break;
        case Op::scale_3d:
          first = Mat3::Identity();
          break;
        case Op::shear:
          first = n * what.normal.transpose();
          break;
        case Op::rotate:
          first << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
          second = Mat3::Identity() - n * n.transpose();
          break;
        default:
          break;
      }
      for (std::size_t c = 0; c < 3; ++c) {
        const ex direction = linear(first, c) + number(constant[static_cast<int>(c)]);
        if (what.op == Op::rotate) {
          moved[k][c] += GiNaC::sin(step.amount) * direction + (GiNaC::cos(step.amount) - 1) * linear(second, c);
        } else {
          moved[k][c] += step.amount * direction;
        }
      }
    }
  }
  return moved;
}

}  // namespace parsel
