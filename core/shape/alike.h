// Contacts as symmetry has them: those of mirror images and of a row's instances are alike, in order and in their ends,
// and one that a little gap hides on one side is found by its twin. And contacts that lead through a part are none.
//
// Twins share one region: what either touches. So whatever is read off the region afterwards is alike too.
#pragma once

#include "core/base/index.h"
#include "core/shape/contacts.h"
#include "core/shape/symmetry.h"

namespace parsel {

/// Two parts that are apart by up to this, small against both, are meant to touch when their mirror images do.
inline constexpr double twin_contact_distance = 0.03;

/// `boxes`: of real parts, exact images of each other where they are tied (align_boxes). A part on the plane of a
/// mirror is its own image. Twins whose regions differ by more than twin_contact_distance stay as they are: there a
/// part touches what its image does not.
void make_alike(Contacts& contacts, const PartData<PartMesh>& meshes, const PartData<Hexahedron>& boxes,
                const MeasuredAxes& axes, const Symmetries& symmetries);

/// Whether a part lies on the plane coordinate[axis] = offset, so that it is its own image about it.
bool is_own_image(const Hexahedron& box, int axis, double offset);

/// Leaves out contacts of parts that do not touch each other where a third part, in contact with both, fills the gap
/// between them: a leg touches the board of a seat, not also the cushion on it.
void drop_covered(Contacts& contacts, const PartData<Hexahedron>& boxes);

}  // namespace parsel
