// What comments say to the Customizer: ranges and sections.
#pragma once

#include <vector>

#include "core/cad/scad_syntax.h"

namespace parsel::cad {

/// Assignments of numbers whose line ends in `// [min : max]` or `// [min : step : max]`.
std::vector<CustomizerRange> customizer_ranges(const Statements& program);

}  // namespace parsel::cad
