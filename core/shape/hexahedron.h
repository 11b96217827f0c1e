// A part's control cage and its trilinear coordinates.
//
// On a hexahedron that starts as a box, the trilinear weights Nk(u,v,w) = Π(1 ± ·)/2 are the harmonic coordinates of
// Joshi et al. 2007 when the faces are interpolated bilinearly: each Nk is multilinear, hence harmonic, and has the
// right values on the boundary. So no PDE is solved here (ParSEL §4.1 solves one).
#pragma once

#include "core/base/geometry.h"

namespace parsel {

struct Hexahedron {
  Corners corners = Corners::Zero();
  Mat3 axes = Mat3::Identity();  ///< unit local axes 0, 1, 2 as rows, at rest

  /// The world point of local coordinates (u,v,w); [-1,1]³ is the inside.
  Vec3 point(const Vec3& local) const;
  /// Half the edge lengths along local axes 0, 1, 2, at rest (a box).
  Vec3 half_extents() const;
  /// Inverse of point() for a hexahedron at rest, which is a box with non-zero extents.
  Vec3 local(const Vec3& world) const;
};

/// A box from its centre, unit axes (rows) and half extents.
Hexahedron make_box(const Vec3& centre, const Mat3& axes, const Vec3& half_extents);

/// Trilinear weights of local coordinates (u,v,w); linear outside [-1,1]³ as well.
Weights trilinear_weights(const Vec3& local);

/// weights · corners, as a column.
Vec3 interpolate(const Weights& weights, const Corners& corners);

/// Determinants of the trilinear map's Jacobian at the 8 corners, relative to the box at rest; all > 0 for a cage that
/// is neither inverted nor collapsed there. `rest` must be a box of non-zero volume.
Eigen::Matrix<double, 8, 1> relative_jacobians(const Corners& corners, const Corners& rest);

}  // namespace parsel
