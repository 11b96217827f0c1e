// The node hierarchy of a glTF file: who is whose child, where everything is, and how nodes come and go.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/geometry.h"
#include "core/export/apply_file.h"

namespace parsel::gltf {

struct Scene {
  std::size_t index = 0;  ///< the default scene, or the first
  std::vector<std::optional<std::size_t>> parent;
  std::vector<std::vector<std::size_t>> children;
  std::vector<Eigen::Affine3d> world;
  std::vector<bool> shown;  ///< reachable from the scene's roots; all nodes when the file has no scenes

  std::size_t size() const { return parent.size(); }
  /// World transform of the node's parent; identity for a root.
  Eigen::Affine3d parent_world(std::size_t node) const;
};

/// Error: a child that does not exist, has two parents or is its own ancestor; a transform that is not finite.
Result<Scene> read_scene(const File& file);

/// Translation, rotation (unit) and scale.
struct Placement {
  Vec3 translation = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 scale = Vec3::Ones();

  Eigen::Affine3d matrix() const;
};

/// The node's own transform, from `matrix` or translation, rotation and scale; missing ones are the identity.
Eigen::Affine3d local_transform(const JsonText& node);
/// What the node says of translation, rotation and scale.
Placement placement(const JsonText& node);

/// The transform as a placement with scales of the given signs; none when it shears (columns not perpendicular within
/// 1e-6) or mirrors otherwise.
std::optional<Placement> decompose(const Eigen::Affine3d& transform, const Vec3& signs);

/// Gives the node a new local transform, changing as few of its keys as possible. False when glTF cannot say it.
bool set_local_transform(JsonText& node, const Eigen::Affine3d& local);

/// Appends a node beside `sibling` (same parent, or a root of the scene). Returns its index.
std::size_t add_beside(File& file, Scene& scene, std::size_t sibling, JsonText node);
/// Takes nodes out of their parents and scenes; they stay in `nodes`, so that no index shifts.
void detach(File& file, Scene& scene, const std::set<std::size_t>& nodes);

/// The name with its number raised above all of its kind: "slat" → "slat.001", "slat_2" → "slat_3".
std::string numbered_name(const File& file, const std::string& name);

}  // namespace parsel::gltf
