// A glTF file taken apart: its JSON, checked and parsed, and the bytes of its buffers.
//
// The file comes from strangers. So the container (GLB chunks), the size and nesting of the JSON and the types that
// tinygltf takes on trust are checked here first, and tinygltf sees only the sections that the importer reads: a broken
// texture or animation is none of our business and cannot reach it. Buffers are views, not copies, and stay with us.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/gltf/tinygltf.h"

namespace parsel {

/// Bytes of the external buffers of a .gltf, by the URI that the file names, percent-decoded ("box 0.bin").
using ExternalBuffers = std::map<std::string, std::string, std::less<>>;

/// What a file may hold at most; checked before memory is taken for it.
struct ImportLimits {
  std::size_t file_bytes = 1u << 30;
  std::size_t json_values = 4'000'000;  ///< counted as commas, colons and opening brackets
  std::size_t json_depth = 64;
  std::size_t parts = 2'000;
  std::size_t vertices = 8'000'000;   ///< of all parts together, instances counted each
  std::size_t triangles = 8'000'000;  ///< likewise
};

struct GltfBuffer {
  std::string_view bytes;  ///< into the file, an external buffer, or `decoded`
  std::string decoded;     ///< of a data URI
  std::string missing;     ///< why there are no bytes, a clause; empty when there are
};

struct GltfDocument {
  nlohmann::json json;    ///< the whole of it, for what tinygltf drops (extensions)
  tinygltf::Model model;  ///< scenes, nodes, meshes, accessors, bufferViews and material names; nothing else
  std::vector<GltfBuffer> buffers;
};

/// `bytes` and `external` must outlive the document. Error place is a section of the file ("GLB header", "buffer 0").
Result<GltfDocument> read_gltf_document(std::string_view bytes, const ExternalBuffers& external,
                                        const ImportLimits& limits);

}  // namespace parsel
