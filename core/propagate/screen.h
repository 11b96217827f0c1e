// Numeric fit of a candidate's amount to the constraints, at the samples. No algebra: ParSEL §5.3 solves every scalar
// equation of every candidate with a computer algebra system; most candidates are refuted by a few dot products.
//
// Notation: v_i the field of the candidate at constraint point i (3 numbers), r_i(s) the goal at sample s, Y(s) amount.
//   linear operators: Y·v_i = r_i      → Y = Σ v·r / Σ v·v, the least-squares amount; zero residual when one exists
//   rotate: (R(n, Y) − I)·v_i = r_i    → Y from the point with the largest lever across the axis
#pragma once

#include <optional>
#include <vector>

#include "core/propagate/candidates.h"
#include "core/prove/range.h"

namespace parsel {

/// Constraints as flat arrays.
class Rows {
 public:
  Rows() = default;
  explicit Rows(const std::vector<PointConstraint>& constraints);
  void add(const PointConstraint& constraint);
  /// A point that stays where it is, in the directions whose `mask` is 1.
  void add_fixed(const Weights& weights, const Vec3& mask);

  std::size_t size() const { return weights_.size(); }
  /// The directions of a displacement that count at point i.
  Vec3 masked(std::size_t i, const Vec3& v) const { return v.cwiseProduct(masks_[i]); }
  /// Whether all three do.
  bool is_free(std::size_t i) const { return masks_[i].minCoeff() > 0; }
  /// W · field at point i.
  Vec3 at(std::size_t i, const Corners& field) const { return interpolate(weights_[i], field); }
  const Vec3& goal(std::size_t i, std::size_t sample) const { return goals_[i][sample]; }

 private:
  std::vector<Weights> weights_;
  std::vector<std::array<Vec3, sample_count>> goals_;
  std::vector<Vec3> masks_;
};

struct Fit {
  Samples amount{};
  Samples second{};  ///< amount of the second candidate of a pair
  double error = 0;  ///< largest |coordinate| missed
};

/// The amounts with which the candidate meets all rows within `tolerance`; nothing when there are none, when they
/// vanish or exceed largest_amount.
std::optional<Fit> fit(const Candidate& candidate, const Rows& rows, double tolerance);

/// Largest |coordinate| by which the candidate with these amounts misses the rows.
double missed_by(const Candidate& candidate, const Samples& amount, const Rows& rows);

/// The same as fit() for two linear candidates together.
std::optional<Fit> fit_pair(const Candidate& first, const Candidate& second, const Rows& rows, double tolerance);

}  // namespace parsel
