// A model as a labelled GLB: one node a part, for the page and for core/shape.
#pragma once

#include <string>

#include "core/cad/model.h"

namespace parsel::cad {

/// The parts that add material, uncut, in order: node i is the i-th of them. Metres, from the model's unit ("m", "cm",
/// "in", else millimetres); the bounding box of each node is the part's within half a micrometre.
std::string to_glb(const Model& model);

/// Metres of one unit of the model.
double metres(const Model& model);

}  // namespace parsel::cad
