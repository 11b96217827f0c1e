// From edited nodes to meshes: which mesh each node shows after the edit, and what happens to each primitive of it.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/export/apply_cage.h"
#include "core/export/apply_scene.h"

namespace parsel::apply {

/// One primitive of an edited node.
struct Slot {
  bool keep = true;      ///< false: this node shows it no more
  bool is_part = false;  ///< false: nothing that the shape knows of (lines, points, a skinned mesh)
  std::string part;      ///< the part's id, for messages
  Corners rest = Corners::Zero();
  Corners shown = Corners::Zero();  ///< in the edited model
  bool moves = false;               ///< whether its vertices are to be rewritten
  /// Corners along the sweep of an animation, or in the poses of morph targets; none where the part is absent.
  std::vector<std::optional<Corners>> samples;
  bool hidden = false;           ///< absent from the edited model, only seen in the animation
  std::vector<Corners> targets;  ///< displacements for morph targets, normalised
};

/// A node of the default scene with a mesh, and what becomes of it.
struct NodeEdit {
  std::size_t node = 0;
  std::size_t mesh = 0;
  Eigen::Affine3d rest_world;  ///< under which the slots' rest cages fit the mesh
  bool added = false;
  std::vector<Slot> slots;                ///< one for each primitive of the mesh
  std::vector<std::string> target_names;  ///< of the slots' targets, when they are sliders of their own
};

using PrimitiveKey = std::pair<std::size_t, std::size_t>;  ///< mesh, primitive

struct MeshEdits {
  std::map<PrimitiveKey, CageMap> maps;            ///< what moves or gets morph targets
  std::map<std::size_t, std::size_t> new_targets;  ///< mesh → how many morph targets each primitive gets
  std::map<std::size_t, std::vector<std::string>> target_names;  ///< of those that have names, by mesh
};

/// Gives every edited node a mesh of its own where it must differ from the other nodes that show the same mesh; nodes
/// whose edits agree go on sharing. Meshes are only appended, never reordered.
MeshEdits assign_meshes(gltf::File& file, const gltf::Scene& scene, const Frame& frame,
                        const std::vector<NodeEdit>& edits);

}  // namespace parsel::apply
