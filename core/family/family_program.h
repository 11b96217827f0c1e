// A family as an editing program: every slider is a layer that moves faces by linear amounts, so that whatever plays
// ParSEL's programs plays families.
#pragma once

#include <string>

#include "core/edit/program.h"
#include "core/family/family.h"

namespace parsel::family {

/// Layer k has parameter x<k+1> in normalised lengths, its value 0 the base, its range reach(). Parts are named
/// "node:<n>", as cad::to_glb() numbers them; `shape` is the name and hash of the shape that comes of that file. Layers
/// commute. A share of a cone's top (paper's vocabulary) is not linear: its layer is empty. A round cone's top that is a
/// length moves the four edges at its end, both directions alike. Refuses programs beyond ProgramLimits.
Result<Program> family_program(const Family& family, const std::string& shape_name, const std::string& shape_sha256);

/// The values of the layers' parameters at a setting of the sliders.
std::vector<double> program_values(const Family& family, const Eigen::VectorXd& setting);

/// The frame of the shape that comes of cad::to_glb(), in the model's own unit: the box of what it draws.
Frame drawn_frame(const cad::Model& model);

}  // namespace parsel::family
