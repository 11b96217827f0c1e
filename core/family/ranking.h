// ReparamCAD's own selection (§3.4.1), for comparison and for noisy variations: constraints in the order in which they
// distort the variations least, and where to cut the list.
//
// A step moves every variation onto the chosen constraints and one more, by least squares: the sum over all faces of
// (displacement · area · share of the box that is solid)², the paper's linear stand-in for intersection over union. The
// constraint whose true IoU with the step before, multiplied over the variations, is largest is chosen; those that then
// raise the rank no more drop out. Both planes of an axis have one area, so that the squares are diagonal in centre and
// size, 2w²·dc² + w²/2·ds², and a step is a projection in closed form: no system of all parameters is solved.
// Parts that a variation lacks move freely and do not count. Tops of cones stay as they are. Images are not at hand: the
// loss is the mean over the variations of 1 − IoU with the variation as it was given.
#pragma once

#include <vector>

#include "core/family/agreement.h"

namespace parsel::family {

struct Ranking {
  std::vector<std::size_t> order;  ///< constraints, best first; each raises the rank of those before it
  std::vector<double> losses;      ///< with the first 1, 2, … of them
};

/// `base` and the variations' values in the layout's order. Without variations the base alone is moved.
Ranking rank_constraints(const cad::Model& model, const Layout& layout, const Values& base,
                         const std::vector<Constraint>& constraints, const std::vector<Variation>& variations,
                         int gauss_points = 4);

/// How many constraints to keep: those before the one change of the mean of the losses (least squares), as the released
/// code has it.
std::size_t cutoff_by_mean(const std::vector<double>& losses);
/// The same for the change of the mean of the losses' central differences, as the paper has it.
std::size_t cutoff_by_derivative(const std::vector<double>& losses);

}  // namespace parsel::family
