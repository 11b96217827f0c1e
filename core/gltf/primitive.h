// What of a triangle primitive can be read, and which of its attributes an edit of its positions can take along.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/gltf/document.h"

namespace parsel::gltf {

/// Why the primitive cannot be read although the file is not damaged, a clause that names the extension or the file;
/// empty when it can. A primitive compressed with Draco can when all of it stands uncompressed beside.
std::string unreadable(const Document& document, const Primitive& primitive);

/// Whether Draco or Meshopt compress its positions or indices, be they there uncompressed as well or not.
bool is_compressed(const Document& document, const Primitive& primitive);

/// An attribute of the primitive, or of its morph target `target`.
using AttributeKey = std::pair<std::optional<std::size_t>, std::string>;

struct LostAttribute {
  AttributeKey key;
  std::string why;  ///< a sentence: "its NORMAL stays as it is when it is edited: accessor 3: …"
};

/// The normals, tangents and morph targets that cannot change with the positions, as their accessors are damaged, out
/// of reach or of another type or count. Inspection warns of them, an export leaves them as they are.
std::vector<LostAttribute> lost_attributes(const Document& document, const Primitive& primitive);

/// Whether its POSITION is there and can be read.
bool has_positions(const Document& document, const Primitive& primitive);

/// Whether all primitives of the mesh can be given morph targets: they have none, and positions that can be read.
bool can_morph(const Document& document, const Mesh& mesh);

}  // namespace parsel::gltf
