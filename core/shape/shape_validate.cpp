// The audit of a shape: what every stage may rely on.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "core/base/tolerance.h"
#include "core/shape/attachment.h"
#include "core/shape/shape.h"

namespace parsel {
namespace {

/// Symmetries hold exactly by construction; what JSON and arithmetic leave is far below this.
constexpr double symmetry_slack = 1e-6;
/// The two parts' attachment points are put onto their own features independently.
constexpr double attachment_slack = 4 * snap_distance;

class Validator {
 public:
  explicit Validator(const Shape& shape) : shape_(shape) {}

  Status run() const {
    if (!shape_.frame.centre.allFinite() || !(shape_.frame.scale > 0) || !std::isfinite(shape_.frame.scale)) {
      return wrong("frame", "it is not finite and positive");
    }
    const Mat3& axes = shape_.frame.axes;
    if (!((axes * axes.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() <= symmetry_slack) ||
        !(axes.determinant() > 0)) {
      return wrong("frame", "its axes are not unit, perpendicular and right-handed");
    }
    std::set<std::string> ids;
    for (const PartIndex p : shape_.parts.indices()) {
      if (shape_.parts[p].id.empty() || !ids.insert(shape_.parts[p].id).second) {
        return wrong("part " + std::to_string(p.value()), "its id is empty or taken");
      }
      if (Status s = check_part(p); !s.ok()) return s;
    }
    ids.clear();
    for (const RelationIndex r : shape_.relations.indices()) {
      const Relation& relation = shape_.relations[r];
      if (relation.id.empty() || !ids.insert(relation.id).second) {
        return wrong("relation " + std::to_string(r.value()), "its id is empty or taken");
      }
      if (Status s = check_relation(r); !s.ok()) return s;
    }
    return success();
  }

 private:
  static Error wrong(std::string place, std::string cause) {
    return {"shape/validate", std::move(place), std::move(cause), "make the shape anew with parsel inspect"};
  }
  bool exists(PartIndex p) const { return p.value() < shape_.parts.size(); }
  const Corners& corners(PartIndex p) const { return shape_.parts[p].hexahedron.corners; }
  static double worst(const Corners& a, const Corners& b) { return (a - b).cwiseAbs().maxCoeff(); }

  Status check_part(PartIndex index) const {
    const Part& part = shape_.parts[index];
    const Hexahedron& h = part.hexahedron;
    if (!h.corners.allFinite() || !h.axes.allFinite()) return wrong(part.id, "its hexahedron is not finite");
    if (h.half_extents().minCoeff() <= 0) return wrong(part.id, "its hexahedron has no volume");
    const Hexahedron box = make_box(h.corners.colwise().mean().transpose(), h.axes, h.half_extents());
    if ((h.axes * h.axes.transpose() - Mat3::Identity()).cwiseAbs().maxCoeff() > symmetry_slack ||
        h.axes.determinant() < 0 || worst(box.corners, h.corners) > symmetry_slack) {
      return wrong(part.id, "its hexahedron is not an upright box along its axes");
    }
    if (part.is_virtual() != (part.node < 0) || part.is_virtual() != (part.primitive < 0)) {
      return wrong(part.id, "a real part has a node and a primitive, a virtual one instances");
    }
    if (part.is_virtual() && !part.group) return wrong(part.id, "a virtual part stands for a group");
    if (!part.group) return success();
    if (part.group->value() >= shape_.relations.size()) return wrong(part.id, "its group does not exist");
    const Relation& group = shape_.relations[*part.group];
    if (!group.is_group()) return wrong(part.id, "its group is no translation or rotation");
    if (!part.is_virtual() && std::count(group.parts.begin(), group.parts.end(), index) != 1) {
      return wrong(part.id, "its group does not know it");
    }
    if (part.is_virtual() && group.parts != part.members) return wrong(part.id, "its group has other instances");
    return success();
  }

  Status check_relation(RelationIndex index) const {
    const Relation& relation = shape_.relations[index];
    std::set<PartIndex> parts(relation.parts.begin(), relation.parts.end());
    if (parts.size() != relation.parts.size()) return wrong(relation.id, "a part occurs twice");
    for (const PartIndex p : parts) {
      if (!exists(p)) return wrong(relation.id, "it names a part that does not exist");
    }
    const std::size_t wanted = relation.kind == RelationKind::reflection    ? 0
                               : relation.kind == RelationKind::translation ? 1
                               : relation.kind == RelationKind::rotation    ? 2
                               : relation.kind == RelationKind::ground      ? 4
                                                                            : 3;
    if (relation.detail.index() != wanted) return wrong(relation.id, "its fields are not those of its kind");
    if (relation.is_group()) return check_group(index);
    if (relation.kind == RelationKind::ground) return check_ground(relation);
    if (relation.parts.size() != 2) return wrong(relation.id, "it does not join two parts");
    return relation.kind == RelationKind::reflection ? check_reflection(relation) : check_attachment(relation);
  }

  Status check_reflection(const Relation& relation) const {
    const Reflection& r = std::get<Reflection>(relation.detail);
    const Corners &a = corners(relation.parts[0]), &b = corners(relation.parts[1]);
    std::set<int> seen;
    for (int k = 0; k < 8; ++k) {
      const int from = r.corner_map[static_cast<std::size_t>(k)];
      if (from < 0 || from > 7 || !seen.insert(from).second)
        return wrong(relation.id, "its corner map is no permutation");
      const Vec3 corner = a.row(from).transpose();
      const Vec3 image = corner - 2 * (corner - r.origin).dot(r.normal) * r.normal;
      if (!((image - b.row(k).transpose()).cwiseAbs().maxCoeff() <= symmetry_slack)) {
        return wrong(relation.id, "its parts are not mirror images at rest");
      }
    }
    return success();
  }

  Status check_group(RelationIndex index) const {
    const Relation& relation = shape_.relations[index];
    const std::size_t n = relation.parts.size();
    if (n < 3) return wrong(relation.id, "a group has more than two instances");
    const bool is_translation = relation.kind == RelationKind::translation;
    const PartIndex parent =
        is_translation ? std::get<Translation>(relation.detail).parent : std::get<Rotation>(relation.detail).parent;
    if (!exists(parent) || shape_.parts[parent].group != index || !shape_.parts[parent].is_virtual()) {
      return wrong(relation.id, "its parent is no virtual part of its own");
    }
    for (const PartIndex p : relation.parts) {
      if (shape_.parts[p].group != index || shape_.parts[p].is_virtual()) {
        return wrong(relation.id, "an instance is not a real part of this group alone");
      }
    }
    const Corners& first = corners(relation.parts[0]);
    for (std::size_t k = 0; k < n; ++k) {
      Corners expected = first;
      if (is_translation) {
        const Translation& t = std::get<Translation>(relation.detail);
        expected.rowwise() += (static_cast<double>(k) / static_cast<double>(n - 1) * (t.end - t.start)).transpose();
      } else {
        const Rotation& r = std::get<Rotation>(relation.detail);
        const double angle = 2 * pi * static_cast<double>(k) / static_cast<double>(n);
        const Mat3 turned = Eigen::AngleAxisd(angle, r.axis).toRotationMatrix();
        expected = ((first.rowwise() - r.centre.transpose()) * turned.transpose()).rowwise() + r.centre.transpose();
      }
      if (!(worst(expected, corners(relation.parts[k])) <= symmetry_slack)) {
        return wrong(relation.id, "instance " + std::to_string(k) + " is not where the group has it");
      }
    }
    return check_group_fields(relation, shape_.parts[parent]);
  }

  Status check_group_fields(const Relation& relation, const Part& parent) const {
    const Vec3 centre = shape_.parts[relation.parts[0]].hexahedron.point(Vec3::Zero());
    if (const auto* t = std::get_if<Translation>(&relation.detail)) {
      if (t->axis < 0 || t->axis > 2) return wrong(relation.id, "its axis is not 0, 1 or 2");
      const double along = parent.hexahedron.axes.row(t->axis).dot(t->end - t->start);
      if (!(along * t->direction > 0) || std::abs(t->direction) != 1 ||
          !((t->start - centre).norm() <= symmetry_slack)) {
        return wrong(relation.id, "its start, end, axis and direction do not fit together");
      }
    } else if (const auto* r = std::get_if<Rotation>(&relation.detail)) {
      const bool axis_fits = r->parent_axis >= 0 && r->parent_axis <= 2 &&
                             std::abs(parent.hexahedron.axes.row(r->parent_axis).dot(r->axis)) > 1 - symmetry_slack;
      if (!axis_fits || !(std::abs((centre - r->centre).norm() - r->radius) <= symmetry_slack) || !(r->radius > 0)) {
        return wrong(relation.id, "its axis and radius do not fit together");
      }
    }
    return success();
  }

  Status check_attachment(const Relation& relation) const {
    const Attachment& a = std::get<Attachment>(relation.detail);
    const std::size_t wanted = std::size_t{1}
                               << (static_cast<int>(relation.kind) - static_cast<int>(RelationKind::point));
    if (a.points.size() != wanted || a.local_a.size() != wanted || a.local_b.size() != wanted) {
      return wrong(relation.id, "it has not as many points as its order says");
    }
    const Hexahedron &ha = shape_.parts[relation.parts[0]].hexahedron, &hb = shape_.parts[relation.parts[1]].hexahedron;
    for (std::size_t i = 0; i < wanted; ++i) {
      const double off_a = (ha.point(a.local_a[i]) - a.points[i]).norm(),
                   off_b = (hb.point(a.local_b[i]) - a.points[i]).norm();
      if (!(off_a <= attachment_slack) || !(off_b <= attachment_slack)) {
        return wrong(relation.id, "point " + std::to_string(i) + " is not where its parts have it at rest");
      }
    }
    if (a.patch && !is_patch(*a.patch, ha, hb))
      return wrong(relation.id, "its patch is no rectangle on both its parts");
    for (const ContactPoint& point : a.contact_points) {
      if (!(std::abs(point.normal.norm() - 1) <= symmetry_slack))
        return wrong(relation.id, "the normal of a contact point is no unit vector");
    }
    return success();
  }

  static bool is_patch(const ContactPatch& patch, const Hexahedron& a, const Hexahedron& b) {
    const auto& [first, second] = patch.half_sides;
    const double off = std::max({std::abs(patch.normal.norm() - 1), std::abs(patch.normal.dot(first)),
                                 std::abs(patch.normal.dot(second)), std::abs(first.dot(second))});
    if (!(off <= symmetry_slack)) return false;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3 corner =
          patch.centre + corner_sign(static_cast<int>(k), 0) * first + corner_sign(static_cast<int>(k), 1) * second;
      if (!((a.point(patch.local_a[k]) - corner).norm() <= attachment_slack)) return false;
      if (!((b.point(patch.local_b[k]) - corner).norm() <= attachment_slack)) return false;
    }
    return true;
  }

  Status check_ground(const Relation& relation) const {
    const Ground& ground = std::get<Ground>(relation.detail);
    if (relation.parts.size() != 1) return wrong(relation.id, "one part stands on the floor");
    if (ground.points.empty() || ground.points.size() > 4 || ground.local.size() != ground.points.size()) {
      return wrong(relation.id, "it has not 1 to 4 points, each with local coordinates");
    }
    const Hexahedron& h = shape_.parts[relation.parts[0]].hexahedron;
    for (std::size_t i = 0; i < ground.points.size(); ++i) {
      if (!((h.point(ground.local[i]) - ground.points[i]).norm() <= attachment_slack)) {
        return wrong(relation.id, "point " + std::to_string(i) + " is not where its part has it at rest");
      }
    }
    return success();
  }

  const Shape& shape_;
};

}  // namespace

Status validate(const Shape& shape) {
  return Validator(shape).run();
}

}  // namespace parsel
