// What the table of operators (operators.json) says of each besides its name and its fields (operators.h). CMake writes the
// table into the core, into the prompts and into the schemas of replies; the page reads it as it is.
#pragma once

#include <string>
#include <string_view>

#include "core/edit/operators.h"

namespace parsel {

/// What an amount is: a normalised length, radians, the growth per length of a scale or per height of a shear, a number
/// of instances, the growth of a spacing or radius.
enum class AmountUnit { length, angle, ratio, slope, count, spacing, none };

AmountUnit amount_unit(Op op);

/// The names of all in the order of Op: "translate, rotate, … change_delta" + before_last + "keep_fixed".
std::string listed_operators(std::string_view before_last = ", ");

/// The hint that asks for this kind of edit: "scale" for scale_1d.
std::string_view hint_of(Op op);

/// Of edits that lose the same and deform the same, the search takes the one with the least: 0 to 7.
int preference_of(Op op);

}  // namespace parsel
