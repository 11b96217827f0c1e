#include "core/gltf/container.h"

#include "core/gltf/refusal.h"

namespace parsel::gltf {
namespace {

constexpr std::size_t header_size = 12, chunk_header_size = 8;

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

/// Some writers pad with zeros instead of spaces, some begin with a byte order mark.
std::string_view trimmed(std::string_view json) {
  if (json.starts_with("\xEF\xBB\xBF")) json.remove_prefix(3);
  while (json.ends_with('\0')) json.remove_suffix(1);
  return json;
}

}  // namespace

Result<Container> split_container(std::string_view bytes) {
  Container container;
  if (!bytes.starts_with("glTF")) {
    container.json = trimmed(bytes);
    return container;
  }
  container.is_glb = true;
  if (bytes.size() < header_size + chunk_header_size) return refused("GLB header", "the file ends inside it");
  const std::uint32_t version = little_endian(bytes, 4);
  if (version != 2)
    return refused("GLB header", "version " + std::to_string(version) + " is not 2", "export it as glTF 2.0");
  const std::size_t length = little_endian(bytes, 8);
  if (length > bytes.size()) {
    return refused("GLB header",
                   "it promises " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()));
  }
  if (length < header_size + chunk_header_size) return refused("GLB header", "it promises too few bytes");
  for (std::size_t at = header_size; length - at >= chunk_header_size;) {
    const std::size_t size = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    if (size > length - at - chunk_header_size) {
      return refused("GLB chunk at byte " + std::to_string(at), "it reaches beyond the file");
    }
    const std::string_view chunk = bytes.substr(at + chunk_header_size, size);
    if (at == header_size) {
      if (type != json_chunk) return refused("GLB chunk at byte 12", "the first chunk is not JSON");
      container.json = trimmed(chunk);
    } else if (type == binary_chunk && !container.binary) {
      container.binary = chunk;
    } else {
      container.others.push_back({type, chunk});
    }
    at += chunk_header_size + size;
  }
  return container;
}

}  // namespace parsel::gltf
