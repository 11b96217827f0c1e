#include "core/check/tie.h"

#include <algorithm>
#include <cmath>

#include "core/base/tolerance.h"
#include "core/check/replay_operator.h"

namespace parsel::replay {

namespace {

double largest(const Vec3& v) {
  return v.cwiseAbs().maxCoeff();
}

}  // namespace

Tie::Tie(const Shape& shape, RelationIndex index) : index_(index), relation_(&shape.relations[index]) {
  if (relation_->is_group()) return;
  for (const PartIndex p : relation_->parts) {
    if (shape.parts[p].group && !shape.parts[p].is_virtual()) instances_of_.push_back(*shape.parts[p].group);
  }
  if (const auto* ground = std::get_if<Ground>(&relation_->detail)) {
    const Box rest = box_of(shape.parts[relation_->parts[0]].hexahedron.corners);
    for (const Vec3& local : ground->local) {
      feet_.push_back({blend(local), 0});
      feet_.back().rest = feet_.back().height(rest);
    }
  }
  const auto* attachment = std::get_if<Attachment>(&relation_->detail);
  if (!attachment) return;
  for (std::size_t i = 0; i < attachment->points.size(); ++i) {
    Joint joint{blend(attachment->local_a[i]), blend(attachment->local_b[i]), Vec3::Zero()};
    joint.rest = joint.between(box_of(shape.parts[relation_->parts[0]].hexahedron.corners),
                               box_of(shape.parts[relation_->parts[1]].hexahedron.corners));
    joints_.push_back(joint);
  }
}

Vec3 Tie::Joint::between(const Box& a, const Box& b) const {
  Vec3 apart = Vec3::Zero();
  for (std::size_t k = 0; k < 8; ++k) apart += in_a[k] * a[k] - in_b[k] * b[k];
  return apart;
}

double Tie::Foot::height(const Box& part) const {
  double y = 0;
  for (std::size_t k = 0; k < 8; ++k) y += in[k] * part[k].y();
  return y;
}

bool Tie::exists(const Scene& scene) const {
  return std::none_of(instances_of_.begin(), instances_of_.end(),
                      [&](RelationIndex group) { return scene.groups[group].recounted; });
}

double Tie::off(const Scene& scene) const {
  if (!exists(scene)) return 0;
  double worst = 0;
  if (relation_->is_group()) {
    const Group& group = scene.groups[index_];
    const auto n = static_cast<int>(group.instances.size());
    for (int i = 1; i < n; ++i) {
      const Mat3 turn = rotation(group.axis, 2 * pi * i / n);
      for (std::size_t k = 0; k < 8; ++k) {
        const Vec3& first = group.instances[0][k];
        const Vec3 expected = relation_->kind == RelationKind::translation
                                  ? Vec3(first + i * (group.end - group.start) / (n - 1))
                                  : Vec3(group.centre + turn * (first - group.centre));
        worst = std::max(worst, largest(group.instances[static_cast<std::size_t>(i)][k] - expected));
      }
    }
    return worst;
  }
  const Box& a = scene.parts[relation_->parts[0]];
  for (const Foot& foot : feet_) worst = std::max(worst, std::abs(foot.height(a) - foot.rest));
  if (relation_->parts.size() == 1) return worst;
  const Box& b = scene.parts[relation_->parts[1]];
  if (const auto* mirror = std::get_if<Reflection>(&relation_->detail)) {
    for (std::size_t k = 0; k < 8; ++k) {
      const Vec3& p = a[static_cast<std::size_t>(mirror->corner_map[k])];
      const Vec3 image = p - 2 * (p - mirror->origin).dot(mirror->normal) * mirror->normal;
      worst = std::max(worst, largest(b[k] - image));
    }
  }
  for (const Joint& joint : joints_) worst = std::max(worst, largest(joint.between(a, b) - joint.rest));
  return worst;
}

}  // namespace parsel::replay
