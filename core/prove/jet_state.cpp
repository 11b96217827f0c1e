#include "core/prove/jet_state.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"
#include "core/edit/cage.h"
#include "core/edit/evaluate.h"

namespace parsel {

template <>
Rotor<Jet> rotor_of(const Jet& angle) {
  SineCosine both = sine_cosine(angle);
  return {std::move(both.sine), std::move(both.cosine)};
}

namespace {

JetPoint operator+(const JetPoint& a, const JetPoint& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
JetPoint operator-(const JetPoint& a, const JetPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
JetPoint operator*(const Jet& s, const JetPoint& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
JetPoint operator*(double s, const JetPoint& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
Jet dot(const JetPoint& a, const JetPoint& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
JetPoint to_jets(const Vec3& v) {
  return {Jet(v[0]), Jet(v[1]), Jet(v[2])};
}
JetCorners to_jets(const Corners& corners) {
  JetCorners jets;
  for (int k = 0; k < 8; ++k) jets[static_cast<std::size_t>(k)] = to_jets(Vec3(corners.row(k).transpose()));
  return jets;
}

void forget(Jet& jet) {
  jet = Jet(Interval::everything());
  jet.smooth = jet.defined = false;
}
void forget(JetPoint& point) {
  for (Jet& jet : point) forget(jet);
}
void forget(JetCorners& corners) {
  for (JetPoint& point : corners) forget(point);
}

bool is_constant(const JetPoint& point) {
  return std::all_of(point.begin(), point.end(), [](const Jet& jet) { return jet.size == 1 && jet.smooth; });
}

/// Σ over the corners with weights; weights that are 0 are skipped.
JetPoint weighted(const JetCorners& corners, const Weights& weights) {
  JetPoint sum;
  for (int k = 0; k < 8; ++k) {
    if (weights[k] == 0) continue;
    for (std::size_t c = 0; c < 3; ++c) add_scaled(sum[c], weights[k], corners[static_cast<std::size_t>(k)][c]);
  }
  return sum;
}

JetPoint feature_point(const JetCorners& corners, const LocalTriple& at) {
  return weighted(corners, trilinear_weights(Vec3(at[0], at[1], at[2])));
}

/// A direction as a unit vector; nothing when it is shorter than 1e-12 (the statement then does nothing).
std::optional<JetPoint> unit(const JetPoint& v) {
  // A vector along a global axis is normalised exactly; thin factors also multiply twice as fast.
  const auto is_number = [](const Jet& jet) { return jet.size == 1 && jet.smooth && jet.c[0].low == jet.c[0].high; };
  if (std::all_of(v.begin(), v.end(), is_number)) {
    const Vec3 exact(v[0].c[0].low, v[1].c[0].low, v[2].c[0].low);
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(exact[axis]) != exact.cwiseAbs().sum() || !(std::abs(exact[axis]) > 1e-12)) continue;
      return to_jets(exact[axis] < 0 ? Vec3(-Vec3::Unit(axis)) : Vec3(Vec3::Unit(axis)));
    }
  }
  const Jet squared = dot(v, v);
  constexpr double shortest = 1e-12;
  if (squared.c[0].high < shortest * shortest) return std::nullopt;
  if (!(squared.c[0].low > shortest * shortest)) {
    JetPoint unknown;
    forget(unknown);
    return unknown;
  }
  const Jet length = sqrt(squared);
  return JetPoint{v[0] / length, v[1] / length, v[2] / length};
}

JetPoint local_axis(const JetCorners& corners, int axis) {
  LocalTriple high{0, 0, 0};
  LocalTriple low{0, 0, 0};
  high[static_cast<std::size_t>(axis)] = 1;
  low[static_cast<std::size_t>(axis)] = -1;
  return feature_point(corners, high) - feature_point(corners, low);
}

JetPoint mean(const JetCorners& corners) {
  return feature_point(corners, {0, 0, 0});
}

/// Doubles in the middle of thin intervals.
Vec3 middle(const JetPoint& point) {
  Vec3 result;
  for (std::size_t c = 0; c < 3; ++c) result[static_cast<int>(c)] = (point[c].c[0].low + point[c].c[0].high) / 2;
  return result;
}

/// point + Σₖ Nₖ(u)·(H'ₖ - Hₖ), u the point's local coordinates in H, which like the point must be constant.
void carry(const JetCorners& before, const Corners& before_middle, const JetCorners& after, JetPoint& point) {
  if (!is_constant(point)) return forget(point);
  // Newton's method stops at steps of 1e-12; a hundred times that covers its error and that of taking the middle.
  constexpr double slack = 1e-10;
  const Vec3 u = local_coordinates(before_middle, middle(point));
  for (int k = 0; k < 8; ++k) {
    Interval weight(1.0);
    for (int axis = 0; axis < 3; ++axis) {
      const Interval local(u[axis] - slack, u[axis] + slack);
      weight = weight * (0.5 * (Interval(1.0) + static_cast<double>(corner_sign(k, axis)) * local));
    }
    const auto corner = static_cast<std::size_t>(k);
    point = point + Jet(weight) * (after[corner] - before[corner]);
  }
}

/// All points of a group: its instances' corners and its own.
template <class F>
void for_each_point(JetGroup& group, bool translation, F f) {
  for (JetCorners& instance : group.instances) {
    for (JetPoint& point : instance) f(point);
  }
  if (translation) {
    f(group.start);
    f(group.end);
  } else {
    f(group.centre);
  }
}

void sync_members(const Relation& relation, JetState& state, RelationIndex r) {
  const JetGroup& group = state.groups[r];
  for (std::size_t k = 0; k < relation.parts.size(); ++k) {
    state.parts[relation.parts[k]] = group.instances[std::min(k, group.instances.size() - 1)];
  }
}

void refresh_rotation(const Shape& shape, const Rotation& rotation, const JetCorners& parent, JetGroup& group) {
  const Hexahedron& rest = shape.parts[rotation.parent].hexahedron;
  Vec3 rest_axis = Vec3::Zero();
  for (int k = 0; k < 8; ++k) {
    rest_axis += corner_sign(k, rotation.parent_axis) * rest.corners.row(k).transpose() / 8;
  }
  const double sign = rest_axis.dot(rotation.axis) < 0 ? -1 : 1;
  if (const auto direction = unit(local_axis(parent, rotation.parent_axis))) group.axis = sign * *direction;
  Jet sum;
  for (const JetCorners& instance : group.instances) {
    const JetPoint r = mean(instance) - group.centre;
    const JetPoint across = r - dot(group.axis, r) * group.axis;
    sum = sum + sqrt(dot(across, across));
  }
  group.radius = (1.0 / static_cast<double>(group.instances.size())) * sum;
}

JetCorners moved(JetCorners corners, const JetPoint& by) {
  for (JetPoint& point : corners) point = point + by;
  return corners;
}

void recount_translation(const Translation& rest, std::size_t count, std::size_t rest_count, Anchor anchor,
                         JetState& state, JetGroup& group) {
  const std::size_t n = group.instances.size();
  const JetPoint middle_point = 0.5 * (group.start + group.end);
  const Vec3 rest_step = (rest.end - rest.start) / static_cast<double>(rest_count - 1);
  const JetPoint step = n > 1 ? (1 / static_cast<double>(n - 1)) * (group.end - group.start) : to_jets(rest_step);
  const auto place = [&](std::size_t i) { return n > 1 ? group.start + static_cast<double>(i) * step : middle_point; };
  const std::size_t source = anchor == Anchor::end ? n - 1 : anchor == Anchor::middle ? (n - 1) / 2 : 0;
  const double last = static_cast<double>(count - 1);
  const auto new_place = [&](std::size_t j) -> JetPoint {
    const double i = static_cast<double>(j);
    switch (anchor) {
      case Anchor::start:
        return place(0) + i * step;
      case Anchor::end:
        return place(n - 1) + (i - last) * step;
      case Anchor::middle:
        return middle_point + (i - last / 2) * step;
      case Anchor::fit:
        break;
    }
    return count == 1 ? middle_point : group.start + (i / last) * (group.end - group.start);
  };
  const JetCorners original = group.instances[source];
  const JetPoint from = place(source);
  std::vector<JetCorners> instances;
  for (std::size_t j = 0; j < count; ++j) instances.push_back(moved(original, new_place(j) - from));
  const JetPoint start = anchor == Anchor::fit ? group.start : new_place(0);
  const JetPoint end = anchor == Anchor::fit ? group.end : new_place(count - 1);
  JetCorners& parent = state.parts[rest.parent];
  for (int k = 0; k < 8 && anchor != Anchor::fit; ++k) {
    const bool first_side = corner_sign(k, rest.axis) == -rest.direction;
    JetPoint& corner = parent[static_cast<std::size_t>(k)];
    corner = corner + (first_side ? start - group.start : end - group.end);
  }
  group.instances = std::move(instances);
  group.start = start;
  group.end = end;
}

}  // namespace

JetMotion::JetMotion(Op op, const JetPoint& origin, const JetPoint& direction, const JetPoint& normal,
                     const Jet& amount)
    : origin_(origin), displacement_(op, direction, normal, amount) {}

JetPoint JetMotion::operator()(const JetPoint& point) const {
  return point + displacement_(point - origin_);
}

void edit_parent(const Shape& shape, PartIndex parent, RelationIndex r, const JetMotion& motion,
                 const LocalTriple& feature, JetState& state) {
  const Relation& relation = shape.relations[r];
  const bool translation = relation.kind == RelationKind::translation;
  JetGroup& group = state.groups[r];
  const JetCorners before = state.parts[parent];
  JetCorners& after = state.parts[parent];
  for (int k = 0; k < 8; ++k) {
    if (selects(feature, k)) after[static_cast<std::size_t>(k)] = motion(before[static_cast<std::size_t>(k)]);
  }
  if (feature == LocalTriple{0, 0, 0}) {
    for_each_point(group, translation, [&](JetPoint& point) { point = motion(point); });
  } else if (std::all_of(before.begin(), before.end(), is_constant)) {
    Corners before_middle;
    for (int k = 0; k < 8; ++k) before_middle.row(k) = middle(before[static_cast<std::size_t>(k)]).transpose();
    for_each_point(group, translation, [&](JetPoint& point) { carry(before, before_middle, after, point); });
  } else {
    for_each_point(group, translation, [](JetPoint& point) { forget(point); });
  }
  if (!translation) refresh_rotation(shape, std::get<Rotation>(relation.detail), after, group);
  sync_members(relation, state, r);
}

void change_delta(const Shape& shape, RelationIndex r, const Jet& amount, Anchor anchor, JetState& state) {
  const Relation& relation = shape.relations[r];
  JetGroup& group = state.groups[r];
  const std::size_t n = group.instances.size();
  const auto shift = [](JetCorners& corners, const JetPoint& by) {
    for (JetPoint& point : corners) point = point + by;
  };
  if (const auto* translation = std::get_if<Translation>(&relation.detail)) {
    if (n == 1) return;
    const double last = static_cast<double>(n - 1);
    const double fixed = anchor == Anchor::start ? 0 : anchor == Anchor::end ? last : last / 2;
    const JetPoint step = amount * ((1 / last) * (group.end - group.start));
    for (std::size_t i = 0; i < n; ++i) shift(group.instances[i], (static_cast<double>(i) - fixed) * step);
    const JetPoint start_move = -fixed * step;
    const JetPoint end_move = (last - fixed) * step;
    group.start = group.start + start_move;
    group.end = group.end + end_move;
    JetCorners& parent = state.parts[translation->parent];
    for (int k = 0; k < 8; ++k) {
      const bool first_side = corner_sign(k, translation->axis) == -translation->direction;
      JetPoint& corner = parent[static_cast<std::size_t>(k)];
      corner = corner + (first_side ? start_move : end_move);
    }
  } else {
    const auto& rotation = std::get<Rotation>(relation.detail);
    for (JetCorners& instance : group.instances) {
      const JetPoint arm = mean(instance) - group.centre;
      shift(instance, amount * (arm - dot(group.axis, arm) * group.axis));
    }
    JetCorners& parent = state.parts[rotation.parent];
    const JetCorners before = parent;
    const Jet growth = amount * group.radius;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == rotation.parent_axis) continue;
      const auto direction = unit(local_axis(before, axis));
      if (!direction) continue;
      for (int k = 0; k < 8; ++k) {
        JetPoint& corner = parent[static_cast<std::size_t>(k)];
        corner = corner + (static_cast<double>(corner_sign(k, axis)) * growth) * *direction;
      }
    }
    group.radius = group.radius + growth;
  }
  sync_members(relation, state, r);
}

void change_count(const Shape& shape, RelationIndex r, const Jet& extra, Anchor anchor, JetState& state) {
  const Relation& relation = shape.relations[r];
  JetGroup& group = state.groups[r];
  if (!extra.defined || !extra.smooth) {
    const bool translation = relation.kind == RelationKind::translation;
    for_each_point(group, translation, [](JetPoint& point) { forget(point); });
    if (translation && anchor != Anchor::fit) forget(state.parts[std::get<Translation>(relation.detail).parent]);
    sync_members(relation, state, r);
    return;
  }
  const double wanted = static_cast<double>(group.instances.size()) + extra.c[0].low;
  const auto count = static_cast<std::size_t>(std::clamp(wanted, 1.0, ProgramLimits::instances));
  if (count == group.instances.size()) return;
  if (const auto* translation = std::get_if<Translation>(&relation.detail)) {
    recount_translation(*translation, count, relation.parts.size(), anchor, state, group);
  } else {
    const JetCorners original = group.instances[0];
    group.instances.clear();
    for (std::size_t k = 0; k < count; ++k) {
      // The rounding of 2πk/n' is no part of the closed form: an interval around it.
      const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(count);
      const Jet turn(Interval(detail::down(detail::down(angle)), detail::up(detail::up(angle))));
      const JetMotion rotate(Op::rotate, group.centre, group.axis, {}, turn);
      JetCorners instance;
      for (std::size_t i = 0; i < 8; ++i) instance[i] = rotate(original[i]);
      group.instances.push_back(instance);
    }
  }
  group.count_changed = true;
  sync_members(relation, state, r);
}

JetState rest_jets(const Shape& shape) {
  JetState state;
  for (const Part& part : shape.parts) state.parts.push_back(to_jets(part.hexahedron.corners));
  state.groups = RelationData<JetGroup>(shape.relations.size());
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    if (!relation.is_group()) continue;
    JetGroup& group = state.groups[r];
    for (const PartIndex p : relation.parts) group.instances.push_back(state.parts[p]);
    if (const auto* translation = std::get_if<Translation>(&relation.detail)) {
      group.start = to_jets(translation->start);
      group.end = to_jets(translation->end);
    } else {
      const auto& rotation = std::get<Rotation>(relation.detail);
      group.centre = to_jets(rotation.centre);
      group.axis = to_jets(rotation.axis);
      group.radius = Jet(rotation.radius);
    }
  }
  return state;
}

JetPoint resolve(const Shape& shape, const JetState& state, const PointReference& reference) {
  if (const auto* literal = std::get_if<Vec3>(&reference)) return to_jets(*literal);
  const auto& point = std::get<PartPoint>(reference);
  return feature_point(state.parts[*shape.find_part(point.part)], point.at);
}

std::optional<JetPoint> resolve(const Shape& shape, const JetState& state, const DirectionReference& reference) {
  if (const auto* literal = std::get_if<Vec3>(&reference)) return unit(to_jets(*literal));
  const auto& axis = std::get<PartAxis>(reference);
  return unit(local_axis(state.parts[*shape.find_part(axis.part)], axis.axis));
}

}  // namespace parsel
