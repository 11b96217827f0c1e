#include "core/edit/cage.h"

#include <Eigen/LU>
#include <cmath>

namespace parsel {

namespace {

constexpr double degenerate_axis = 1e-12;

}  // namespace

std::optional<Vec3> axis_direction(const Corners& corners, int axis) {
  Vec3 direction = Vec3::Zero();
  for (int k = 0; k < 8; ++k) direction += corner_sign(k, axis) * corners.row(k).transpose() / 4;
  const double length = direction.norm();
  if (!(length >= degenerate_axis)) return std::nullopt;
  return Vec3(direction / length);
}

Vec3 local_coordinates(const Corners& corners, const Vec3& world) {
  constexpr int steps = 32;
  constexpr double converged = 1e-12;
  constexpr double singular = 1e-18;
  Mat3 half;  // columns: from the centre to the + face centres, in the mean
  for (int axis = 0; axis < 3; ++axis) {
    half.col(axis).setZero();
    for (int k = 0; k < 8; ++k) half.col(axis) += corner_sign(k, axis) * corners.row(k).transpose() / 8;
  }
  if (std::abs(half.determinant()) <= singular) return Vec3::Zero();
  const Vec3 guess = half.inverse() * (world - corners.colwise().mean().transpose());
  Vec3 local = guess;
  for (int step = 0; step < steps; ++step) {
    Mat3 jacobian = Mat3::Zero();
    for (int k = 0; k < 8; ++k) {
      Vec3 factor;
      for (int axis = 0; axis < 3; ++axis) factor[axis] = (1 + corner_sign(k, axis) * local[axis]) / 2;
      for (int axis = 0; axis < 3; ++axis) {
        const double derivative = 0.5 * corner_sign(k, axis) * factor[(axis + 1) % 3] * factor[(axis + 2) % 3];
        jacobian.col(axis) += derivative * corners.row(k).transpose();
      }
    }
    if (!(std::abs(jacobian.determinant()) > singular)) return guess;
    const Vec3 move = jacobian.inverse() * (world - interpolate(trilinear_weights(local), corners));
    local += move;
    if (move.cwiseAbs().maxCoeff() <= converged) return local;
  }
  return guess;
}

}  // namespace parsel
