#include "core/propagate/select.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "core/edit/operator_table.h"

namespace parsel {

namespace {

/// The orthogonal factor of a matrix with a positive determinant, by Newton's method with scaling (Higham 1986): several
/// times as fast as by singular values, and this is what the search does most. Nothing where it does not converge.
std::optional<Mat3> orthogonal_factor(const Mat3& matrix) {
  constexpr int most_steps = 20;
  constexpr double least_determinant = 1e-9, converged = 1e-15;
  const double size = matrix.norm();
  if (!(matrix.determinant() > least_determinant * size * size * size)) return std::nullopt;
  Mat3 now = matrix;
  for (int step = 0; step < most_steps; ++step) {
    const Mat3 inverse = now.inverse().transpose();
    const double scale = std::sqrt(inverse.norm() / now.norm());
    const Mat3 next = (scale * now + inverse / scale) / 2;
    const bool is_done = (next - now).squaredNorm() < converged;
    now = next;
    if (is_done) return now;
  }
  return std::nullopt;
}

/// The rotation that takes the covariance S = Σ w·e·e'ᵀ to best fit: R = V·Uᵀ, without reflection.
Mat3 best_rotation(const Mat3& covariance) {
  if (const auto rotation = orthogonal_factor(covariance.transpose())) return *rotation;
  const Eigen::JacobiSVD<Mat3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 v = svd.matrixV();
  if ((v * svd.matrixU().transpose()).determinant() < 0) v.col(2) *= -1;
  return v * svd.matrixU().transpose();
}

/// Whether opposite corners lie about the centre, as they do in a box and in what an affine map makes of one.
bool is_symmetric_about_centre(const Corners& corners) {
  const Eigen::RowVector3d twice_centre = corners.row(0) + corners.row(7);
  for (int i = 1; i < 4; ++i) {
    if ((corners.row(i) + corners.row(7 - i) - twice_centre).cwiseAbs().maxCoeff() > 1e-12) return false;
  }
  return true;
}

}  // namespace

double arap_energy(const Corners& rest, const Corners& deformed) {
  double energy = 0;
  // The neighbourhoods of opposite corners are each other's image then, and cost the same.
  const int looked_at = is_symmetric_about_centre(rest) && is_symmetric_about_centre(deformed) ? 4 : 8;
  for (int i = 0; i < looked_at; ++i) {
    Mat3 covariance = Mat3::Zero();
    std::array<Vec3, 6> before;
    std::array<Vec3, 6> after;
    std::array<double, 6> weights{};
    std::size_t count = 0;
    for (int j = 0; j < 8; ++j) {
      const int differing = ((i ^ j) & 1) + ((i ^ j) >> 1 & 1) + ((i ^ j) >> 2 & 1);
      if (differing != 1 && differing != 2) continue;
      before[count] = (rest.row(i) - rest.row(j)).transpose();
      after[count] = (deformed.row(i) - deformed.row(j)).transpose();
      weights[count] = differing == 1 ? 1 : 0.5;
      covariance += weights[count] * before[count] * after[count].transpose();
      ++count;
    }
    const Mat3 rotation = best_rotation(covariance);
    for (std::size_t n = 0; n < count; ++n) {
      energy += weights[n] * (after[n] - rotation * before[n]).squaredNorm();
    }
  }
  return energy * (8 / looked_at);
}

bool Rank::operator<(const Rank& other) const {
  return std::tie(symmetry_cost, energy, preference) < std::tie(other.symmetry_cost, other.energy, other.preference);
}

Rank rank_of(const Candidate& candidate, const Samples& amount, const Corners& rest) {
  const Op op = candidate.what.op;
  Rank rank{candidate.symmetry_cost, 0, preference_of(op)};
  const bool is_whole = candidate.what.feature == LocalTriple{0, 0, 0};
  if (!is_geometric(op) || (is_whole && (op == Op::translate || op == Op::rotate))) return rank;
  for (const double value : {amount.front(), amount.back()}) {
    Corners deformed = rest;
    apply_operator(candidate.what, value, deformed);
    rank.energy = std::max(rank.energy, arap_energy(rest, deformed));
  }
  return rank;
}

}  // namespace parsel
