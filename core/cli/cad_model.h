// Reading CAD programs: OpenSCAD text, or what `parsel cad` wrote of it.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/cad/model.h"

namespace parsel::cli {

/// A .json file is parsel/cad, everything else OpenSCAD (.scad, .csg), whose model is named after the file and has the
/// unit given. Its warnings and echoes go to stderr. Error places begin with the path.
Result<cad::Model> read_cad(const std::string& path, const std::string& unit);

}  // namespace parsel::cli
