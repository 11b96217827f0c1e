#include "core/gltf/document.h"

#include <cstdint>
#include <utility>

#include "core/base/json.h"
#include "core/base/text.h"
#include "core/base/uri.h"
#include "core/gltf/checks.h"
#include "core/gltf/refusal.h"
#include "core/gltf/sections.h"

namespace parsel::gltf {
namespace {

using nlohmann::json;

Result<json> parse_json(std::string_view text, const ImportLimits& limits) {
  if (const auto fault = json_limits_fault(text, {limits.file_bytes, limits.json_values, limits.json_depth})) {
    return refused("JSON", fault->cause, "simplify the model");
  }
  try {
    json parsed = json::parse(text);
    if (!parsed.is_object()) return refused("JSON", "its root is not an object", "open a .glb or .gltf file");
    return parsed;
  } catch (const json::exception& error) {
    // The library's text starts with its own tag, "[json.exception.parse_error.101] ".
    const std::string what = error.what();
    const std::size_t tag = what.find("] ");
    return refused("JSON", printable(tag == std::string::npos ? what : what.substr(tag + 2), 200),
                   "open a .glb or .gltf file");
  }
}

Status check_asset(const json& file) {
  const auto asset = file.find("asset");
  if (asset == file.end() || !asset->is_object()) return refused("asset", "it is missing", "open a glTF 2.0 file");
  const auto version = asset->find("version");
  if (version == asset->end() || !version->is_string())
    return refused("asset", "it names no version", "open a glTF 2.0 file");
  if (!version->get_ref<const std::string&>().starts_with("2.")) {
    return refused("asset", "version " + printable(version->get_ref<const std::string&>()) + " is not 2.x",
                   "export it as glTF 2.0");
  }
  return success();
}

/// The bytes of a data URI: base64, or percent-encoded (RFC 2397). None when a character is not base64.
std::optional<std::string> data_uri_bytes(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view body = uri.substr(comma + 1);
  return uri.substr(0, comma).ends_with(";base64") ? base64_decode(body) : std::optional(percent_decode(body));
}

Result<Buffer> read_buffer(const json& entry, std::size_t index, const Container& container,
                           const ExternalBuffers& external) {
  const std::string place = "buffer " + std::to_string(index);
  if (!entry.is_object()) return refused(place, "it is not an object");
  const auto promised = read_integer(entry, "byteLength", place);
  if (!promised.ok()) return promised.error();
  if (!*promised) return refused(place, "it has no byteLength");

  Buffer buffer;
  buffer.length = **promised;
  const auto uri = entry.find("uri");
  if (uri == entry.end()) {
    if (index != 0 || !container.binary) {
      buffer.missing = "the file holds no bytes for " + place;
      return buffer;
    }
    buffer.bytes = *container.binary;
  } else if (!uri->is_string()) {
    return refused(place, "its uri is not a string");
  } else if (const std::string& text = uri->get_ref<const std::string&>(); is_data_uri(text)) {
    std::optional<std::string> decoded = data_uri_bytes(text);
    if (!decoded) return refused(place, "its data URI cannot be decoded");
    buffer.decoded = std::move(*decoded);
    buffer.bytes = buffer.decoded;
  } else if (const std::string* given = find_external(external, text)) {
    buffer.bytes = *given;
  } else {
    buffer.missing = "the file '" + printable(text) + "' is not there";
    return buffer;
  }
  if (buffer.bytes.size() < **promised) {
    return refused(
        place, "it promises " + std::to_string(**promised) + " bytes and has " + std::to_string(buffer.bytes.size()));
  }
  buffer.bytes = buffer.bytes.substr(0, **promised);
  return buffer;
}

Status read_buffers(Document& document, const ExternalBuffers& external) {
  const auto buffers = document.json.find("buffers");
  if (buffers == document.json.end()) return success();
  if (!buffers->is_array()) return refused("buffers", "it is not an array");
  document.buffers.reserve(buffers->size());  // views into `decoded` must not move
  for (std::size_t i = 0; i < buffers->size(); ++i) {
    Result<Buffer> buffer = read_buffer((*buffers)[i], i, document.container, external);
    if (!buffer.ok()) return buffer.error();
    document.buffers.push_back(std::move(*buffer));
    Buffer& kept = document.buffers.back();
    // A short string moves its bytes along with itself.
    if (!kept.decoded.empty()) kept.bytes = std::string_view(kept.decoded).substr(0, kept.bytes.size());
  }
  return success();
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return uri.starts_with("data:");
}

const std::string* find_external(const ExternalBuffers& external, const std::string& uri) {
  auto found = external.find(uri);
  if (found == external.end()) found = external.find(percent_decode(uri));
  return found == external.end() ? nullptr : &found->second;
}

Result<Document> read_document(std::string_view bytes, const ExternalBuffers& external, const ImportLimits& limits) {
  if (bytes.empty()) return refused("file", "it is empty", "open a .glb or .gltf file");
  if (bytes.size() > limits.file_bytes) return refused("file", "it is larger than 1 GiB", "simplify the model");
  Document document;
  Result<Container> container = split_container(bytes);
  if (!container.ok()) return container.error();
  document.container = std::move(*container);
  Result<json> file = parse_json(document.container.json, limits);
  if (!file.ok()) return file.error();
  document.json = std::move(*file);
  if (const Status asset = check_asset(document.json); !asset.ok()) return asset.error();
  if (const Status sections = read_sections(document); !sections.ok()) return sections.error();
  if (const Status buffers = read_buffers(document, external); !buffers.ok()) return buffers.error();
  return document;
}

std::vector<std::string> external_uris(std::string_view bytes) {
  std::vector<std::string> uris;
  const Result<Container> container = split_container(bytes);
  if (!container.ok()) return uris;
  const Result<json> file = parse_json(container->json, ImportLimits());
  if (!file.ok()) return uris;
  const auto buffers = file->find("buffers");
  if (buffers == file->end() || !buffers->is_array()) return uris;
  for (const json& buffer : *buffers) {
    if (!buffer.is_object()) continue;
    const auto uri = buffer.find("uri");
    if (uri == buffer.end() || !uri->is_string()) continue;
    const std::string& text = uri->get_ref<const std::string&>();
    if (!is_data_uri(text)) uris.push_back(percent_decode(text));
  }
  return uris;
}

}  // namespace parsel::gltf
