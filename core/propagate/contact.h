// How two joined parts meet: what a person sees of a joint when one of them moves. ParSEL ties joints by points; a
// joint may hold at its points and still show a gap or an overlap, and a part may slide along another without either.
//
// Parts are seen as their hexahedra. Two boxes meet across the axis, of either box, along which they overlap least (the
// separating axis where they are apart). The axis is that of a face, and goes along with the box that it belongs to.
// Where boxes run into each other and surfaces do not, as those of a cushion and its sofa, the joint's contact points
// tell how far the parts come apart (core/shape/contact_points.h).
#pragma once

#include <array>
#include <optional>

#include "core/propagate/motion.h"
#include "core/propagate/passage.h"
#include "core/shape/contact_points.h"

namespace parsel {

struct Contact {
  bool of_first = true;  ///< whose axis it is
  int axis = 0;          ///< local axis of that hexahedron, the normal of the contact
  int side = 1;          ///< the second part lies towards + or − of the normal
  double distance = 0;   ///< along the normal, at rest; negative where they overlap
  /// Length of the boxes' common extent along the two other axes, at rest.
  std::array<double, 2> cover{};
  /// The corners of that common rectangle, around it, half way between the faces: their weights in either box.
  std::array<Weights, 4> rectangle_first, rectangle_second;
  double thickness = 0;                ///< least extent of the thinner box
  Mat3 normals_first, normals_second;  ///< of the faces at rest, as columns
};

/// Nothing where one of the boxes lies so deep in the other that no face can be told to touch.
std::optional<Contact> contact_of(const Corners& first, const Corners& second);

/// What has become of a contact.
struct ContactChange {
  double apart = 0;  ///< by how much the distance grew; negative where the parts entered each other
  double lost = 0;   ///< share of the common extent that is gone, 0 … 1, the worse of the two directions
  /// The parts turn about an edge of what they had in common, as a door on its hinges or a lid: off it by no more than
  /// the thickness of the thinner one, as hinges are.
  bool hinged = false;
  double stepped = 0;  ///< the highest step between faces that were flush
};
ContactChange change_of(const Contact& contact, const Corners& first, const Corners& second);

/// What is known of how the parts of a joint meet: by their boxes, and by their surfaces where boxes run into each
/// other and surfaces do not. Where both are known the surfaces say how far the parts are apart.
struct JointContact {
  std::optional<Contact> boxes;
  std::optional<SurfaceContact> surfaces;
  std::optional<Passage> passage;  ///< where no face of the boxes can be told to touch
};
JointContact contact_of_joint(const Shape& shape, const Relation& attachment);

/// The worst at the two ends of the range that the search looks at; hinged when it is at both. Of what is lost, the less:
/// what slides comes off at one end of its neighbour sooner than at the other, and there the slider ends. Corners at
/// rest, and how they move. Nothing where nothing is known.
std::optional<ContactChange> worst_change(const JointContact& contact, const Corners& first, const Motion& of_first,
                                          const Corners& second, const Motion& of_second);

}  // namespace parsel
