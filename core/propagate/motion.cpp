#include "core/propagate/motion.h"

#include <algorithm>
#include <cmath>

#include "core/amount/amount.h"
#include "core/amount/amount_functions.h"
#include "core/base/tolerance.h"
#include "core/edit/displacement.h"

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

/// What the group operators before have made of a group, as factors of what it is at rest. With more than one of them
/// each works on what the others left.
template <class T>
class GroupSoFar {
 public:
  explicit GroupSoFar(const Relation& group)
      : is_row_(group.kind == RelationKind::translation),
        at_rest_(static_cast<int>(group.parts.size()) - 1),
        gaps_(static_cast<int>(group.parts.size()) - 1) {}

  /// By how much of its group_field() an operator moves the group, now.
  T factor(Op op, Anchor anchor, const T& amount) {
    T factor = amount * spacing_;
    if (op == Op::change_delta) {
      if (is_row_) factor = factor * gaps_ / at_rest_;
      spacing_ = spacing_ * (1 + amount);
    } else if (is_row_) {
      const T gaps = gaps_ + amount;
      if (anchor == Anchor::fit) spacing_ = spacing_ * gaps_ / gaps;
      gaps_ = gaps;
    }
    return factor;
  }

 private:
  bool is_row_;
  T at_rest_, gaps_, spacing_ = 1;
};

/// The group operators among steps need their group.
template <class T>
std::optional<GroupSoFar<T>> group_so_far(const Shape& shape, PartIndex part, const std::vector<Step>& steps) {
  for (const Step& step : steps) {
    if (!is_geometric(step.what.op)) return GroupSoFar<T>(group_relation(shape, part));
  }
  return std::nullopt;
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

Motion still() {
  Motion motion;
  motion.fill(Corners::Zero());
  return motion;
}

double largest_difference(const Motion& a, const Motion& b) {
  double worst = 0;
  for (const std::size_t s : {std::size_t{0}, sample_count - 1})
    worst = std::max(worst, (a[s] - b[s]).cwiseAbs().maxCoeff());
  return worst;
}

Motion motion_of(const Shape& shape, PartIndex part, const std::vector<Step>& steps) {
  const Corners& rest = shape.parts[part].hexahedron.corners;
  Motion motion;
  for (std::size_t s = 0; s < sample_count; ++s) {
    Corners corners = rest;
    auto group = group_so_far<double>(shape, part, steps);
    for (const Step& step : steps) {
      if (is_geometric(step.what.op)) {
        apply_operator(step.what, step.values[s], corners);
        continue;
      }
      const double amount = step.what.op == Op::change_count ? counted(step.values[s]) : step.values[s];
      const double factor = group->factor(step.what.op, step.anchor, amount);
      corners += factor * group_field(shape, part, step.what.op, step.anchor);
    }
    motion[s] = corners - rest;
  }
  return motion;
}

ex counted_form(const ex& amount) {
  return real_floor(amount).hold();
}

ex number(double value) {
  return std::abs(value) < 1e-12 ? ex(0) : Amount::constant(value).expression();
}

template <>
Rotor<ex> rotor_of(const ex& angle) {
  return {GiNaC::sin(angle), GiNaC::cos(angle)};
}

namespace {

Triple<ex> numbers(const Vec3& v) {
  return {number(v.x()), number(v.y()), number(v.z())};
}

}  // namespace

SymbolicMotion symbolic_motion(const Shape& shape, PartIndex part, const std::vector<Step>& steps) {
  const Corners& rest = shape.parts[part].hexahedron.corners;
  SymbolicMotion moved;
  for (auto& row : moved) row = {0, 0, 0};
  auto group = group_so_far<ex>(shape, part, steps);
  for (const Step& step : steps) {
    const ResolvedOperator& what = step.what;
    if (!is_geometric(what.op)) {
      const Corners field = group_field(shape, part, what.op, step.anchor);
      const ex amount =
          group->factor(what.op, step.anchor, what.op == Op::change_count ? counted_form(step.amount) : step.amount);
      for (std::size_t k = 0; k < 8; ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
          moved[k][c] += number(field(static_cast<int>(k), static_cast<int>(c))) * amount;
        }
      }
      continue;
    }
    const Displacement<ex> displacement(what.op, numbers(what.direction), numbers(what.normal), step.amount);
    for (std::size_t k = 0; k < 8; ++k) {
      if (!selects(what.feature, static_cast<int>(k))) continue;
      Triple<ex> lever = numbers(rest.row(static_cast<int>(k)).transpose() - what.origin);
      for (std::size_t c = 0; c < 3; ++c) lever[c] += moved[k][c];
      const Triple<ex> by = displacement(lever);
      for (std::size_t c = 0; c < 3; ++c) moved[k][c] += by[c];
    }
  }
  return moved;
}

}  // namespace parsel
