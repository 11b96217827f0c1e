// A hexahedron that need not be a box: its axes, and where points are in it.
#pragma once

#include <optional>

#include "core/shape/hexahedron.h"

namespace parsel {

/// Local coordinates of a point in a hexahedron that need not be a box, by Newton's method on the trilinear map from
/// the affine guess (the map of the corners' mean and the mean axes, exact for a parallelepiped): at most 32 steps,
/// until no component of a step exceeds 1e-12. Where that fails, the affine guess; where that is singular, the centre.
Vec3 local_coordinates(const Corners& corners, const Vec3& world);

/// The unit vector from the - to the + face centre along a local axis; nothing when they are closer than 1e-12.
std::optional<Vec3> axis_direction(const Corners& corners, int axis);

}  // namespace parsel
