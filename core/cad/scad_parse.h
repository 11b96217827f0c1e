// OpenSCAD's grammar. A `.csg` file, OpenSCAD's evaluated output, is a subset of it.
#pragma once

#include <string_view>

#include "core/cad/scad_syntax.h"

namespace parsel::cad {

/// Error stage "cad/read", place "line L, column C"; refuses include, use and function literals by name.
Result<Statements> parse_scad(std::string_view text);

}  // namespace parsel::cad
