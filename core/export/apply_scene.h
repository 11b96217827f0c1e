// Changes to the node hierarchy of a glTF file: where nodes are, and how they come and go.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/geometry.h"
#include "core/export/apply_file.h"
#include "core/gltf/scene.h"

namespace parsel::gltf {

/// What the node says now, patched or not.
Transform transform_of(const JsonText& node);

/// Gives the node a new local transform, changing as few of its keys as possible. False when glTF cannot say it.
bool set_local_transform(JsonText& node, const Eigen::Affine3d& local);

/// Appends a node beside `sibling` (same parent, or a root of the scene). Returns its index.
std::size_t add_beside(File& file, Scene& scene, std::size_t sibling, JsonText node);
/// Takes nodes out of their parents and scenes; they stay in `nodes`, so that no index shifts.
void detach(File& file, Scene& scene, const std::set<std::size_t>& nodes);

/// The name with its number raised above all of its kind: "slat" → "slat_2", "slat_2" → "slat_3".
std::string numbered_name(const File& file, const std::string& name);

}  // namespace parsel::gltf
