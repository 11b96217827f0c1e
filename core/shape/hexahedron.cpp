#include "core/shape/hexahedron.h"

#include <Eigen/LU>

#include "core/base/result.h"

namespace parsel {

namespace {

/// The Jacobian of the trilinear map at local coordinates: column j is the derivative along local axis j.
Mat3 jacobian(const Corners& corners, const Vec3& local) {
  Mat3 result = Mat3::Zero();
  for (int k = 0; k < 8; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      double derivative = 0.5 * corner_sign(k, axis);
      for (int other = 0; other < 3; ++other) {
        if (other != axis) derivative *= 0.5 * (1 + corner_sign(k, other) * local[other]);
      }
      result.col(axis) += derivative * corners.row(k).transpose();
    }
  }
  return result;
}

}  // namespace

Vec3 Hexahedron::point(const Vec3& local) const {
  return interpolate(trilinear_weights(local), corners);
}

Vec3 Hexahedron::half_extents() const {
  const Vec3 first = corners.row(0).transpose();
  return {(corners.row(1).transpose() - first).norm() / 2, (corners.row(2).transpose() - first).norm() / 2,
          (corners.row(4).transpose() - first).norm() / 2};
}

Vec3 Hexahedron::local(const Vec3& world) const {
  const Vec3 centre = corners.colwise().mean().transpose();
  const Vec3 half = half_extents();
  PARSEL_ASSERT(half.minCoeff() > 0, "a hexahedron at rest has a volume");
  return (axes * (world - centre)).cwiseQuotient(half);
}

Hexahedron make_box(const Vec3& centre, const Mat3& axes, const Vec3& half_extents) {
  Hexahedron box;
  box.axes = axes;
  for (int k = 0; k < 8; ++k) {
    Vec3 corner = centre;
    for (int axis = 0; axis < 3; ++axis) {
      corner += corner_sign(k, axis) * half_extents[axis] * axes.row(axis).transpose();
    }
    box.corners.row(k) = corner.transpose();
  }
  return box;
}

Weights trilinear_weights(const Vec3& local) {
  Weights weights;
  for (int k = 0; k < 8; ++k) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis) weight *= 0.5 * (1 + corner_sign(k, axis) * local[axis]);
    weights[k] = weight;
  }
  return weights;
}

Vec3 interpolate(const Weights& weights, const Corners& corners) {
  return (weights * corners).transpose();
}

Eigen::Matrix<double, 8, 1> relative_jacobians(const Corners& corners, const Corners& rest) {
  // The Jacobian of a box is the same everywhere.
  const double volume = jacobian(rest, Vec3::Zero()).determinant();
  PARSEL_ASSERT(volume != 0, "a hexahedron at rest has a volume");
  Eigen::Matrix<double, 8, 1> ratios;
  for (int k = 0; k < 8; ++k) {
    const Vec3 local(corner_sign(k, 0), corner_sign(k, 1), corner_sign(k, 2));
    ratios[k] = jacobian(corners, local).determinant() / volume;
  }
  return ratios;
}

}  // namespace parsel
