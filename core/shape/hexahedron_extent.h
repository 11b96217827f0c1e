// How far a hexahedron reaches along a direction, and the directions of its edges and faces: what is compared when two of
// them touch, overlap or are apart.
#pragma once

#include <array>
#include <optional>

#include "core/base/geometry.h"

namespace parsel {

struct Extent {
  double low = 0, high = 0;
  double length() const { return high - low; }
  double middle() const { return (low + high) / 2; }
};

/// Of the eight corners, in units of `direction`.
Extent extent_along(const Corners& corners, const Vec3& direction);

/// The length that both cover; negative: by how much they are apart.
double common(const Extent& a, const Extent& b);

/// By local axis. Unit directions; zero where the hexahedron is flat or a line.
struct HexahedronAxes {
  std::array<Vec3, 3> edges;    ///< mean of the four edges
  std::array<Vec3, 3> normals;  ///< of the mean edges' planes, on the side of the edge of the same axis
};
HexahedronAxes axes_of(const Corners& corners);

/// The local axis of `outer` along which `inner` sticks out of it at both ends, by more than `by`, while along the two
/// others it lies within it, but for `by`: a column through a ring. Boxes at rest.
std::optional<int> passage_axis(const Corners& inner, const Corners& outer, double by);

/// The weights of a point in a box at rest, which may be flat.
Weights weights_in(const Corners& box, const Vec3& point);

/// The smallest extent along the normals: the thickness of a panel, also of one that is sheared.
double thickness(const Corners& corners);

}  // namespace parsel
