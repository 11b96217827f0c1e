// The few geometric types that every stage shares. Lengths are in the normalised frame unless a name says otherwise.
#pragma once

#include <Eigen/Core>
#include <array>

namespace parsel {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// The 8 corners of a hexahedron, one a row. Corner k has local signs (k&1, k&2, k&4) → ±1 along local axes 0, 1, 2.
using Corners = Eigen::Matrix<double, 8, 3, Eigen::RowMajor>;

/// The trilinear weights of one point with respect to 8 corners; they sum to 1.
using Weights = Eigen::Matrix<double, 1, 8>;

/// A point of a hexahedron, or the feature that an operator acts on, in {-1,0,1}³: (0,0,0) is the centre or the whole
/// part, one non-zero a face, two an edge, three a corner.
using LocalTriple = std::array<int, 3>;

/// The normalised frame: along the model's own axes, bounding box centred at the origin, half-diagonal 1.
/// model = centre + scale · axesᵀ · normalised.
struct Frame {
  Vec3 centre = Vec3::Zero();    ///< in model units (metres in glTF)
  double scale = 1.0;            ///< model units per normalised unit
  Mat3 axes = Mat3::Identity();  ///< rows: the normalised axes, unit and right-handed, in the file's coordinates

  Vec3 to_model(const Vec3& normalised) const { return centre + scale * (axes.transpose() * normalised); }
  Vec3 to_normalised(const Vec3& model) const { return axes * (model - centre) / scale; }
};

/// The sign, -1 or 1, of corner k (0…7) along local axis 0, 1 or 2.
inline int corner_sign(int k, int axis) {
  return (k >> axis) & 1 ? 1 : -1;
}

}  // namespace parsel
