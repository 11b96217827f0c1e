// A glTF file taken apart, by the one reader that both the importer and the exporter use: what one of them accepts, the
// other reads in the same way.
//
// The file comes from strangers. So the container (GLB chunks), the size and nesting of the JSON and the types of all
// that is read here are checked first: whatever stands in a Document has its type, though an index may still point
// nowhere. A broken texture or animation is none of our business. Buffers are views where they can be.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/gltf/structure.h"

namespace parsel {

/// Bytes of the external buffers (and, for an export, images) of a .gltf, by the URI that the file names,
/// percent-decoded or as it stands ("box 0.bin", "box%200.bin").
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

namespace gltf {

/// `bytes` and `external` must outlive the document. Error place is a section of the file ("GLB header", "buffer 0").
Result<Document> read_document(std::string_view bytes, const ExternalBuffers& external,
                               const ImportLimits& limits = {});

/// The file that a URI names among those given: as it stands or percent-decoded; null when it is not there.
const std::string* find_external(const ExternalBuffers& external, const std::string& uri);

/// The URIs of the buffers that lie outside of the file, percent-decoded; empty for a damaged file.
std::vector<std::string> external_uris(std::string_view bytes);

/// Whether a URI holds its bytes itself.
bool is_data_uri(std::string_view uri);

}  // namespace gltf
}  // namespace parsel
