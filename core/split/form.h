// What a part is called by its form alone, when nobody has named it.
#pragma once

#include <string>

#include "core/shape/hexahedron.h"

namespace parsel::split {

/// "board" (flat, lying), "upright panel", "slanted panel", "post" (long, upright), "rail" (long, level), "slanted bar",
/// "block". By its oriented box; parts that are images of each other have one name. In the normalised frame, +y up.
std::string form_name(const Hexahedron& box);

/// Whether two boxes are of one size, within 2 %.
bool same_size(const Hexahedron& a, const Hexahedron& b);

}  // namespace parsel::split
