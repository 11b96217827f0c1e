// The box that a part starts with: as tight as it can be, and as near the global axes as the part allows.
#pragma once

#include "core/base/geometry.h"
#include "core/shape/hexahedron.h"
#include "core/shape/part.h"

namespace parsel {

/// Flat parts get at least this half extent, in the normalised frame, so that every hexahedron has a volume.
inline constexpr double min_half_extent = 0.002;

/// The axis-aligned box is kept when its volume is at most this many times that of the tightest box found. A square leg
/// splayed by 5° (twice the volume) is above it; round, bevelled and slightly turned chunky parts are below.
inline constexpr double axis_snap_ratio = 1.2;

/// Oriented bounding box of the vertices that triangles use. Candidates: the global axes; the tightest rectangle turned
/// about one global axis (the usual case in furniture); and, when clearly tighter, a free orientation found from the
/// principal axes by minimal rectangles about each axis in turn. Local axis i is the one nearest to global axis i and
/// points along its positive side; the axes are right-handed.
Hexahedron oriented_box(const PartMesh& mesh);

/// Unit rows in the order and with the signs that make axis i nearest to global axis i, right-handed.
Mat3 near_global(const Mat3& axes);

}  // namespace parsel
