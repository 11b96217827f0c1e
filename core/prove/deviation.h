// How far a state is from keeping a relation: the constraints C(x) of ParSEL §5.2 and supplement table 1, one number a
// coordinate, 0 when kept. Written once for doubles (State) and for rigorous bounds (JetState).
//
//   reflection   H_b[k] - mirror(H_a[corner_map[k]])
//   translation  H_i[k] - H_0[k] - i·(end - start)/(n - 1), the instances i of the group as they are now
//   rotation     H_i[k] - centre - R(axis, i·2π/n)(H_0[k] - centre)
//   attachment   M_a H_a - M_b H_b minus the same at rest
//   ground       the height of M_a H_a minus the same at rest
// An attachment to the parent of a group is one to the parent's corners, whatever the number of instances. One of an
// instance is judged while the instance exists: once the number has changed, all instances are copies of one at places
// of their own, and there is no part any more that the relation could speak of. That start,
// end and centre follow the parent and the other way round needs no constraint: every operator moves them together.
#pragma once

#include <array>
#include <vector>

#include "core/base/tolerance.h"
#include "core/edit/evaluate.h"
#include "core/prove/enclosure.h"
#include "core/shape/shape.h"

namespace parsel {

/// A relation with its weights worked out.
struct Constraint {
  const Relation* relation;
  RelationIndex index;
  std::vector<Weights> weights_a, weights_b;  ///< attachment: of each point in its two parts; ground: in its part (a)
  std::vector<Vec3> at_rest;                  ///< M_a H_a - M_b H_b of the shape (ground: M_a H_a)
  std::vector<RelationIndex> groups;          ///< of which its parts are instances
};

Constraint make_constraint(const Shape& shape, RelationIndex relation);

/// Whether the instances that the relation ties exist: the number of their groups has not changed. For a State and a
/// JetState.
template <class State>
bool exists(const Constraint& constraint, const State& state) {
  for (const RelationIndex group : constraint.groups) {
    if (state.groups[group].count_changed) return false;
  }
  return true;
}

/// Largest deviation of a coordinate; 0 when the relation does not exist in that state.
double deviation(const Constraint& constraint, const State& state);

namespace detail {

inline double coordinate(const Corners& corners, int k, int c) {
  return corners(k, c);
}
inline const Jet& coordinate(const JetCorners& corners, int k, int c) {
  return corners[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)];
}
inline double coordinate(const Vec3& point, int c) {
  return point[c];
}
inline const Jet& coordinate(const JetPoint& point, int c) {
  return point[static_cast<std::size_t>(c)];
}
inline void add_scaled(double& a, double s, double b) {
  a += s * b;
}
using parsel::add_scaled;

template <class T>
struct ScalarOf;
template <>
struct ScalarOf<State> {
  using Type = double;
};
template <>
struct ScalarOf<JetState> {
  using Type = Jet;
};

template <class State, class F>
void reflection_deviations(const Constraint& constraint, const State& state, F&& f) {
  using T = typename ScalarOf<State>::Type;
  const auto& reflection = std::get<Reflection>(constraint.relation->detail);
  const auto& a = state.parts[constraint.relation->parts[0]];
  const auto& b = state.parts[constraint.relation->parts[1]];
  const Mat3 mirror = Mat3::Identity() - 2 * reflection.normal * reflection.normal.transpose();
  const Vec3 offset = 2 * reflection.origin.dot(reflection.normal) * reflection.normal;
  for (int k = 0; k < 8; ++k) {
    const int image = reflection.corner_map[static_cast<std::size_t>(k)];
    for (int c = 0; c < 3; ++c) {
      T value = coordinate(b, k, c);
      for (int j = 0; j < 3; ++j) {
        if (mirror(c, j) != 0) add_scaled(value, -mirror(c, j), coordinate(a, image, j));
      }
      f(value - T(offset[c]));
    }
  }
}

template <class State, class F>
void translation_deviations(const Constraint& constraint, const State& state, F&& f) {
  using T = typename ScalarOf<State>::Type;
  const auto& group = state.groups[constraint.index];
  const auto n = static_cast<int>(group.instances.size());
  for (int i = 1; i < n; ++i) {
    const double share = static_cast<double>(i) / (n - 1);
    for (int k = 0; k < 8; ++k) {
      for (int c = 0; c < 3; ++c) {
        T value = coordinate(group.instances[static_cast<std::size_t>(i)], k, c);
        add_scaled(value, -1, coordinate(group.instances[0], k, c));
        add_scaled(value, -share, coordinate(group.end, c));
        add_scaled(value, share, coordinate(group.start, c));
        f(value);
      }
    }
  }
}

template <class State, class F>
void rotation_deviations(const Constraint& constraint, const State& state, F&& f) {
  using T = typename ScalarOf<State>::Type;
  const auto& group = state.groups[constraint.index];
  const auto n = static_cast<int>(group.instances.size());
  const std::array<T, 3> axis = {coordinate(group.axis, 0), coordinate(group.axis, 1), coordinate(group.axis, 2)};
  for (int k = 0; k < 8; ++k) {
    std::array<T, 3> r;
    for (int c = 0; c < 3; ++c) r[c] = coordinate(group.instances[0], k, c) - coordinate(group.centre, c);
    const T height = axis[0] * r[0] + axis[1] * r[1] + axis[2] * r[2];
    for (int i = 1; i < n; ++i) {
      const double angle = 2 * pi * i / n;
      for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3;
        const int e = (c + 2) % 3;
        const T along = height * axis[c];
        const T turned = along + std::cos(angle) * (r[c] - along) + std::sin(angle) * (axis[d] * r[e] - axis[e] * r[d]);
        f(coordinate(group.instances[static_cast<std::size_t>(i)], k, c) - coordinate(group.centre, c) - turned);
      }
    }
  }
}

template <class State, class F>
void attachment_deviations(const Constraint& constraint, const State& state, F&& f) {
  using T = typename ScalarOf<State>::Type;
  const auto& a = state.parts[constraint.relation->parts[0]];
  const auto& b = state.parts[constraint.relation->parts[1]];
  for (std::size_t i = 0; i < constraint.at_rest.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      T value(-constraint.at_rest[i][c]);
      for (int k = 0; k < 8; ++k) {
        const double weight_a = constraint.weights_a[i][k];
        const double weight_b = constraint.weights_b[i][k];
        if (weight_a != 0) add_scaled(value, weight_a, coordinate(a, k, c));
        if (weight_b != 0) add_scaled(value, -weight_b, coordinate(b, k, c));
      }
      f(value);
    }
  }
}

template <class State, class F>
void ground_deviations(const Constraint& constraint, const State& state, F&& f) {
  using T = typename ScalarOf<State>::Type;
  const auto& part = state.parts[constraint.relation->parts[0]];
  for (std::size_t i = 0; i < constraint.at_rest.size(); ++i) {
    T value(-constraint.at_rest[i].y());
    for (int k = 0; k < 8; ++k) {
      const double weight = constraint.weights_a[i][k];
      if (weight != 0) add_scaled(value, weight, coordinate(part, k, 1));
    }
    f(value);
  }
}

}  // namespace detail

/// Calls f with every coordinate of the constraint: a double for a State, a Jet for a JetState. With none when the
/// relation does not exist in that state.
template <class State, class F>
void for_each_deviation(const Constraint& constraint, const State& state, F&& f) {
  if (!exists(constraint, state)) return;
  switch (constraint.relation->kind) {
    case RelationKind::reflection:
      return detail::reflection_deviations(constraint, state, f);
    case RelationKind::translation:
      return detail::translation_deviations(constraint, state, f);
    case RelationKind::rotation:
      return detail::rotation_deviations(constraint, state, f);
    case RelationKind::ground:
      return detail::ground_deviations(constraint, state, f);
    default:
      return detail::attachment_deviations(constraint, state, f);
  }
}

}  // namespace parsel
