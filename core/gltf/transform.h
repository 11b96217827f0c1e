// Where a node stands in its parent: a matrix, or translation, rotation and scale.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "core/base/geometry.h"

namespace parsel::gltf {

/// Translation, rotation (unit) and scale.
struct Placement {
  Vec3 translation = Vec3::Zero();
  Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
  Vec3 scale = Vec3::Ones();

  Eigen::Affine3d matrix() const;
};

struct Transform {
  std::optional<Eigen::Affine3d> matrix;  ///< counts alone when it is there; its last row is taken for 0 0 0 1
  Placement placement;

  Eigen::Affine3d affine() const { return matrix ? *matrix : placement.matrix(); }
  /// False when the rotation is too short to have a direction or a number is not finite.
  bool sound = true;
};

/// What a node's JSON says; missing keys, and keys that hold something else than their numbers, are the identity.
Transform read_transform(const nlohmann::json& node);

/// The transform as a placement with scales of the given signs; none when it shears (columns not perpendicular within
/// 1e-6) or mirrors otherwise.
std::optional<Placement> decompose(const Eigen::Affine3d& transform, const Vec3& signs);

/// Whether a map can be undone: its columns are finite, not zero and not in one plane, each by its own length (of a thin
/// box, a stretched node).
bool independent_columns(Mat3 m);

}  // namespace parsel::gltf
