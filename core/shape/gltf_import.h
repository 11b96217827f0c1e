// Reads a GLB or glTF file into the triangle meshes of its parts.
//
// One part per triangle primitive of each node in the default scene (scene 0 when none is named; all roots when there
// are no scenes). Damage is an Error; what is sound but not read here (lines, points, Draco, Meshopt, skins, morph
// targets, …) is left out with a warning that names it, and an Error only when nothing else remains.
#pragma once

#include <string_view>
#include <vector>

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/base/result.h"
#include "core/gltf/document.h"
#include "core/shape/abstraction.h"
#include "core/shape/part.h"
#include "core/shape/shape.h"

namespace parsel {

struct ImportedModel {
  Frame frame;
  PartData<PartMesh> meshes;  ///< every one has at least one triangle; in scene order, depth first
  std::vector<Warning> warnings;
};

Result<ImportedModel> import_gltf(std::string_view bytes, const ExternalBuffers& buffers = {},
                                  const ImportLimits& limits = {});

}  // namespace parsel
