// Lower levels of detail (MSFT_lod): nodes outside of the scene that a viewer shows in place of a node of it.
#pragma once

#include "core/export/apply_mesh.h"
#include "core/shape/shape.h"

namespace parsel::apply {

/// A node whose lower levels are to follow.
struct CarriedLevels {
  std::size_t node = 0;
  Eigen::Affine3d rest_parent;  ///< world transform of its parent before the edit
  Eigen::Affine3d by;           ///< the change of its place, in the coordinates of its parent
};

/// Places the levels as their node was placed and, where it changes its form, adds edits for their meshes: primitive by
/// primitive when there are as many, else all by the node's only part. What cannot follow is named in a warning.
void add_levels(gltf::File& file, gltf::Scene& scene, const Frame& frame, const std::vector<CarriedLevels>& carried,
                std::vector<NodeEdit>& edits, std::vector<Warning>& warnings);

}  // namespace parsel::apply
