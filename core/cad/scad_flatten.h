// Runs an OpenSCAD program (`.scad` or `.csg`) until nothing but parts with literal numbers is left.
//
// Read: variables, arithmetic, vectors, ranges, functions, modules with children, for, if, let, echo, modifiers; cube,
// sphere, cylinder, and square and circle under linear_extrude; translate, scale, rotate, mirror, multmatrix, color;
// union, difference, intersection, group, render. What turns a part out of the axes, hull and polyhedron leave an
// opaque part with its exact box (for a turned cone, one that holds it) and a warning. Everything else is refused by
// name and line. Cylinders with $fn from 3 to 15 are prisms, with more they are round; spheres are round always.
#pragma once

#include <string_view>

#include "core/cad/model.h"

namespace parsel::cad {

/// Any bytes → a model that passes validate(), within a second. Error stage "cad/read", place "line L, column C".
Result<Model> read_scad(std::string_view text, std::string_view name);

}  // namespace parsel::cad
