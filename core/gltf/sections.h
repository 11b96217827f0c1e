// The sections of a glTF file's JSON as typed values: what Document holds, checked, then parsed by tinygltf.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/gltf/structure.h"

namespace parsel::gltf {

/// Fills views, accessors, meshes, nodes and roots from document.json. Error: as checked_sections(), or a default scene
/// that does not exist.
Status read_sections(Document& document);

/// One primitive of a mesh. Error: as checked_primitive().
Result<Primitive> read_primitive(const nlohmann::json& entry, const std::string& place);

}  // namespace parsel::gltf
