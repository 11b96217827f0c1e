// Comments that name what they stand beside.
#pragma once

#include <string>
#include <string_view>

namespace parsel::cad {

/// A comment of one to four plain words is a name; what else it may be, an explanation or code, gives "".
std::string label_from_note(std::string_view note);

}  // namespace parsel::cad
