// What the reader demands of a glTF file's JSON before tinygltf sees it.
//
// tinygltf reads an optional number of the wrong type as if it were absent, which would change a mesh silently, drops
// what it cannot read, and narrows integers. So the types of all that is read are checked here, and tinygltf gets a
// JSON of its own with nothing else: a broken texture or animation is none of our business and cannot reach it.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/base/result.h"

namespace parsel::gltf {

/// Scenes, nodes, meshes, accessors and bufferViews with the keys that are read, in their order. Primitives lack their
/// indices: tinygltf refuses a file whose indices have no bufferView (zeros, or compressed with Draco).
/// Error: a section, or an entry of one, that is not of the shape which glTF gives it; whether an index points
/// somewhere is asked where it is followed.
Result<nlohmann::json> checked_sections(const nlohmann::json& file);

/// The same of one primitive. Error: as above, with that place.
Result<nlohmann::json> checked_primitive(const nlohmann::json& entry, const std::string& place);

/// `object`'s member, or none when it is missing. Error: it is there and no integer from 0 to 2³¹ − 1, which all
/// indices, offsets and counts are (so that sums and products of them fit 64 bits).
Result<std::optional<std::size_t>> read_integer(const nlohmann::json& object, const char* name,
                                                const std::string& place);

}  // namespace parsel::gltf
