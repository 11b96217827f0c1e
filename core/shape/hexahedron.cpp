#include "core/shape/hexahedron.h"

#include <Eigen/LU>

#include "core/base/result.h"

namespace parsel {

Vec3 Hexahedron::half_extents() const {
  Vec3 half;
  for (int axis = 0; axis < 3; ++axis) half[axis] = (corners.row(1 << axis) - corners.row(0)).norm() / 2;
  return half;
}

Vec3 Hexahedron::point(const Vec3& local) const {
  return interpolate(trilinear_weights(local), corners);
}

Vec3 Hexahedron::local(const Vec3& world) const {
  const Vec3 half = half_extents();
  PARSEL_ASSERT(half.minCoeff() > 0, "a hexahedron at rest has a volume");
  const Vec3 centre = corners.colwise().mean().transpose();
  return (axes * (world - centre)).cwiseQuotient(half);
}

Hexahedron make_box(const Vec3& centre, const Mat3& axes, const Vec3& half_extents) {
  Hexahedron box;
  box.axes = axes;
  for (int k = 0; k < 8; ++k) {
    const Vec3 local(corner_sign(k, 0), corner_sign(k, 1), corner_sign(k, 2));
    box.corners.row(k) = (centre + axes.transpose() * local.cwiseProduct(half_extents)).transpose();
  }
  return box;
}

Weights trilinear_weights(const Vec3& local) {
  Weights weights;
  for (int k = 0; k < 8; ++k) {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) product *= (1 + corner_sign(k, axis) * local[axis]) / 2;
    weights[k] = product;
  }
  return weights;
}

Vec3 interpolate(const Weights& weights, const Corners& corners) {
  return (weights * corners).transpose();
}

Eigen::Matrix<double, 8, 1> relative_jacobians(const Corners& corners, const Corners& rest) {
  // At a corner the trilinear map's derivatives are the three edges that meet there.
  const auto determinant = [](const Corners& c, int k) {
    Mat3 edges;
    for (int axis = 0; axis < 3; ++axis) edges.row(axis) = (c.row(k | 1 << axis) - c.row(k & ~(1 << axis))) / 2;
    return edges.determinant();
  };
  Eigen::Matrix<double, 8, 1> jacobians;
  for (int k = 0; k < 8; ++k) {
    const double at_rest = determinant(rest, k);
    PARSEL_ASSERT(at_rest != 0, "a hexahedron at rest has a volume");
    jacobians[k] = determinant(corners, k) / at_rest;
  }
  return jacobians;
}

}  // namespace parsel
