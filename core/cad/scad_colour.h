// Colours of OpenSCAD's color().
#pragma once

#include <array>

#include "core/cad/scad_arguments.h"

namespace parsel::cad {

/// sRGB and opacity; opacity 0 for a name that is not known, which then colours nothing.
std::array<double, 4> read_colour(const CallArguments& given);

}  // namespace parsel::cad
