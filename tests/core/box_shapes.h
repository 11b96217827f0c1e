// Hand-made shapes of boxes for the tests of propagation: every number is known, nothing is found.
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/shape/shape.h"

namespace parsel::test {

class BoxShape {
 public:
  PartIndex box(const std::string& id, const Vec3& centre, const Vec3& half, double turn_about_y = 0) {
    Mat3 axes = Mat3::Identity();
    axes << std::cos(turn_about_y), 0, -std::sin(turn_about_y), 0, 1, 0, std::sin(turn_about_y), 0,
        std::cos(turn_about_y);
    return add(id, make_box(centre, axes, half));
  }

  /// Relations of the given points, attachments of 1, 2, 4 or 8.
  std::string attach(PartIndex a, PartIndex b, const std::vector<Vec3>& points) {
    Attachment attachment;
    attachment.points = points;
    for (const Vec3& point : points) {
      attachment.local_a.push_back(shape_.parts[a].hexahedron.local(point));
      attachment.local_b.push_back(shape_.parts[b].hexahedron.local(point));
    }
    const RelationKind kind = points.size() == 1   ? RelationKind::point
                              : points.size() == 2 ? RelationKind::line
                              : points.size() == 4 ? RelationKind::face
                                                   : RelationKind::volume;
    return relate("a", ++attachments_, {kind, {a, b}, attachment});
  }

  /// The eight corners of part b, as points of both.
  std::string attach_whole(PartIndex a, PartIndex b) {
    std::vector<Vec3> points;
    for (int k = 0; k < 8; ++k) points.push_back(shape_.parts[b].hexahedron.corners.row(k).transpose());
    return attach(a, b, points);
  }

  std::string reflect(PartIndex a, PartIndex b, int axis) {
    Reflection reflection;
    reflection.origin = Vec3::Zero();
    reflection.normal = Vec3::Unit(axis);
    for (int k = 0; k < 8; ++k) reflection.corner_map[static_cast<std::size_t>(k)] = k ^ (1 << axis);
    return relate("r", ++reflections_, {RelationKind::reflection, {a, b}, reflection});
  }

  /// The part's lowest corners keep their height.
  std::string stand(PartIndex part) {
    const Hexahedron& box = shape_.parts[part].hexahedron;
    Ground ground;
    for (int k = 0; k < 8; ++k) {
      if (box.corners(k, 1) > box.corners.col(1).minCoeff() + 1e-9) continue;
      ground.points.push_back(box.corners.row(k).transpose());
      ground.local.push_back(box.local(ground.points.back()));
    }
    return relate("g", ++grounds_, {RelationKind::ground, {part}, ground});
  }

  /// A row of equal boxes from `start` to `end`, with their parent. Returns the parent.
  PartIndex row(const std::string& id, int count, const Vec3& start, const Vec3& end, const Vec3& half, int axis) {
    std::vector<PartIndex> members;
    for (int i = 0; i < count; ++i) {
      members.push_back(box(id + "_" + std::to_string(i + 1), start + (end - start) * i / (count - 1), half));
    }
    const Vec3 reach = (end - start).cwiseAbs() / 2 + half;
    const PartIndex parent = group(id + "s", members, make_box((start + end) / 2, Mat3::Identity(), reach));
    Translation translation{parent, start, end, axis, end[axis] > start[axis] ? 1 : -1};
    relate("t", ++translations_, {RelationKind::translation, members, translation});
    return parent;
  }

  /// Equal boxes on a circle about the y axis through the origin, with their parent. Returns the parent.
  PartIndex ring(const std::string& id, int count, double radius, double height, const Vec3& half) {
    std::vector<PartIndex> members;
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * 3.14159265358979323846 * i / count;
      members.push_back(box(id + "_" + std::to_string(i + 1),
                            Vec3(radius * std::cos(angle), height, -radius * std::sin(angle)), half, angle));
    }
    const Vec3 reach(radius + half.x(), half.y(), radius + half.x());
    const PartIndex parent = group(id + "s", members, make_box(Vec3(0, height, 0), Mat3::Identity(), reach));
    Rotation rotation{parent, Vec3(0, height, 0), Vec3::UnitY(), 1, radius};
    relate("o", ++rotations_, {RelationKind::rotation, members, rotation});
    return parent;
  }

  /// Real parts come before virtual ones in a shape: groups are added last.
  const Shape& shape() const { return shape_; }

 private:
  PartIndex add(const std::string& id, const Hexahedron& hexahedron) {
    Part part;
    part.id = part.label = part.name = id;
    part.node = static_cast<int>(shape_.parts.size());
    part.primitive = 0;
    part.hexahedron = hexahedron;
    return shape_.parts.push_back(part);
  }
  PartIndex group(const std::string& id, const std::vector<PartIndex>& members, const Hexahedron& hexahedron) {
    const PartIndex parent = add(id, hexahedron);
    const RelationIndex relation(shape_.relations.size());
    shape_.parts[parent].node = shape_.parts[parent].primitive = -1;
    shape_.parts[parent].members = members;
    shape_.parts[parent].group = relation;
    for (const PartIndex member : members) shape_.parts[member].group = relation;
    return parent;
  }
  struct Draft {
    RelationKind kind;
    std::vector<PartIndex> parts;
    decltype(Relation::detail) detail;
  };
  std::string relate(const char* letter, int number, Draft draft) {
    const std::string id = letter + std::to_string(number);
    shape_.relations.push_back({id, draft.kind, std::move(draft.parts), std::move(draft.detail)});
    return id;
  }

  Shape shape_;
  int attachments_ = 0, reflections_ = 0, translations_ = 0, rotations_ = 0, grounds_ = 0;
};

/// A seat on four legs (two reflections) that stand on the floor, tied by a bar left to right between the front legs; a back on the seat.
inline Shape chair() {
  BoxShape s;
  const PartIndex seat = s.box("seat", {0, 0, 0}, {0.4, 0.05, 0.4});
  std::vector<PartIndex> legs;
  for (const int z : {1, -1}) {
    for (const int x : {1, -1}) {
      const std::string id = std::string("leg_") + (z > 0 ? "front_" : "back_") + (x > 0 ? "left" : "right");
      legs.push_back(s.box(id, {0.3 * x, -0.35, 0.3 * z}, {0.03, 0.3, 0.03}));
      s.attach(seat, legs.back(), {{0.3 * x, -0.05, 0.3 * z}});
      s.stand(legs.back());
    }
  }
  s.reflect(legs[0], legs[1], 0);
  s.reflect(legs[2], legs[3], 0);
  s.reflect(legs[0], legs[2], 2);
  s.reflect(legs[1], legs[3], 2);
  const PartIndex bar = s.box("bar", {0, -0.5, 0.3}, {0.27, 0.02, 0.02});
  s.attach(bar, legs[0], {{0.27, -0.5, 0.3}});
  s.attach(bar, legs[1], {{-0.27, -0.5, 0.3}});
  const PartIndex back = s.box("back", {0, 0.4, -0.37}, {0.4, 0.35, 0.03});
  s.attach(seat, back, {{-0.4, 0.05, -0.37}, {0.4, 0.05, -0.37}});
  return s.shape();
}

/// A cabinet with a door that has a handle in its middle.
inline Shape cabinet() {
  BoxShape s;
  const PartIndex body = s.box("body", {0, 0, 0}, {0.4, 0.5, 0.3});
  const PartIndex door = s.box("door", {0, 0, 0.32}, {0.4, 0.5, 0.02});
  const PartIndex handle = s.box("handle", {0.3, 0.1, 0.36}, {0.02, 0.08, 0.02});
  s.attach(body, door, {{-0.4, -0.5, 0.3}, {-0.4, 0.5, 0.3}});
  s.attach_whole(door, handle);
  return s.shape();
}

/// Two rails joined by five slats in a row.
inline Shape slatted_back() {
  BoxShape s;
  const PartIndex top = s.box("top_rail", {0, 0.5, 0}, {0.5, 0.05, 0.03});
  const PartIndex bottom = s.box("bottom_rail", {0, -0.5, 0}, {0.5, 0.05, 0.03});
  const PartIndex slats = s.row("slat", 5, {-0.36, 0, 0}, {0.36, 0, 0}, {0.04, 0.45, 0.02}, 0);
  s.attach(top, slats, {{-0.4, 0.45, 0}, {0.4, 0.45, 0}});
  s.attach(bottom, slats, {{-0.4, -0.45, 0}, {0.4, -0.45, 0}});
  return s.shape();
}

/// A round top on a ring of four legs.
inline Shape round_table() {
  BoxShape s;
  const PartIndex top = s.box("top", {0, 0.3, 0}, {0.6, 0.03, 0.6});
  const PartIndex legs = s.ring("leg", 4, 0.45, 0, {0.03, 0.27, 0.03});
  const double reach = 0.48;
  s.attach(top, legs, {{reach, 0.27, reach}, {-reach, 0.27, reach}, {reach, 0.27, -reach}, {-reach, 0.27, -reach}});
  return s.shape();
}

}  // namespace parsel::test
