// The container of a glTF file: a GLB is split into its chunks, anything else is taken for glTF's JSON (glTF 2.0 §4.4).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace parsel::gltf {

inline constexpr std::uint32_t json_chunk = 0x4E4F534A;    ///< "JSON"
inline constexpr std::uint32_t binary_chunk = 0x004E4942;  ///< "BIN\0"

struct Chunk {
  std::uint32_t type = 0;
  std::string_view bytes;
};

/// Views into the file.
struct Container {
  std::string_view json;                   ///< without a byte order mark and without padding zeros
  std::optional<std::string_view> binary;  ///< the first binary chunk
  std::vector<Chunk> others;               ///< every other chunk, in their order
  bool is_glb = false;
};

/// Error: a GLB that is not version 2, is cut off, or does not start with a JSON chunk.
Result<Container> split_container(std::string_view bytes);

}  // namespace parsel::gltf
