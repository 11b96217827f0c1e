// Splitting a model whose parts nobody told apart: one mesh of all, four legs in one, a scan.
//
// A step of its own on request, before core/shape sees the file: it writes a GLB with one node a part, in which the
// geometry, the materials and everything else are as they were. So what comes after knows nothing of it, and the result
// opens everywhere with the same parts.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/gltf/document.h"
#include "core/shape/shape.h"

namespace parsel {

enum class SplitMethod {
  automatic,   ///< components; where these are fewer than four, or one has nearly all of the surface, regions
  components,  ///< what hangs together, once vertices at one place are one (core/split/seams.h)
  materials,   ///< one part a material of each mesh
  regions,     ///< components, and these along concave creases (core/split/creases.h, behind.h)
};

/// "auto", "components", "materials", "regions".
std::optional<SplitMethod> split_method(std::string_view text);
std::string_view to_string(SplitMethod method);

struct SplitOptions {
  SplitMethod by = SplitMethod::automatic;
  /// How small a part may be, in [0, 1]: what is smaller goes to what it sits on (core/split/pieces.h). 1: all stays.
  double fine = 0.5;
};

struct SplitModel {
  std::string glb;
  std::size_t before = 0, parts = 0;         ///< real parts of the shape; the same when nothing comes apart
  std::size_t joined = 0;                    ///< pieces that were too small to be parts, each mesh counted once
  SplitMethod by = SplitMethod::components;  ///< what was done; never automatic
  std::vector<Warning> warnings;             ///< what was left whole, and why
};

/// Only meshes that come apart change. Each of their nodes keeps its place, name and children and gets a child a piece,
/// named by its form ("upright panel") or, when all pieces are alike and the node has a name, by that. Meshes that are
/// skinned, instanced by GPU, with morph targets or compressed stay whole. Automatic also leaves whole what is creased all over,
/// and goes coarser where there are more pieces than a model may have parts. Deterministic. Error: as abstract_shape(); more
/// pieces than that, and no coarser way or one was named; `fine` out of range.
Result<SplitModel> split_model(std::string_view bytes, const ExternalBuffers& external = {},
                               const SplitOptions& options = {}, const Progress& progress = {});

/// What one way of splitting would tell apart.
struct SplitWay {
  SplitMethod by = SplitMethod::components;
  std::size_t parts = 0;  ///< as SplitModel::parts
  bool too_many = false;  ///< more than a model may have: split_model() refuses
};

struct SplitWays {
  std::size_t before = 0;      ///< real parts of the shape
  std::vector<SplitWay> ways;  ///< components, materials, regions
};

/// What split_model() would answer for each method but automatic, without writing anything: vertices are brought together
/// once for all. `fine` in [0, 1]. Error: as abstract_shape(); `fine` out of range.
Result<SplitWays> split_ways(std::string_view bytes, const ExternalBuffers& external = {}, double fine = 0.5,
                             const Progress& progress = {});

}  // namespace parsel
