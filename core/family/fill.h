// Variations moved into a family: pinned, put exactly on its constraints, and with numbers for the parts that they lack.
#pragma once

#include "core/family/basis.h"

namespace parsel::family {

/// What an absent part would be: as many of the base's constraints as the parts that are there allow, kept ones first,
/// and what these leave open as in the base. With the kept ones alone a stool's missing arm would stick out in front.
Values filled(const Layout& layout, const std::vector<Constraint>& constraints, const std::vector<Evidence>& evidence,
              const Variation& variation, const Values& base, double tolerance);

/// The free parameters of a variation that has been filled and pinned.
Eigen::VectorXd projected(const Layout& layout, const Basis& basis, const Pins& pins, const Eigen::Vector3d& at,
                          const Values& filled);

/// Free parameters as a mixture: weights ≥ 0, one a variation; the base takes what is missing to a sum of 1, and above
/// that they count relative to their sum. Continuous everywhere, the base at zero (the paper's normalised sum is not).
Eigen::VectorXd mixed(const Eigen::VectorXd& base, const std::vector<Eigen::VectorXd>& variations,
                      const std::vector<double>& weights);

}  // namespace parsel::family
