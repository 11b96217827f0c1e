// Which parts stand on the floor, and where.
//
// The floor is the horizontal plane (up is +Y, as glTF has it) at the model's lowest point. A part stands on it when
// its own lowest point is at most contact_distance above, and the model as a whole could stand there: seen from above,
// the mean of its surface lies within the convex hull of all footprints, and far enough from the hull's edge that a
// tilt of less than 6° would not tip it over, and by a tenth of the model's narrower half width. So a ceiling fan does
// not stand on the bottom of its globe, nor a picture frame, a clock or a ladder against a wall on its narrow lower
// edge.
#pragma once

#include <vector>

#include "core/base/geometry.h"
#include "core/base/index.h"
#include "core/shape/hexahedron.h"
#include "core/shape/part.h"
#include "core/shape/shape.h"

namespace parsel {

/// What of a part's surface is at its lowest height, as the corners of its convex hull in order about +Y: one for a
/// tip, two for an edge. All lie in one horizontal plane. Empty for a part that does not stand on the floor.
using Footprint = std::vector<Vec3>;

/// One for every part; all are empty when the model could not stand.
PartData<Footprint> footprints(const PartData<PartMesh>& meshes);

/// The points of a part (or of a group's virtual part, then `prints` has one entry an instance) that keep their height:
/// the corners of the rectangle around its footprints along its box, two where that is a line, one where it is a point.
/// `prints` are not all empty. Local coordinates are put onto the box's features like those of attachments.
Ground ground_contact(const Hexahedron& box, const std::vector<Footprint>& prints);

}  // namespace parsel
