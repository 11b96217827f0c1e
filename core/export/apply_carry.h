// Who goes along with an edited part: lights, cameras, hotspots and empties below its node, pivots of animations, lower
// levels of detail.
//
// Every node n of the scene is given a motion Mₙ in model coordinates, parents first, and its new place is Mₙ·Wₙ:
//   a part that moves rigidly      its own motion when something hangs on the node, as said by its transform; else its
//                                  vertices are rewritten and the node stays;
//   a part that changes its form   that of the node above it, or, when an animation turns it about its origin, the
//                                  translation which takes the origin along with the form;
//   anything else                  a pivot: the motion that all parts below it have in common; else that of the node
//                                  above it: where that one is a part which changes its form, the translation and
//                                  rotation of the place it is at.
// A place that glTF cannot say (a shear) is given up: the node goes with the one above, its vertices make up for that.
#pragma once

#include "core/export/apply_mesh.h"
#include "core/shape/shape.h"

namespace parsel::apply {

/// Places the nodes in `file` and `scene`, takes what the transforms now say out of the slots' `moves`, and adds edits
/// for the lower levels of detail (MSFT_lod) of edited parts. What cannot follow is named in a warning.
void carry_nodes(gltf::File& file, gltf::Scene& scene, const Frame& frame, std::vector<NodeEdit>& edits,
                 std::vector<Warning>& warnings);

/// The rotation and translation, in the normalised frame, that takes corners `from` to `to` within 1e-7; none when the
/// form changes.
std::optional<Eigen::Affine3d> rigid_motion(const Corners& from, const Corners& to);

}  // namespace parsel::apply
