// Virtual parts: one hexahedron around the instances of a translation or rotation group. ParSEL, supplement §3.1.2.
#pragma once

#include <optional>
#include <vector>

#include "core/base/index.h"
#include "core/shape/attachment.h"
#include "core/shape/hexahedron.h"
#include "core/shape/symmetry.h"

namespace parsel {

/// The parent's hexahedron. Translation: the tight box around the instances' boxes, its axes those of the instances
/// with the one most along delta put onto it. Rotation: centred on the axis, square across it, so that it is as
/// symmetric as the group is.
Hexahedron group_box(const SymmetryGroup& group, const PartData<Hexahedron>& boxes);

/// When the instances of `image` are the mirror images of those of `of`, all about one plane: that plane.
std::optional<MirrorPair> mirrors_between(const SymmetryGroup& of, const SymmetryGroup& image,
                                          const std::vector<MirrorPair>& mirrors);

}  // namespace parsel
