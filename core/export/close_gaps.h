// Closes what an edit has pulled apart, the gentle way: one of two parts that touched is made longer, along its own axis,
// until its face is as near to the other part as it was. Nothing else moves, no vertex is added or taken away, and names,
// materials and texture coordinates stay, as after any edit.
//
// A gap is seen on hexahedra (core/propagate/contact.h): two attached parts are farther apart than at rest, and not in
// each other. It is left, and named, where neither part has a face that looks at the other, where a part would have to
// grow to more than twice its length, or where it would open another joint or enter a part that it did not touch. A part
// that has slid off the other's face altogether is out of reach: no longer face meets it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/edit/evaluate.h"
#include "core/shape/shape.h"

namespace parsel {

/// Narrower than this is no gap; normalised. What edits are accepted with may be several times as wide.
inline constexpr double narrowest_gap = 0.002;

struct Gap {
  RelationIndex relation;  ///< an attachment of two real parts
  double width = 0;        ///< normalised, > narrowest_gap
};

/// Of two parts that are attached and still exist one by one: instances of a group whose number has changed do not.
std::vector<Gap> find_gaps(const Shape& shape, const State& state);

struct Extension {
  RelationIndex relation;  ///< of the gap that it closes
  PartIndex part;          ///< that is longer now
  double length = 0;       ///< normalised, by which it is
};

struct ClosedGaps {
  std::vector<Gap> before, left;
  std::vector<Extension> extensions;
};

/// Changes the corners of parts, and of the instances of groups that they are. Deterministic.
ClosedGaps close_gaps(const Shape& shape, State& state);

/// {"gaps": number before, "closed": [{"relation","part","longer": metres}], "left": [{"relation","parts": [2],
/// "width": metres}]}, in model units where those are no metres.
nlohmann::json to_json(const Shape& shape, const ClosedGaps& gaps);

}  // namespace parsel
