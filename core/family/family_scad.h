// A family as an OpenSCAD program whose variables are its sliders: it runs in OpenSCAD and its Customizer without us.
#pragma once

#include <string>

#include "core/family/family.h"

namespace parsel::family {

/// Where a family stands: a value of each slider, and which optional groups are there.
struct Shown {
  Eigen::VectorXd setting;
  std::vector<bool> with;
};
Shown at_base(const Family& family);

/// Sections of sliders with ranges, a boolean for every optional group, and every part with its numbers as sums of the
/// variables. Variables begin as shown, and
/// ranges hold that. Deterministic; read_scad() of it gives what is shown again, the base at_base().
std::string family_scad(const Family& family, const Shown& shown);
inline std::string family_scad(const Family& family) {
  return family_scad(family, at_base(family));
}

/// The Customizer's parameter sets, one a variation: {"fileFormatVersion","parameterSets":{name:{variable: text}}}.
nlohmann::json parameter_sets(const Family& family);

/// The boolean of an optional group: "with_left_arm".
std::string group_variable(const Family& family, const OptionalGroup& group);

}  // namespace parsel::family
