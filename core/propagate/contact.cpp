#include "core/propagate/contact.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace parsel {

namespace {

/// Boxes that overlap by more than this share of the thinner one's extent along every axis lie in each other: a seat on
/// its legs overlaps less, a shelf in the one box of a whole cabinet more.
constexpr double deep = 0.6;

using Frame3 = std::array<Vec3, 3>;

/// Unit normals of a hexahedron's faces, by local axis, for boxes that may be sheared.
Frame3 face_normals(const Corners& corners) {
  Frame3 edges;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 edge = Vec3::Zero();
    for (int k = 0; k < 8; ++k) edge += corner_sign(k, axis) * corners.row(k).transpose();
    edges[static_cast<std::size_t>(axis)] = edge;
  }
  Frame3 normals;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3 normal = edges[(axis + 1) % 3].cross(edges[(axis + 2) % 3]);
    const double length = normal.norm();
    normals[axis] = length > 1e-12 ? Vec3(normal / length * (normal.dot(edges[axis]) < 0 ? -1 : 1)) : Vec3::Zero();
  }
  return normals;
}

struct Extent {
  double low = 0, high = 0;
  double length() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

Extent extent_along(const Corners& corners, const Vec3& direction) {
  const Eigen::Matrix<double, 8, 1> along = corners * direction;
  return {along.minCoeff(), along.maxCoeff()};
}

double common(const Extent& a, const Extent& b) {
  return std::min(a.high, b.high) - std::max(a.low, b.low);
}

}  // namespace

std::optional<Contact> contact_of(const Corners& first, const Corners& second) {
  std::optional<Contact> best;
  double least = 0;
  for (const bool of_first : {true, false}) {
    const Frame3 normals = face_normals(of_first ? first : second);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3& normal = normals[static_cast<std::size_t>(axis)];
      const Extent a = extent_along(first, normal), b = extent_along(second, normal);
      const double overlap = common(a, b);
      if (overlap > deep * std::min(a.length(), b.length())) continue;
      if (best && overlap >= least - 1e-9) continue;
      least = overlap;
      best = Contact{of_first, axis, b.middle() >= a.middle() ? 1 : -1, -overlap, {}};
      for (int i = 0; i < 2; ++i) {
        const Vec3& tangent = normals[static_cast<std::size_t>((axis + 1 + i) % 3)];
        best->cover[static_cast<std::size_t>(i)] =
            std::max(0.0, common(extent_along(first, tangent), extent_along(second, tangent)));
      }
    }
  }
  return best;
}

ContactChange change_of(const Contact& contact, const Corners& first, const Corners& second) {
  const Frame3 normals = face_normals(contact.of_first ? first : second);
  const Vec3& normal = normals[static_cast<std::size_t>(contact.axis)];
  const Extent a = extent_along(first, normal), b = extent_along(second, normal);
  const double distance = contact.side > 0 ? b.low - a.high : a.low - b.high;
  ContactChange change{distance - contact.distance, 0};
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3& tangent = normals[(static_cast<std::size_t>(contact.axis) + 1 + i) % 3];
    const Extent along_a = extent_along(first, tangent), along_b = extent_along(second, tangent);
    // A smaller part that is narrowed covers less and has lost nothing.
    const double possible = std::min({contact.cover[i], along_a.length(), along_b.length()});
    if (possible < 1e-9) continue;
    const double now = std::clamp(common(along_a, along_b), 0.0, possible);
    change.lost = std::max(change.lost, 1 - now / possible);
  }
  return change;
}

}  // namespace parsel
