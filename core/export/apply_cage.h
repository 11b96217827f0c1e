// What an edit does to the vertices of one primitive, in the coordinates of its node.
//
// p    a vertex, in the node's coordinates          W   world transform of the node
// u    its local coordinates in the rest cage       F   the shape's frame
// u = A·p + b with A, b from the rest cage, F and W (all affine, so composed once);
// D(p) = Σₖ Nₖ(u)·cₖ with cₖ = W⁻¹F⁻¹(corner k), as affine maps pass through weights that sum to 1.
// J(p) = ∂D/∂p; normals map by J⁻ᵀ, tangents by J.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "core/base/geometry.h"

namespace parsel::apply {

struct CageMap {
  Mat3 to_local = Mat3::Identity();   ///< A
  Vec3 offset = Vec3::Zero();         ///< b
  Corners corners = Corners::Zero();  ///< cₖ
  std::vector<Corners> targets;       ///< for morph targets: displacements of the cₖ
  bool moves = false;                 ///< whether the cₖ differ from the rest cage

  /// D(p) for the corners given: `corners`, or a sum of it and targets.
  Vec3 point(const Vec3& p, const Corners& c) const;
  /// J(p), likewise.
  Mat3 jacobian(const Vec3& p, const Corners& c) const;
};

/// J⁻ᵀn, of unit length; `n` itself where that is undefined.
Vec3 transform_normal(const Mat3& jacobian, const Vec3& n);
/// J·t, of unit length; `t` itself where that is undefined.
Vec3 transform_tangent(const Mat3& jacobian, const Vec3& t);

/// None when the rest cage is flat or a transform cannot be inverted. `rest_world` is the world transform under which
/// the primitive has the rest cage; `world` that of the node which shows it (the two differ for a new instance).
std::optional<CageMap> make_cage_map(const Frame& frame, const Corners& rest, const Eigen::Affine3d& rest_world,
                                     const Corners& corners, const Eigen::Affine3d& world, bool moves);

/// Adds a morph target: displacements of the corners in the normalised frame.
void add_target(CageMap& map, const Frame& frame, const Corners& displacement, const Eigen::Affine3d& world);

/// Whether the two maps send every point of the rest cage to the same place, within 1e-7 of the cage's size, targets
/// included. Both are polynomials of degree at most 3 in each coordinate, so 4 × 4 × 4 points decide.
bool same_map(const CageMap& a, const CageMap& b);

/// The affine motion that takes corners `from` to `to` within `tolerance`, if there is one.
std::optional<Eigen::Affine3d> affine_motion(const std::vector<Corners>& from, const std::vector<Corners>& to,
                                             double tolerance);

}  // namespace parsel::apply
