#include "core/shape/hexahedron_extent.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace parsel {

namespace {

/// Edges, and cross products of edges of unit length, that are shorter than this have no direction.
constexpr double no_direction = 1e-12;

Vec3 unit_or_zero(const Vec3& v) {
  const double length = v.norm();
  return length > no_direction ? Vec3(v / length) : Vec3::Zero();
}

}  // namespace

Extent extent_along(const Corners& corners, const Vec3& direction) {
  const Eigen::Matrix<double, 8, 1> along = corners * direction;
  return {along.minCoeff(), along.maxCoeff()};
}

double common(const Extent& a, const Extent& b) {
  return std::min(a.high, b.high) - std::max(a.low, b.low);
}

HexahedronAxes axes_of(const Corners& corners) {
  HexahedronAxes axes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Vec3 edge = Vec3::Zero();
    for (int k = 0; k < 8; ++k) edge += corner_sign(k, static_cast<int>(axis)) * corners.row(k).transpose();
    axes.edges[axis] = unit_or_zero(edge);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3 normal = unit_or_zero(axes.edges[(axis + 1) % 3].cross(axes.edges[(axis + 2) % 3]));
    axes.normals[axis] = normal.dot(axes.edges[axis]) < 0 ? Vec3(-normal) : normal;
  }
  return axes;
}

double thickness(const Corners& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& normal : axes_of(corners).normals) least = std::min(least, extent_along(corners, normal).length());
  return least;
}

}  // namespace parsel
