// A CAD model in words, for a language model.
#pragma once

#include <string>

#include "core/cad/model.h"

namespace parsel {

/// Its reach, then one line a part with kind and bounds, in its unit and frame. Bounds are of the part's size about its
/// centre, as in parsel/variations. Names stand between double quotes, and only where the id does not say the same.
std::string describe(const cad::Model& model);

}  // namespace parsel
