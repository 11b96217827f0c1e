// A glTF 2.0 file taken apart for patching: its JSON as text, its buffers as bytes. Reads GLB and glTF JSON with data
// URIs or with buffers given by name; writes GLB. (glTF 2.0 specification, §4.4 "GLB File Format".)
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gltf/json_text.h"

namespace parsel::gltf {

/// The files that a .gltf names, by the URI it names them with (percent-escapes decoded or not).
using ExternalFiles = std::map<std::string, std::string, std::less<>>;

struct Chunk {
  std::uint32_t type = 0;
  std::string bytes;
};

struct File {
  JsonText json;
  /// What the file brought, one an entry of `buffers`; none where it is neither in the file nor given.
  std::vector<std::optional<std::string>> buffers;
  /// Buffer 0 as it will be written: the binary chunk. Patched in place and appended to.
  std::string binary;
  std::vector<Chunk> other_chunks;  ///< of unknown type, kept
  bool is_glb = false;

  /// Element i of a top-level array (nodes, meshes, accessors …); `null` when there is none.
  const JsonText& item(std::string_view array, std::size_t i) const { return json.get(array).item(i); }
  JsonText* find_item(std::string_view array, std::size_t i);
  std::size_t size(std::string_view array) const { return json.get(array).size(); }
  /// Appends to a top-level array, which is made when missing. Returns the element's index.
  std::size_t append(std::string_view array, JsonText value);
  /// Appends bytes to `binary`, 4-byte aligned, and returns where they start.
  std::size_t append_bytes(std::string_view bytes);
};

/// Error: not glTF, not version 2, truncated, not JSON, no object, buffer shorter than its byteLength.
Result<File> read_file(std::string_view bytes, const ExternalFiles& external);

/// Buffers given by name become data URIs, images given by name parts of the binary chunk, so that the file stands
/// alone.
void embed(File& file, const ExternalFiles& external);

/// Buffer 0 becomes the binary chunk. Error: its bytes are missing, or the result has more than 4 GB.
Result<std::string> write_glb(File file);

}  // namespace parsel::gltf
