// Which of several edits that satisfy the constraints is taken. ParSEL supplement §4.2.2.
#pragma once

#include "core/propagate/candidates.h"

namespace parsel {

/// Edits above this deformation energy are dropped. As-rigid-as-possible energy (Sorkine and Alexa 2007) of a box's 8
/// corners in the normalised frame: Σ over corners i and neighbours j of w·‖(p'ᵢ−p'ⱼ) − Rᵢ(pᵢ−pⱼ)‖², w = 1 for the 12
/// edges and ½ for the 12 face diagonals, the mean of the two ways to split the faces into 12 triangles, so that
/// mirrored edits cost the same. Stretching a half-diagonal's length by another half-diagonal costs about 12; 20 is
/// what the authors use, with a weighting that they do not give.
inline constexpr double largest_energy = 20;

double arap_energy(const Corners& rest, const Corners& deformed);

/// Order among candidates: fewer lost symmetry planes, less energy, then the plainer operator.
struct Rank {
  int symmetry_cost = 0;
  double energy = 0;
  int preference = 0;  ///< translate, rotate, change_delta, scale_1d, scale_2d, scale_3d, shear
  bool operator<(const Rank& other) const;
};

/// Energy is the larger of the two at the ends of the range; group operators move instances rigidly and cost none.
Rank rank_of(const Candidate& candidate, const Samples& amount, const Corners& rest);

}  // namespace parsel
