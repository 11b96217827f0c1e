// A shape in words, for a language model (ParSEL §6, supplement §5.2) and for people.
//
// Names come from the file, so from strangers: they appear only between double quotes, without control characters and
// quotes of their own, cut to length; everywhere else parts go by their ids (a-z, 0-9, _).
#pragma once

#include <string>
#include <vector>

#include "core/shape/shape.h"

namespace parsel {

/// The active parts and relations (groups standing but for those dissolved), a line each: id, size and place in percent
/// of the whole, the name where the id does not say the same; groups with their instances; joints collected by part.
std::string describe(const Shape& shape, const std::vector<RelationIndex>& dissolved = {});

/// What stands on the floor, in one line; empty when nothing does. Apart from describe(), whose text prompts are made
/// of: what was recorded for a prompt is found again by its bytes.
std::string describe_ground(const Shape& shape, const std::vector<RelationIndex>& dissolved = {});

/// One relation as a sentence without a full stop: "leg_left and leg_right are mirror images of each other, left and
/// right".
std::string describe(const Shape& shape, RelationIndex relation);

/// A name as it may appear in a prompt: quoted, at most 40 bytes.
std::string quoted_name(std::string_view name);

/// Whether an id's words are those of the name, in any order and case: then the name adds nothing.
bool says_the_same(const std::string& id, const std::string& name);

}  // namespace parsel
