// A glTF file being patched: what came (core/gltf), its JSON as text that remembers its spelling, and the bytes of the
// buffer that is appended to. Writes GLB (glTF 2.0 §4.4).
#pragma once

#include <string>
#include <string_view>

#include "core/gltf/document.h"
#include "core/gltf/json_text.h"

namespace parsel::gltf {

struct File {
  Document original;  ///< as it came; what is patched does not show here
  JsonText json;
  /// The buffer that new data goes to, as it will be written: buffer 0, which becomes the binary chunk, unless its
  /// bytes are neither in the file nor given. Then it is a buffer of its own behind all others.
  std::string binary;
  std::size_t home = 0;

  /// Element i of a top-level array (nodes, meshes, accessors …); `null` when there is none.
  const JsonText& item(std::string_view array, std::size_t i) const { return json.get(array).item(i); }
  JsonText* find_item(std::string_view array, std::size_t i);
  std::size_t size(std::string_view array) const { return json.get(array).size(); }
  /// Appends to a top-level array, which is made when missing. Returns the element's index.
  std::size_t append(std::string_view array, JsonText value);
  /// Appends bytes to `binary`, 4-byte aligned, and returns where they start.
  std::size_t append_bytes(std::string_view bytes);
};

/// `bytes` and `external` must outlive the file. Error: as read_document().
Result<File> read_file(std::string_view bytes, const ExternalBuffers& external);

/// Buffers given by name become data URIs, images given by name parts of `binary`, so that the file stands alone.
void embed(File& file, const ExternalBuffers& external);

/// Error: the result has more than 4 GB.
Result<std::string> write_glb(File file);

}  // namespace parsel::gltf
