// The sliders of a family: its free parameters with names, ranges and what they move.
#pragma once

#include <string>
#include <vector>

#include "core/family/basis.h"

namespace parsel::family {

struct Slider {
  std::size_t parameter = 0;       ///< into the layout
  std::string name;                ///< for people, unique: "leg height"
  std::string variable;            ///< for OpenSCAD, unique: "leg_height"
  std::string section;             ///< "Leg"
  double value = 0;                ///< in the base
  double min = 0, max = 0;         ///< hull of the base and the variations, min ≤ value ≤ max
  std::vector<std::size_t> moves;  ///< parameters that change with it, itself included
};

/// One a free parameter, in the basis' order. `settings` are the free parameters of the variations, whose parts may be
/// absent: a variation counts for a slider when it has a part that the slider moves.
std::vector<Slider> find_sliders(const Layout& layout, const cad::Model& model, const Basis& basis,
                                 const Eigen::VectorXd& base, const std::vector<Variation>& variations,
                                 const std::vector<Eigen::VectorXd>& settings);

/// Lower-case words joined by "_", a letter first.
std::string variable_name(std::string_view words);

}  // namespace parsel::family
