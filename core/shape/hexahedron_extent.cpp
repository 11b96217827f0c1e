#include "core/shape/hexahedron_extent.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "core/shape/hexahedron.h"

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

std::optional<int> passage_axis(const Corners& inner, const Corners& outer, double by) {
  std::optional<int> through;
  const std::array<Vec3, 3> normals = axes_of(outer).normals;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3& normal = normals[static_cast<std::size_t>(axis)];
    const Extent own = extent_along(outer, normal), other = extent_along(inner, normal);
    const bool is_within = other.low > own.low - by && other.high < own.high + by;
    const bool sticks_out = other.low < own.low - by && other.high > own.high + by;
    if (is_within) continue;
    if (!sticks_out || through) return std::nullopt;
    through = axis;
  }
  return through;
}

Weights weights_in(const Corners& box, const Vec3& point) {
  Mat3 halves;  // half the edges, as columns
  for (int axis = 0; axis < 3; ++axis) halves.col(axis) = (box.row(1 << axis) - box.row(0)).transpose() / 2;
  const Vec3 centre = box.colwise().mean().transpose();
  return trilinear_weights(halves.fullPivLu().solve(point - centre));
}

double thickness(const Corners& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& normal : axes_of(corners).normals) least = std::min(least, extent_along(corners, normal).length());
  return least;
}

}  // namespace parsel
