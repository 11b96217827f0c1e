// What comments say: names of parts, and the Customizer's ranges and sections.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/cad/scad_syntax.h"

namespace parsel::cad {

/// A comment of one to four plain words is a name; what else it may be, an explanation or code, gives "".
std::string label_from_note(std::string_view note);

/// Assignments of numbers whose line ends in `// [min : max]` or `// [min : step : max]`.
std::vector<CustomizerRange> customizer_ranges(const Statements& program);

}  // namespace parsel::cad
