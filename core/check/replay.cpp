#include "core/check/replay.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"

namespace parsel::replay {

namespace {

Vec3 sum_of(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum;
}

/// The mean of the corners that a feature selects: its centre.
Vec3 feature_centre(const Box& box, const LocalTriple& at) {
  std::vector<Vec3> chosen;
  for (int k = 0; k < 8; ++k) {
    bool belongs = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int side = (k >> axis) % 2 == 1 ? 1 : -1;
      belongs = belongs && (at[axis] == 0 || at[axis] == side);
    }
    if (belongs) chosen.push_back(box[static_cast<std::size_t>(k)]);
  }
  return sum_of(chosen) / static_cast<double>(chosen.size());
}

Vec3 centre_of(const Box& box) {
  return feature_centre(box, {0, 0, 0});
}

/// From the face centre at -1 to that at +1 along a local axis, not normalised.
Vec3 axis_of(const Box& box, int axis) {
  LocalTriple plus{0, 0, 0};
  plus[static_cast<std::size_t>(axis)] = 1;
  LocalTriple minus{0, 0, 0};
  minus[static_cast<std::size_t>(axis)] = -1;
  return feature_centre(box, plus) - feature_centre(box, minus);
}

Mat3 rotation(const Vec3& n, double angle) {
  Mat3 skew;
  skew << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return std::cos(angle) * Mat3::Identity() + std::sin(angle) * skew + (1 - std::cos(angle)) * n * n.transpose();
}

/// Every geometric operator is p → o + M (p - o) + t.
struct Affine {
  Mat3 matrix = Mat3::Identity();
  Vec3 origin = Vec3::Zero(), shift = Vec3::Zero();
  Vec3 operator()(const Vec3& p) const { return origin + matrix * (p - origin) + shift; }
};

Affine affine_of(Op op, const Vec3& origin, const Vec3& direction, const Vec3& normal, double amount) {
  Affine map;
  map.origin = origin;
  if (op == Op::translate) map.shift = amount * direction;
  if (op == Op::rotate) map.matrix = rotation(direction, amount);
  if (op == Op::scale_1d) map.matrix += amount * direction * direction.transpose();
  if (op == Op::scale_2d) map.matrix += amount * (Mat3::Identity() - normal * normal.transpose());
  if (op == Op::scale_3d) map.matrix *= 1 + amount;
  if (op == Op::shear) map.matrix += amount * direction * normal.transpose();
  return map;
}

bool in_feature(int k, const LocalTriple& feature) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int side = (k >> axis) % 2 == 1 ? 1 : -1;
    if (feature[axis] == -side) return false;
  }
  return true;
}

std::array<double, 8> blend(const Vec3& u) {
  std::array<double, 8> weights;
  for (int k = 0; k < 8; ++k) {
    const double x = k % 2 == 1 ? (1 + u.x()) / 2 : (1 - u.x()) / 2;
    const double y = k / 2 % 2 == 1 ? (1 + u.y()) / 2 : (1 - u.y()) / 2;
    const double z = k / 4 == 1 ? (1 + u.z()) / 2 : (1 - u.z()) / 2;
    weights[static_cast<std::size_t>(k)] = x * y * z;
  }
  return weights;
}

Vec3 blended(const Box& box, const Vec3& u) {
  const auto weights = blend(u);
  Vec3 point = Vec3::Zero();
  for (std::size_t k = 0; k < 8; ++k) point += weights[k] * box[k];
  return point;
}

/// Local coordinates by Newton's method; the derivative along a local axis is exact from two points, as the map is
/// linear along it.
Vec3 inverse_blend(const Box& box, const Vec3& point) {
  Vec3 u = Vec3::Zero();
  for (int step = 0; step < 60; ++step) {
    Mat3 jacobian;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 ahead = u;
      ahead[axis] += 1;
      jacobian.col(axis) = blended(box, ahead) - blended(box, u);
    }
    const Vec3 move = jacobian.fullPivLu().solve(point - blended(box, u));
    u += move;
    if (move.cwiseAbs().maxCoeff() < 1e-14) break;
  }
  return u;
}

class Stage {
 public:
  Stage(const Shape& shape, Scene& scene) : shape_(shape), scene_(scene) {}

  void run(const Layer& layer, const std::map<std::string, double>& parameters) {
    const Scene start = scene_;
    for (const Statement& s : layer.statements) {
      if (s.op == Op::keep_fixed) continue;
      const double value = value_of(s.amount.text(), parameters);
      const double amount = std::isfinite(value) ? value : 0;
      if (s.op == Op::change_count || s.op == Op::change_delta) {
        const Relation& relation = shape_.relations[*shape_.find_relation(s.relation)];
        edit_group(s.op, s.anchor, relation, amount);
        copy_to_members(relation);
        continue;
      }
      bool degenerate = false;
      const auto direction = [&](const std::optional<DirectionReference>& reference) -> Vec3 {
        if (!reference) return Vec3::Zero();
        Vec3 v;
        if (const auto* axis = std::get_if<PartAxis>(&*reference)) {
          v = axis_of(start.parts.at(shape_.parts[*shape_.find_part(axis->part)].id), axis->axis);
        } else {
          v = std::get<Vec3>(*reference);
        }
        if (v.norm() < 1e-12) degenerate = true;
        return v / v.norm();
      };
      Vec3 origin = Vec3::Zero();
      if (s.origin) {
        if (const auto* at = std::get_if<PartPoint>(&*s.origin)) {
          origin = feature_centre(start.parts.at(shape_.parts[*shape_.find_part(at->part)].id), at->at);
        } else {
          origin = std::get<Vec3>(*s.origin);
        }
      }
      const Vec3 d = direction(s.direction);
      const Vec3 n = direction(s.normal);
      if (degenerate) continue;
      edit_part(shape_.parts[*shape_.find_part(s.part)], s.feature, affine_of(s.op, origin, d, n, amount));
    }
  }

 private:
  void edit_part(const Part& part, const LocalTriple& feature, const Affine& map) {
    Box& box = scene_.parts.at(part.id);
    const Box before = box;
    for (int k = 0; k < 8; ++k) {
      if (in_feature(k, feature)) box[static_cast<std::size_t>(k)] = map(before[static_cast<std::size_t>(k)]);
    }
    if (!part.group) return;
    const Relation& relation = shape_.relations[*part.group];
    Group& group = scene_.groups.at(relation.id);
    if (part.is_virtual()) {
      carry_group(relation, group, before, box, feature, map);
      return copy_to_members(relation);
    }
    for (std::size_t k = 0; k < relation.parts.size(); ++k) {
      if (shape_.parts[relation.parts[k]].id == part.id) group.instances[std::min(k, group.instances.size() - 1)] = box;
    }
  }

  void carry_group(const Relation& relation, Group& group, const Box& before, const Box& after,
                   const LocalTriple& feature, const Affine& map) {
    const bool whole = feature == LocalTriple{0, 0, 0};
    const auto carry = [&](Vec3& point) {
      if (whole) {
        point = map(point);
        return;
      }
      const Vec3 u = inverse_blend(before, point);
      point += blended(after, u) - blended(before, u);
    };
    for (Box& instance : group.instances) std::for_each(instance.begin(), instance.end(), carry);
    carry(group.start);
    carry(group.end);
    carry(group.centre);
    const auto* ring = std::get_if<Rotation>(&relation.detail);
    if (!ring) return;
    const Box rest = box_of(shape_.parts[ring->parent].hexahedron.corners);
    const double sign = axis_of(rest, ring->parent_axis).dot(ring->axis) < 0 ? -1 : 1;
    const Vec3 axis = axis_of(after, ring->parent_axis);
    if (axis.norm() >= 1e-12) group.axis = sign * axis / axis.norm();
    group.radius = 0;
    for (const Box& instance : group.instances) group.radius += spoke(group, instance).norm();
    group.radius /= static_cast<double>(group.instances.size());
  }

  static Vec3 spoke(const Group& group, const Box& instance) {
    const Vec3 arm = centre_of(instance) - group.centre;
    return arm - arm.dot(group.axis) * group.axis;
  }

  void copy_to_members(const Relation& relation) {
    const Group& group = scene_.groups.at(relation.id);
    for (std::size_t k = 0; k < relation.parts.size(); ++k) {
      scene_.parts.at(shape_.parts[relation.parts[k]].id) = group.instances[std::min(k, group.instances.size() - 1)];
    }
  }

  void edit_group(Op op, Anchor anchor, const Relation& relation, double amount) {
    Group& group = scene_.groups.at(relation.id);
    const int n = static_cast<int>(group.instances.size());
    const double added = std::floor(amount + 1e-9);
    const int count = static_cast<int>(std::min(std::max(n + added, 1.0), 1000.0));
    if (const auto* line = std::get_if<Translation>(&relation.detail)) {
      if (op == Op::change_delta) return space_line(*line, group, anchor, amount);
      if (count != n) return count_line(*line, static_cast<int>(relation.parts.size()), group, anchor, count);
    } else {
      const auto& ring = std::get<Rotation>(relation.detail);
      if (op == Op::change_delta) return space_ring(ring, group, amount);
      if (count != n) return count_ring(group, count);
    }
  }

  void move_sides(const Translation& line, const Vec3& with_start, const Vec3& with_end) {
    Box& parent = scene_.parts.at(shape_.parts[line.parent].id);
    for (int k = 0; k < 8; ++k) {
      const int side = (k >> line.axis) % 2 == 1 ? 1 : -1;
      parent[static_cast<std::size_t>(k)] += side == line.direction ? with_end : with_start;
    }
  }

  static void shift(Box& box, const Vec3& by) {
    for (Vec3& corner : box) corner += by;
  }

  void space_line(const Translation& line, Group& group, Anchor anchor, double amount) {
    const int n = static_cast<int>(group.instances.size());
    if (n == 1) return;
    const Vec3 delta = (group.end - group.start) / (n - 1);
    double still = (n - 1) / 2.0;
    if (anchor == Anchor::start) still = 0;
    if (anchor == Anchor::end) still = n - 1;
    for (int i = 0; i < n; ++i) shift(group.instances[static_cast<std::size_t>(i)], (i - still) * amount * delta);
    const Vec3 with_start = -still * amount * delta;
    const Vec3 with_end = (n - 1 - still) * amount * delta;
    group.start += with_start;
    group.end += with_end;
    move_sides(line, with_start, with_end);
  }

  void count_line(const Translation& line, int count_at_rest, Group& group, Anchor anchor, int count) {
    const int n = static_cast<int>(group.instances.size());
    const Vec3 middle = (group.start + group.end) / 2;
    const Vec3 first = n == 1 ? middle : group.start;
    const Vec3 last = n == 1 ? middle : group.end;
    const Vec3 delta =
        n == 1 ? Vec3((line.end - line.start) / (count_at_rest - 1)) : Vec3((group.end - group.start) / (n - 1));
    int copied = 0;
    if (anchor == Anchor::end) copied = n - 1;
    if (anchor == Anchor::middle) copied = (n - 1) / 2;
    std::vector<Vec3> places;
    for (int j = 0; j < count; ++j) {
      if (anchor == Anchor::start) places.push_back(first + j * delta);
      if (anchor == Anchor::end) places.push_back(last - (count - 1 - j) * delta);
      if (anchor == Anchor::middle) places.push_back(middle + (j - (count - 1) / 2.0) * delta);
      if (anchor == Anchor::fit && count == 1) places.push_back(middle);
      if (anchor == Anchor::fit && count > 1) {
        places.push_back(group.start + j * (group.end - group.start) / (count - 1));
      }
    }
    const Box original = group.instances[static_cast<std::size_t>(copied)];
    const int source = group.source[static_cast<std::size_t>(copied)];
    const Vec3 from = first + copied * delta;
    group.instances.assign(places.size(), original);
    group.source.assign(places.size(), source);
    for (std::size_t j = 0; j < places.size(); ++j) shift(group.instances[j], places[j] - from);
    if (anchor == Anchor::fit) return;
    move_sides(line, places.front() - group.start, places.back() - group.end);
    group.start = places.front();
    group.end = places.back();
  }

  void space_ring(const Rotation& ring, Group& group, double amount) {
    for (Box& instance : group.instances) shift(instance, amount * spoke(group, instance));
    Box& parent = scene_.parts.at(shape_.parts[ring.parent].id);
    const Box before = parent;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 along = axis_of(before, axis);
      if (axis == ring.parent_axis || along.norm() < 1e-12) continue;
      for (int k = 0; k < 8; ++k) {
        const int side = (k >> axis) % 2 == 1 ? 1 : -1;
        parent[static_cast<std::size_t>(k)] += amount * group.radius * side * along / along.norm();
      }
    }
    group.radius *= 1 + amount;
  }

  static void count_ring(Group& group, int count) {
    const Box original = group.instances[0];
    group.instances.assign(static_cast<std::size_t>(count), original);
    const int source = group.source[0];  // assign() must not be given one of its own elements
    group.source.assign(static_cast<std::size_t>(count), source);
    for (int k = 0; k < count; ++k) {
      const Mat3 turn = rotation(group.axis, 2 * pi * k / count);
      for (Vec3& corner : group.instances[static_cast<std::size_t>(k)]) {
        corner = group.centre + turn * (corner - group.centre);
      }
    }
  }

  const Shape& shape_;
  Scene& scene_;
};

double largest(const Vec3& v) {
  return v.cwiseAbs().maxCoeff();
}

}  // namespace

Box box_of(const Corners& corners) {
  Box box;
  for (int k = 0; k < 8; ++k) box[static_cast<std::size_t>(k)] = corners.row(k).transpose();
  return box;
}

Scene scene_of(const Shape& shape, const Program& program, std::size_t layers,
               const std::map<std::string, double>& parameters) {
  Scene scene;
  for (const Part& part : shape.parts) scene.parts[part.id] = box_of(part.hexahedron.corners);
  for (const Relation& relation : shape.relations) {
    if (!relation.is_group()) continue;
    Group group;
    for (const PartIndex p : relation.parts) {
      group.instances.push_back(box_of(shape.parts[p].hexahedron.corners));
      group.source.push_back(static_cast<int>(group.source.size()));
    }
    if (const auto* line = std::get_if<Translation>(&relation.detail)) {
      group.start = line->start;
      group.end = line->end;
    } else {
      const auto& ring = std::get<Rotation>(relation.detail);
      group.centre = ring.centre;
      group.axis = ring.axis;
      group.radius = ring.radius;
    }
    scene.groups[relation.id] = std::move(group);
  }
  Stage stage(shape, scene);
  for (std::size_t l = 0; l < layers; ++l) stage.run(program.layers[l], parameters);
  return scene;
}

double deviation_of(const Shape& shape, const Relation& relation, const Scene& scene) {
  double worst = 0;
  if (relation.is_group()) {
    const Group& group = scene.groups.at(relation.id);
    const auto n = static_cast<int>(group.instances.size());
    for (int i = 1; i < n; ++i) {
      const Mat3 turn = rotation(group.axis, 2 * pi * i / n);
      for (std::size_t k = 0; k < 8; ++k) {
        const Vec3& first = group.instances[0][k];
        const Vec3 expected = relation.kind == RelationKind::translation
                                  ? Vec3(first + i * (group.end - group.start) / (n - 1))
                                  : Vec3(group.centre + turn * (first - group.centre));
        worst = std::max(worst, largest(group.instances[static_cast<std::size_t>(i)][k] - expected));
      }
    }
    return worst;
  }
  if (const auto* ground = std::get_if<Ground>(&relation.detail)) {
    const Part& part = shape.parts[relation.parts[0]];
    const Box rest = box_of(part.hexahedron.corners);
    for (const Vec3& local : ground->local) {
      worst = std::max(worst, std::abs(blended(scene.parts.at(part.id), local).y() - blended(rest, local).y()));
    }
    return worst;
  }
  const Part& part_a = shape.parts[relation.parts[0]];
  const Part& part_b = shape.parts[relation.parts[1]];
  const Box& a = scene.parts.at(part_a.id);
  const Box& b = scene.parts.at(part_b.id);
  if (const auto* mirror = std::get_if<Reflection>(&relation.detail)) {
    for (std::size_t k = 0; k < 8; ++k) {
      const Vec3& p = a[static_cast<std::size_t>(mirror->corner_map[k])];
      const Vec3 image = p - 2 * (p - mirror->origin).dot(mirror->normal) * mirror->normal;
      worst = std::max(worst, largest(b[k] - image));
    }
    return worst;
  }
  const auto& attachment = std::get<Attachment>(relation.detail);
  const Box rest_a = box_of(part_a.hexahedron.corners);
  const Box rest_b = box_of(part_b.hexahedron.corners);
  for (std::size_t i = 0; i < attachment.points.size(); ++i) {
    const Vec3 moved_a = blended(a, attachment.local_a[i]) - blended(rest_a, attachment.local_a[i]);
    const Vec3 moved_b = blended(b, attachment.local_b[i]) - blended(rest_b, attachment.local_b[i]);
    worst = std::max(worst, largest(moved_a - moved_b));
  }
  return worst;
}

double smallest_volume(const Box& box, const Box& rest) {
  const auto at_corner = [](const Box& b, int k) {
    Mat3 edges;
    for (int axis = 0; axis < 3; ++axis) {
      edges.col(axis) = b[static_cast<std::size_t>(k | (1 << axis))] - b[static_cast<std::size_t>(k & ~(1 << axis))];
    }
    return edges.determinant();
  };
  double smallest = 1e300;
  for (int k = 0; k < 8; ++k) smallest = std::min(smallest, at_corner(box, k) / at_corner(rest, k));
  return smallest;
}

}  // namespace parsel::replay
