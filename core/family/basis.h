// The space that the kept constraints leave, by Gauss-Jordan elimination (ReparamCAD §3.5), so that what stays free are
// parameters of the model itself.
//
// The paper eliminates in the order in which parameters are stored; what then stays free is an accident ("the right
// arm's x" widens a chair). Here three rows more pin the model in place, and pivots are taken first among centres, then
// among sizes of small parts, last among sizes of big ones, the pinned part counting as the biggest: the free parameters are sizes that people name. The chair of
// the paper gets leg height, leg section, seat width, depth and thickness, …, with coefficients ±1 and ±1/2 alone.
#pragma once

#include <array>
#include <vector>

#include "core/family/agreement.h"

namespace parsel::family {

/// Three forms that stay as they are in the base: the centre's x and z of one part, the underside of another.
struct Pins {
  std::size_t part = 0;    ///< the one that kept constraints of place tie to most others; of several the largest
  std::size_t lowest = 0;  ///< of the parts that no variation lacks, if any
  std::array<Form, 3> forms;
};

Pins find_pins(const Layout& layout, const cad::Model& model, const std::vector<Constraint>& constraints,
               const std::vector<Evidence>& evidence, const std::vector<Variation>& variations);

/// Every parameter as Σ coefficient · free parameter + Σ coefficient · pinned form.
struct Basis {
  std::vector<std::size_t> free;                    ///< parameters, in the layout's order
  std::vector<std::vector<Rational>> coefficients;  ///< by parameter, then by index into `free`
  std::vector<std::array<Rational, 3>> pinned;      ///< by parameter
  Eigen::MatrixXd matrix;                           ///< the coefficients once more: parameters × free
  Eigen::MatrixXd pin_matrix;                       ///< parameters × 3
  std::size_t rank = 0;                             ///< of the kept constraints, pins not counted

  /// All parameters from the free ones and the values of the pinned forms.
  Values values(const Eigen::VectorXd& free_values, const Eigen::Vector3d& pins) const {
    return matrix * free_values + pin_matrix * pins;
  }
  Eigen::VectorXd free_values(const Values& values) const;
};

/// Refuses constraints whose elimination does not fit 64-bit fractions.
Result<Basis> find_basis(const Layout& layout, const cad::Model& model, const std::vector<Constraint>& constraints,
                         const std::vector<Evidence>& evidence, const Pins& pins);

/// The values moved as a whole so that the pinned forms have the given values.
Values pinned_to(const Layout& layout, const Pins& pins, const Eigen::Vector3d& at, Values values);
Eigen::Vector3d pin_values(const Pins& pins, const Values& values);

}  // namespace parsel::family
