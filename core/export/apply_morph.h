// Poses as named morph targets: a slider each in Blender, Unity, Godot, three.js and <model-viewer>.
//
// A target says how far the vertices of a mesh are from the edited model when its pose is shown, in the coordinates of
// the mesh; transforms of nodes stay. Every mesh gets the targets of those poses that move it, under the same names;
// nodes that share a mesh and move differently get meshes of their own (apply_mesh.h). Names stand in
// `mesh.extras.targetNames`, where all of these tools look for them, weights are 0.
//
// Morph targets that the mesh has keep their places, names and weights; where nodes or animations set weights, zeros
// for the new ones are added. What hangs on a node without being a mesh (a camera, a light) and lower levels of detail
// stay at the edited model: a weight cannot move them.
#pragma once

#include "core/export/apply_mesh.h"
#include "core/export/apply_options.h"

namespace parsel::apply {

/// Gives slots the displacements and nodes the names of their targets; `poses` in the order of the slots' samples.
/// Returns whether anything moves. A mesh that cannot be given targets (unreadable positions; weights of its own that
/// are animated in a way which cannot be extended) is named in a warning.
bool plan_targets(const gltf::File& file, const std::vector<Pose>& poses, std::vector<NodeEdit>& edits,
                  std::vector<Warning>& warnings);

/// Writes names and weights of the targets that write_vertices() has added, and extends weights of nodes and of
/// animations. Extras that cannot hold names are named in a warning.
void describe_targets(gltf::File& file, const MeshEdits& meshes, std::vector<Warning>& warnings);

}  // namespace parsel::apply
