#include "core/check/replay.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"
#include "core/check/replay_operator.h"

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

bool in_feature(int k, const LocalTriple& feature) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const int side = (k >> axis) % 2 == 1 ? 1 : -1;
    if (feature[axis] == -side) return false;
  }
  return true;
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
  Stage(const Replay& replay, Scene& scene) : replay_(replay), shape_(replay.shape()), scene_(scene) {}

  /// `value` of the statement's amount.
  void run(const Statement& s, double value, const Scene& start) {
    const double amount = std::isfinite(value) ? value : 0;
    if (s.op == Op::change_count || s.op == Op::change_delta) {
      const RelationIndex group = *replay_.relation(s.relation);
      edit_group(s.op, s.anchor, group, amount);
      copy_to_members(group);
      return;
    }
    bool degenerate = false;
    const auto direction = [&](const std::optional<DirectionReference>& reference) -> Vec3 {
      if (!reference) return Vec3::Zero();
      Vec3 v;
      if (const auto* axis = std::get_if<PartAxis>(&*reference)) {
        v = axis_of(start.parts[*replay_.part(axis->part)], axis->axis);
      } else {
        v = std::get<Vec3>(*reference);
      }
      if (v.norm() < 1e-12) degenerate = true;
      return v / v.norm();
    };
    Vec3 origin = Vec3::Zero();
    if (s.origin) {
      if (const auto* at = std::get_if<PartPoint>(&*s.origin)) {
        origin = feature_centre(start.parts[*replay_.part(at->part)], at->at);
      } else {
        origin = std::get<Vec3>(*s.origin);
      }
    }
    const Vec3 d = direction(s.direction);
    const Vec3 n = direction(s.normal);
    if (degenerate) return;
    edit_part(*replay_.part(s.part), s.feature, affine_of(s.op, origin, d, n, amount));
  }

 private:
  void edit_part(PartIndex p, const LocalTriple& feature, const Affine& map) {
    const Part& part = shape_.parts[p];
    Box& box = scene_.parts[p];
    const Box before = box;
    for (int k = 0; k < 8; ++k) {
      if (in_feature(k, feature)) box[static_cast<std::size_t>(k)] = map(before[static_cast<std::size_t>(k)]);
    }
    if (!part.group) return;
    Group& group = scene_.groups[*part.group];
    if (part.is_virtual()) {
      carry_group(shape_.relations[*part.group], group, before, box, feature, map);
      return copy_to_members(*part.group);
    }
    group.instances[std::min(replay_.place(p), group.instances.size() - 1)] = box;
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

  void copy_to_members(RelationIndex r) {
    const std::vector<PartIndex>& members = shape_.relations[r].parts;
    const Group& group = scene_.groups[r];
    for (std::size_t k = 0; k < members.size(); ++k) {
      scene_.parts[members[k]] = group.instances[std::min(k, group.instances.size() - 1)];
    }
  }

  void edit_group(Op op, Anchor anchor, RelationIndex r, double amount) {
    const Relation& relation = shape_.relations[r];
    Group& group = scene_.groups[r];
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
    Box& parent = scene_.parts[line.parent];
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
    group.recounted = true;
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
    Box& parent = scene_.parts[ring.parent];
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
    group.recounted = true;
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

  const Replay& replay_;
  const Shape& shape_;
  Scene& scene_;
};

}  // namespace

Replay::Replay(const Shape& shape, const Program& program)
    : shape_(&shape), program_(&program), places_(shape.parts.size()) {
  for (const Layer& layer : program.layers) {
    std::vector<std::string>& texts = texts_.emplace_back();
    for (const Statement& statement : layer.statements) texts.push_back(statement.amount.text());
  }
  for (const PartIndex p : shape.parts.indices()) parts_[shape.parts[p].id] = p;
  for (const RelationIndex r : shape.relations.indices()) {
    relations_[shape.relations[r].id] = r;
    if (!shape.relations[r].is_group()) continue;
    const std::vector<PartIndex>& members = shape.relations[r].parts;
    for (std::size_t k = 0; k < members.size(); ++k) places_[members[k]] = k;
  }
}

std::optional<PartIndex> Replay::part(const std::string& name) const {
  const auto found = parts_.find(name);
  return found == parts_.end() ? shape_->find_part(name) : std::optional(found->second);  // "node:3" is a name as well
}

std::optional<RelationIndex> Replay::relation(const std::string& id) const {
  const auto found = relations_.find(id);
  return found == relations_.end() ? std::nullopt : std::optional(found->second);
}

Scene Replay::rest() const {
  Scene scene;
  for (const Part& part : shape_->parts) scene.parts.push_back(box_of(part.hexahedron.corners));
  for (const Relation& relation : shape_->relations) {
    Group group;
    if (relation.is_group()) {
      for (const PartIndex p : relation.parts) {
        group.instances.push_back(scene.parts[p]);
        group.source.push_back(static_cast<int>(group.source.size()));
      }
    }
    if (const auto* line = std::get_if<Translation>(&relation.detail)) {
      group.start = line->start;
      group.end = line->end;
    } else if (const auto* ring = std::get_if<Rotation>(&relation.detail)) {
      group.centre = ring->centre;
      group.axis = ring->axis;
      group.radius = ring->radius;
    }
    scene.groups.push_back(std::move(group));
  }
  return scene;
}

double Replay::amount(std::size_t layer, std::size_t statement, const Values& parameters) const {
  return value_of(texts_[layer][statement], parameters);
}

void Replay::run(std::size_t layer, std::size_t statement, const Scene& start, const Values& parameters,
                 Scene& scene) const {
  const Statement& s = program_->layers[layer].statements[statement];
  if (s.op != Op::keep_fixed) Stage(*this, scene).run(s, amount(layer, statement, parameters), start);
}

Scene Replay::scene(std::size_t layers, const Values& parameters) const {
  Scene scene = rest();
  for (std::size_t l = 0; l < layers; ++l) {
    const Scene start = scene;
    const std::size_t statements = program_->layers[l].statements.size();
    for (std::size_t i = 0; i < statements; ++i) run(l, i, start, parameters, scene);
  }
  return scene;
}

}  // namespace parsel::replay
