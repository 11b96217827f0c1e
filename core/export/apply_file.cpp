#include "core/export/apply_file.h"

#include <nlohmann/json.hpp>

#include "core/base/uri.h"

namespace parsel::gltf {
namespace {

using nlohmann::ordered_json;

constexpr std::uint32_t glb_magic = 0x46546C67;   // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN\0"

Error refusal(std::string place, std::string cause, std::string fix) {
  return {"edit/apply_file", std::move(place), std::move(cause), std::move(fix)};
}

std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

void write_u32(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

bool is_data_uri(std::string_view uri) {
  return uri.substr(0, 5) == "data:";
}

std::optional<std::string> data_uri_bytes(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view header = uri.substr(0, comma), body = uri.substr(comma + 1);
  if (header.size() >= 7 && header.substr(header.size() - 7) == ";base64") return base64_decode(body);
  return percent_decode(body);
}

const std::string* given(const ExternalFiles& external, const std::string& uri) {
  auto found = external.find(uri);
  if (found == external.end()) found = external.find(percent_decode(uri));
  return found == external.end() ? nullptr : &found->second;
}

/// Fills file.buffers from the binary chunk, data URIs and the files given.
Status resolve_buffers(File& file, const std::optional<std::string>& chunk, const ExternalFiles& external) {
  for (std::size_t i = 0; i < file.size("buffers"); ++i) {
    const std::string place = "buffer " + std::to_string(i);
    const JsonText& buffer = file.item("buffers", i);
    std::optional<std::string> bytes;
    if (const auto uri = buffer.get("uri").string()) {
      if (is_data_uri(*uri)) {
        bytes = data_uri_bytes(*uri);
        if (!bytes) return refusal(place, "its data URI cannot be decoded", "export the file again");
      } else if (const std::string* found = given(external, *uri)) {
        bytes = *found;
      }
    } else if (i == 0 && chunk) {
      bytes = chunk;
    }
    const auto length = buffer.get("byteLength").index();
    if (!length) return refusal(place, "it has no byteLength", "export the file again");
    if (bytes && bytes->size() < *length) {
      return refusal(place, "it ends before its byteLength", "check that the file is complete");
    }
    file.buffers.push_back(std::move(bytes));
  }
  if (!file.buffers.empty() && file.buffers[0]) file.binary = *file.buffers[0];
  return success();
}

std::optional<std::string> image_type(std::string_view bytes) {
  if (bytes.substr(0, 4) == "\x89PNG") return "image/png";
  if (bytes.substr(0, 3) == "\xFF\xD8\xFF") return "image/jpeg";
  if (bytes.substr(0, 4) == "RIFF" && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") return "image/webp";
  if (bytes.substr(0, 6) == "\xABKTX 2") return "image/ktx2";
  return std::nullopt;
}

void embed_images(File& file, const ExternalFiles& external) {
  for (std::size_t i = 0; i < file.size("images"); ++i) {
    JsonText* image = file.find_item("images", i);
    const auto uri = image->get("uri").string();
    if (!image->is_object() || !uri || is_data_uri(*uri)) continue;
    const std::string* bytes = given(external, *uri);
    const auto type = bytes == nullptr ? std::nullopt : image_type(*bytes);
    if (!type) continue;
    const std::size_t offset = file.append_bytes(*bytes);
    const std::size_t view = file.append(
        "bufferViews", JsonText(ordered_json{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes->size()}}));
    image = file.find_item("images", i);
    image->erase("uri");
    image->set("bufferView", JsonText(view));
    if (!image->has("mimeType")) image->set("mimeType", JsonText(*type));
  }
}

void embed_buffers(File& file) {
  for (std::size_t i = 1; i < file.size("buffers"); ++i) {
    JsonText* buffer = file.find_item("buffers", i);
    const auto uri = buffer->get("uri").string();
    if (!uri || is_data_uri(*uri) || !file.buffers[i]) continue;
    buffer->set("uri", JsonText("data:application/octet-stream;base64," + base64_encode(*file.buffers[i])));
  }
}

void write_chunk(std::string& out, std::uint32_t type, std::string bytes, char padding) {
  bytes.append((4 - bytes.size() % 4) % 4, padding);
  write_u32(out, static_cast<std::uint32_t>(bytes.size()));
  write_u32(out, type);
  out += bytes;
}

}  // namespace

JsonText* File::find_item(std::string_view array, std::size_t i) {
  JsonText* all = json.find(array);
  return all == nullptr ? nullptr : all->find_item(i);
}

std::size_t File::append(std::string_view array, JsonText value) {
  if (!json.get(array).is_array()) json.set(array, JsonText(ordered_json::array()));
  JsonText* all = json.find(array);
  all->push_back(std::move(value));
  return all->size() - 1;
}

std::size_t File::append_bytes(std::string_view bytes) {
  binary.append((4 - binary.size() % 4) % 4, '\0');
  const std::size_t offset = binary.size();
  binary += bytes;
  return offset;
}

Result<File> read_file(std::string_view bytes, const ExternalFiles& external) {
  File file;
  std::string_view json = bytes;
  std::optional<std::string> binary;
  if (bytes.size() >= 4 && read_u32(bytes, 0) == glb_magic) {
    file.is_glb = true;
    if (bytes.size() < 12) return refusal("header", "the file ends early", "check that it is complete");
    if (read_u32(bytes, 4) != 2) return refusal("header", "only GLB version 2 can be read", "export it as glTF 2.0");
    const std::size_t length = read_u32(bytes, 8);
    if (length > bytes.size()) return refusal("header", "the file ends early", "check that it is complete");
    bool first = true;
    for (std::size_t at = 12; at + 8 <= length; first = false) {
      const std::size_t size = read_u32(bytes, at);
      const std::uint32_t type = read_u32(bytes, at + 4);
      if (size > length - at - 8) return refusal("chunk", "a chunk ends early", "check that the file is complete");
      const std::string_view content = bytes.substr(at + 8, size);
      if (first != (type == json_chunk)) return refusal("chunk", "the JSON chunk is not the first", "export it again");
      if (first) {
        json = content;
      } else if (type == bin_chunk && !binary) {
        binary = std::string(content);
      } else {
        file.other_chunks.push_back({type, std::string(content)});
      }
      at += 8 + size;
    }
    if (first) return refusal("header", "there is no JSON chunk", "check that the file is complete");
    while (!json.empty() && json.back() == '\0') json.remove_suffix(1);  // some writers pad with zeros
  }
  auto parsed = JsonText::parse(json);
  if (!parsed) return refusal("JSON", "this is not valid JSON", "check that the file is a complete glTF or GLB file");
  file.json = std::move(parsed).value();
  if (!file.json.is_object()) return refusal("JSON", "a glTF file is an object", "check that this is a glTF file");
  const Status resolved = resolve_buffers(file, binary, external);
  if (!resolved.ok()) return resolved.error();
  return file;
}

void embed(File& file, const ExternalFiles& external) {
  embed_images(file, external);
  embed_buffers(file);
}

Result<std::string> write_glb(File file) {
  if (file.size("buffers") == 0 && !file.binary.empty()) {
    file.append("buffers", JsonText(ordered_json{{"byteLength", 0}}));
  } else if (file.size("buffers") > 0 && !file.buffers[0]) {
    return refusal("buffer 0", "its bytes are neither in the file nor given", "give the .bin file as well");
  }
  if (JsonText* buffer = file.find_item("buffers", 0)) {
    buffer->erase("uri");
    // The chunk may be up to three bytes of padding longer than the buffer.
    const std::size_t length = buffer->get("byteLength").index().value_or(0);
    if (file.binary.size() < length || file.binary.size() - length > 3) {
      buffer->set("byteLength", JsonText(file.binary.size()));
    }
  }

  std::string body;
  write_chunk(body, json_chunk, file.json.text(), ' ');
  if (!file.binary.empty()) write_chunk(body, bin_chunk, std::move(file.binary), '\0');
  for (Chunk& chunk : file.other_chunks) write_chunk(body, chunk.type, std::move(chunk.bytes), '\0');
  if (body.size() + 12 > 0xFFFFFFFFULL) {
    return refusal("", "the result is larger than the 4 GB that GLB allows", "edit a smaller model");
  }
  std::string out;
  write_u32(out, glb_magic);
  write_u32(out, 2);
  write_u32(out, static_cast<std::uint32_t>(body.size() + 12));
  return out + body;
}

}  // namespace parsel::gltf
