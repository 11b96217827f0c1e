// Labels, direction words and ids. ParSEL, supplement §3.3.1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/geometry.h"

namespace parsel {

/// A name from the file without its counters: "Leg.001", "leg_3", "leg (2)", "leg_L" → "Leg", "leg", "leg", "leg".
/// Printable, at most 64 bytes, cut between characters; "part" when nothing remains.
std::string clean_label(std::string_view name);

/// The key under which parts are looked at for symmetry: lower case, without direction words (left, right, front, back,
/// rear, top, upper, bottom, lower, middle, center, inner, outer, l, r, …) in any position, glued ones ("leftwall",
/// "legfrontleft") included, without separators. A label that is nothing but direction words is its own key.
std::string grouping_key(std::string_view label);

/// Lower-case ASCII letters, digits and single underscores: the stem of an id. Latin letters lose their marks ("Füße" →
/// "fusse"), other scripts give nothing: their ids are "part", "part_2", …, and the name says what they are. "part"
/// when nothing remains.
std::string slug(std::string_view label);

struct PartName {
  std::string id;    ///< "leg_front_left"
  std::string name;  ///< "front left leg"
};

/// Ids and readable names of parts, in order. Parts that share a slug (and, beyond ASCII, a label) get direction words
/// by their centres (normalised frame; +x is the asset's left, +y up, +z its front): along a line of two to five
/// "left", "left-center", "center", …; else by the sides of the common centre that they lie on, "front left"; numbers
/// from 1 when there are more than five or the words do not tell them apart. Numbers run along a line where there is
/// one, else in the order given. All ids are unique.
std::vector<PartName> name_parts(const std::vector<std::string>& labels, const std::vector<Vec3>& centres);

}  // namespace parsel
