// Writes an edited shape back into the file that it came from.
//
// What changes: positions, normals, tangents and morph target deltas of edited parts, the bounds of their accessors,
// `byteLength` of buffer 0 when data is appended, nodes that a changed count adds or removes. Every other byte of the
// JSON and the binary chunk stays, white space and spelling of numbers included (core/gltf/json_text.h). When nothing
// is edited, a GLB comes back byte for byte.
//
// Where something hangs on the node of a part that moves as a whole (children without meshes, an animation, a camera, a
// light), the node's transform says the motion, and vertices stay (apply_carry.h).
//
// What is kept with a warning: skinned and GPU-instanced nodes (left unedited), attributes that cannot follow,
// animations above an edited node (they go on moving it, edited).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/export/apply_options.h"
#include "core/export/close_gaps.h"
#include "core/shape/shape.h"

namespace parsel {

struct Applied {
  std::string glb;
  std::vector<Warning> warnings;
  ClosedGaps gaps;  ///< of a repair
};

/// `file`: the bytes of the GLB or glTF JSON that `shape` was made from; the result is GLB in both cases. `state`: what
/// the Evaluator returns. Error: a file that is malformed where it is read, or that the shape was not made from; a pose
/// with other counts than the state.
Result<Applied> apply_state(std::string_view file, const Shape& shape, const State& state,
                            const ApplyOptions& options = {});

/// Which of the program's parameters to animate.
struct Animate {
  std::string parameter;
  double seconds = 2;
};

/// Evaluates the program, one value a layer, and applies the state. `program` must have passed validate() for `shape`.
/// With `animate`, that layer's parameter is swept over its range while the others keep their values. Error: as
/// apply_state(), a number of values that is not that of the layers, or no such parameter.
Result<Applied> apply_program(std::string_view file, const Shape& shape, const Program& program,
                              const std::vector<double>& values, const std::optional<Animate>& animate = std::nullopt,
                              ApplyOptions options = {});

}  // namespace parsel
