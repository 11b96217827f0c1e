// The parts and relations that a reply names. Models write a part's display name, other case, spaces for underscores.
#pragma once

#include <string_view>

#include "core/shape/shape.h"

namespace parsel {

/// By id or node:<n>; by the id of a group's relation (its virtual part); else by words, in any order and case, of an
/// id or a name that only one part has.
Result<PartIndex> part_named(const Shape& shape, std::string_view text);

/// By id in any case, or by a group's virtual part or one of its instances: a translation or rotation.
Result<RelationIndex> group_named(const Shape& shape, std::string_view text);

}  // namespace parsel
