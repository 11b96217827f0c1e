// The default scene of a glTF file: which nodes it shows, who is whose child, and where everything is.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "core/gltf/document.h"

namespace parsel::gltf {

/// One entry a node of the file; those that the scene does not reach have no parent and no children here and stay at
/// the identity.
struct Scene {
  std::size_t index = 0;                           ///< of the scene in the file
  std::vector<std::size_t> order;                  ///< the nodes that the scene reaches, depth first, parents first
  std::vector<std::optional<std::size_t>> parent;  ///< within the scene
  std::vector<std::vector<std::size_t>> children;
  std::vector<Eigen::Affine3d> world;  ///< column vectors, model units; may be beyond finite numbers
  std::vector<bool> shown;             ///< reached
  std::vector<bool> hidden;            ///< by KHR_node_visibility, its own or that of a node above

  std::size_t size() const { return parent.size(); }
  /// World transform of the node's parent; identity for a root.
  Eigen::Affine3d parent_world(std::size_t node) const;
};

/// Without scenes, every node that is nobody's child is a root. Error: within the scene, a node that does not exist or
/// occurs twice, or a transform that is not finite or has a rotation of no length.
Result<Scene> read_scene(const Document& document);

/// Why the mesh of a node stays as it is when the part is edited, a clause; empty when it can be edited. Inspection and
/// export say the same.
std::string why_fixed(const Document& document, const Scene& scene, std::size_t node);

}  // namespace parsel::gltf
