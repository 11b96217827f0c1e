#include "core/edit/group_edit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/edit/cage.h"

namespace parsel {

namespace {

Vec3 centre_of(const Corners& corners) {
  return corners.colwise().mean().transpose();
}

void move(Corners& corners, const Vec3& by) {
  corners.rowwise() += by.transpose();
}

/// From the ring's axis to the instance's centre, across the axis.
Vec3 spoke(const GroupState& state, const Corners& instance) {
  const Vec3 r = centre_of(instance) - state.centre;
  return r - r.dot(state.axis) * state.axis;
}

std::size_t new_count(std::size_t n, double amount) {
  const double wanted = static_cast<double>(n) + counted(amount);
  return static_cast<std::size_t>(std::clamp(wanted, 1.0, ProgramLimits::instances));
}

/// Where the instances of a line stand.
struct Line {
  std::size_t n;
  Vec3 first, last, delta;

  Line(const Group& group, const GroupState& state) : n(state.instances.size()) {
    first = state.start;
    last = state.end;
    delta = group.rest_delta;
    if (n > 1) {
      delta = (last - first) / static_cast<double>(n - 1);
    } else {
      first = last = (state.start + state.end) / 2;
    }
  }
  Vec3 position(std::size_t i) const { return first + static_cast<double>(i) * delta; }
};

/// The parent's first and last side follow the group's start and end.
void move_sides(const Group& group, const Vec3& by_start, const Vec3& by_end, Corners& parent) {
  for (int k = 0; k < 8; ++k) {
    const bool first = corner_sign(k, group.axis) == -group.direction;
    parent.row(k) += (first ? by_start : by_end).transpose();
  }
}

void change_line_delta(const Group& group, double amount, Anchor anchor, Corners& parent, GroupState& state) {
  const Line line(group, state);
  if (line.n == 1) return;
  const double last = static_cast<double>(line.n - 1);
  const double fixed = anchor == Anchor::start ? 0 : anchor == Anchor::end ? last : last / 2;
  const auto shift = [&](double i) -> Vec3 { return (i - fixed) * amount * line.delta; };
  for (std::size_t i = 0; i < line.n; ++i) move(state.instances[i], shift(static_cast<double>(i)));
  state.start += shift(0);
  state.end += shift(last);
  move_sides(group, shift(0), shift(last), parent);
}

void change_line_count(const Group& group, double amount, Anchor anchor, Corners& parent, GroupState& state) {
  const Line line(group, state);
  const std::size_t n = new_count(line.n, amount);
  if (n == line.n) return;
  const Vec3 middle = (state.start + state.end) / 2;
  std::size_t copied = 0;
  Vec3 first = line.first;
  Vec3 delta = line.delta;
  const double last = static_cast<double>(n - 1);
  switch (anchor) {
    case Anchor::start:
      break;
    case Anchor::end:
      copied = line.n - 1;
      first = line.last - last * delta;
      break;
    case Anchor::middle:
      copied = (line.n - 1) / 2;
      first = middle - last / 2 * delta;
      break;
    case Anchor::fit:
      first = n == 1 ? middle : state.start;
      if (n > 1) delta = (state.end - state.start) / last;
      break;
  }
  const Corners original = state.instances[copied];
  const Vec3 from = line.position(copied);
  state.instances.assign(n, original);
  for (std::size_t i = 0; i < n; ++i) move(state.instances[i], first + static_cast<double>(i) * delta - from);
  if (!state.count_changed) state.source = static_cast<int>(copied);
  state.count_changed = true;
  if (anchor == Anchor::fit) return;
  const Vec3 end = first + last * delta;
  move_sides(group, first - state.start, end - state.end, parent);
  state.start = first;
  state.end = end;
}

void change_ring_delta(const Group& group, double amount, Corners& parent, GroupState& state) {
  for (Corners& instance : state.instances) move(instance, amount * spoke(state, instance));
  const Corners before = parent;
  for (int axis = 0; axis < 3; ++axis) {
    const auto direction = axis_direction(before, axis);
    if (axis == group.axis || !direction) continue;
    for (int k = 0; k < 8; ++k) {
      parent.row(k) += amount * state.radius * corner_sign(k, axis) * direction->transpose();
    }
  }
  state.radius *= 1 + amount;
}

void change_ring_count(double amount, GroupState& state) {
  const std::size_t n = new_count(state.instances.size(), amount);
  if (n == state.instances.size()) return;
  ResolvedOperator turn;
  turn.op = Op::rotate;
  turn.origin = state.centre;
  turn.direction = state.axis;
  const Corners original = state.instances[0];
  state.instances.assign(n, original);
  for (std::size_t i = 0; i < n; ++i) {
    apply_operator(turn, 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n), state.instances[i]);
  }
  if (!state.count_changed) state.source = 0;
  state.count_changed = true;
}

/// How a point that rides on the parent moves with it.
class Ride {
 public:
  Ride(const ResolvedOperator& op, double amount, const Corners& before, const Corners& after)
      : op_(op), amount_(amount), before_(before), shift_(after - before) {
    whole_ = op.feature == LocalTriple{0, 0, 0};
  }
  Vec3 operator()(const Vec3& point) const {
    if (whole_) return displaced(op_, amount_, point);
    return point + interpolate(trilinear_weights(local_coordinates(before_, point)), shift_);
  }

 private:
  const ResolvedOperator& op_;
  double amount_;
  const Corners& before_;
  Corners shift_;
  bool whole_;
};

void follow_parent_axis(const Group& group, const Corners& parent, GroupState& state) {
  if (const auto direction = axis_direction(parent, group.axis)) state.axis = group.direction * *direction;
  double sum = 0;
  for (const Corners& instance : state.instances) sum += spoke(state, instance).norm();
  state.radius = sum / static_cast<double>(state.instances.size());
}

}  // namespace

std::vector<Group> groups_of(const Shape& shape) {
  std::vector<Group> groups;
  for (const RelationIndex r : shape.relations.indices()) {
    const Relation& relation = shape.relations[r];
    Group group;
    group.relation = r;
    group.members = relation.parts;
    if (const auto* line = std::get_if<Translation>(&relation.detail)) {
      group.parent = line->parent;
      group.axis = line->axis;
      group.direction = line->direction;
      group.rest_delta = (line->end - line->start) / static_cast<double>(relation.parts.size() - 1);
    } else if (const auto* ring = std::get_if<Rotation>(&relation.detail)) {
      group.parent = ring->parent;
      group.ring = true;
      group.axis = ring->parent_axis;
      const auto direction = axis_direction(shape.parts[ring->parent].hexahedron.corners, ring->parent_axis);
      group.direction = direction && direction->dot(ring->axis) < 0 ? -1 : 1;
    } else {
      continue;
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

void edit_parent(const Group& group, const ResolvedOperator& op, double amount, Corners& parent, GroupState& state) {
  const Corners before = parent;
  apply_operator(op, amount, parent);
  const Ride ride(op, amount, before, parent);
  for (Corners& instance : state.instances) {
    for (int k = 0; k < 8; ++k) instance.row(k) = ride(instance.row(k).transpose()).transpose();
  }
  if (group.ring) {
    state.centre = ride(state.centre);
    follow_parent_axis(group, parent, state);
  } else {
    state.start = ride(state.start);
    state.end = ride(state.end);
  }
}

void edit_group(const Group& group, Op op, double amount, Anchor anchor, Corners& parent, GroupState& state) {
  PARSEL_ASSERT(!is_geometric(op), "geometric operators edit parts");
  if (op == Op::change_count) {
    group.ring ? change_ring_count(amount, state) : change_line_count(group, amount, anchor, parent, state);
  } else {
    group.ring ? change_ring_delta(group, amount, parent, state)
               : change_line_delta(group, amount, anchor, parent, state);
  }
}

}  // namespace parsel
