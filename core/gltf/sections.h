// The sections of a glTF file's JSON as typed values: what Document holds, checked.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/gltf/document.h"

namespace parsel::gltf {

/// Fills views, accessors, meshes, nodes and roots from document.json. Error: a section, or an entry of one, that is
/// not of the shape which glTF gives it; whether an index points somewhere is asked where it is followed.
Status read_sections(Document& document);

/// One primitive of a mesh. Error: as above, with that place.
Result<Primitive> read_primitive(const nlohmann::json& entry, const std::string& place);

/// `object`'s member, or none when it is missing. Error: it is there and no integer from 0 to 2³¹ − 1, which all
/// indices, offsets and counts are (so that sums and products of them fit 64 bits).
Result<std::optional<std::size_t>> read_integer(const nlohmann::json& object, const char* name,
                                                const std::string& place);

}  // namespace parsel::gltf
