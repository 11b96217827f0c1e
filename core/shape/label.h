// Labels, direction words and ids. ParSEL, supplement §3.3.1.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/geometry.h"

namespace parsel {

/// A name from the file without its counters: "Leg.001", "leg_3", "leg (2)", "leg<1>", "leg(Clone)", "leg_L" → "Leg",
/// "leg", …; and without UUIDs. Printable, at most 64 bytes, cut between characters; "part" when nothing remains.
std::string clean_label(std::string_view name);

/// A name from the file for people: as given, counters included, but for UUIDs and copy marks ("(Clone)"), control
/// characters, and what is beyond 64 bytes. May be empty.
std::string shown_name(std::string_view name);

/// The key under which parts are looked at for symmetry: small letters without separators, digits, what exporters add
/// (mesh, node, component, …) and direction words (English, German, French, Spanish, Italian, Chinese, Japanese; l, r,
/// …) in any position, glued ones ("leftwall", "legfrontleft", "左前腿") included. A label that is nothing but
/// direction words is its own key; one that is nothing but an exporter's has the key "part".
std::string grouping_key(std::string_view label);

/// Whether two grouping keys differ by a letter or a small word: "lega" and "legb", "side" and "sideboard".
bool alike(std::string_view a, std::string_view b);

/// Lower-case ASCII letters, digits and single underscores: the stem of an id. Latin letters lose their marks ("Füße" →
/// "fusse"), other scripts give nothing: their ids are "part", "part_2", …, and the name says what they are. "part"
/// when nothing remains.
std::string slug(std::string_view label);

struct PartName {
  std::string id;    ///< "leg_front_left"
  std::string name;  ///< "front left leg"
};

/// Ids and readable names of parts, in order. Parts that share a slug (and, beyond ASCII, a label) get direction words by their centres (normalised
/// frame; +x is the asset's left, +y up, +z its front): along a line of two to five "left", "left-center", "center", …;
/// else by the sides of the common centre that they lie on, "front left"; more than five by rows and columns, at most
/// three an axis; numbers from 1 when more than five are a line, or the words do not tell them apart. Numbers run along
/// a line where there is one, else in the order given. All ids are unique. `given` are the names in the file, if there
/// are any: one that no other part has is shown as it is, unless it only adds a program's counter to a shared label.
std::vector<PartName> name_parts(const std::vector<std::string>& labels, const std::vector<Vec3>& centres,
                                 const std::vector<std::string>& given = {});

}  // namespace parsel
