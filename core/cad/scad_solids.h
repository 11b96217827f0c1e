// OpenSCAD's solids and transformations from their arguments.
#pragma once

#include <optional>

#include "core/cad/placing.h"
#include "core/cad/scad_arguments.h"

namespace parsel::cad {

struct ReadSolid {
  Raw raw;
  std::array<Place, 3> literals;  ///< of its size along its own axes
};

/// What linear_extrude makes of a square or a circle.
struct Extrusion {
  Number height;
  bool is_centred = false;
  double scale = 1;  ///< of a circle's top
};

/// cube, sphere, cylinder, polyhedron, and square and circle inside an extrusion; nothing for another module.
std::optional<ReadSolid> read_solid(Evaluator& evaluator, const Statement& call, const Scope& scope,
                                    const std::optional<Extrusion>& extrusion);

/// translate, scale, rotate, mirror, multmatrix; nothing for another module.
std::optional<Map> read_map(Evaluator& evaluator, const Statement& call, const Scope& scope);

Extrusion read_extrusion(const CallArguments& given);

/// Refuses a module of OpenSCAD that is not read, or one that nothing defines.
[[noreturn]] void refuse_module(const Statement& call);

}  // namespace parsel::cad
