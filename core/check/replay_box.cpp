// Boxes and turns, as plainly as can be.
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/check/replay.h"

namespace parsel::replay {

Box box_of(const Corners& corners) {
  Box box;
  for (int k = 0; k < 8; ++k) box[static_cast<std::size_t>(k)] = corners.row(k).transpose();
  return box;
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

}  // namespace parsel::replay
