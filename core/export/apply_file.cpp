#include "core/export/apply_file.h"

#include <nlohmann/json.hpp>

#include "core/base/uri.h"

namespace parsel::gltf {
namespace {

using nlohmann::ordered_json;

constexpr std::uint32_t glb_magic = 0x46546C67;  // "glTF"

void write_u32(std::string& out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out += static_cast<char>(value >> (8 * i) & 0xFF);
}

std::optional<std::string> image_type(std::string_view bytes) {
  if (bytes.substr(0, 4) == "\x89PNG") return "image/png";
  if (bytes.substr(0, 3) == "\xFF\xD8\xFF") return "image/jpeg";
  if (bytes.substr(0, 4) == "RIFF" && bytes.size() > 12 && bytes.substr(8, 4) == "WEBP") return "image/webp";
  if (bytes.substr(0, 6) == "\xABKTX 2") return "image/ktx2";
  return std::nullopt;
}

void embed_images(File& file, const ExternalBuffers& external) {
  for (std::size_t i = 0; i < file.size("images"); ++i) {
    JsonText* image = file.find_item("images", i);
    const auto uri = image->get("uri").string();
    if (!image->is_object() || !uri || is_data_uri(*uri)) continue;
    const std::string* bytes = find_external(external, *uri);
    const auto type = bytes == nullptr ? std::nullopt : image_type(*bytes);
    if (!type) continue;
    const std::size_t offset = file.append_bytes(*bytes);
    const std::size_t view = file.append(
        "bufferViews",
        JsonText(ordered_json{{"buffer", file.home}, {"byteOffset", offset}, {"byteLength", bytes->size()}}));
    image = file.find_item("images", i);
    image->erase("uri");
    image->set("bufferView", JsonText(view));
    if (!image->has("mimeType")) image->set("mimeType", JsonText(*type));
  }
}

void embed_buffers(File& file) {
  for (std::size_t i = 0; i < file.original.buffers.size(); ++i) {
    const Buffer& bytes = file.original.buffers[i];
    if (i == file.home || !bytes.missing.empty()) continue;
    JsonText* buffer = file.find_item("buffers", i);
    const auto uri = buffer->get("uri").string();
    if (!uri || is_data_uri(*uri)) continue;
    buffer->set("uri", JsonText("data:application/octet-stream;base64," + base64_encode(bytes.bytes)));
  }
}

/// The buffer that new data went to, when buffer 0 is out of reach and cannot be the binary chunk.
void append_home(File& file) {
  if (file.binary.empty()) return;
  const std::size_t index = file.append(
      "buffers", JsonText(ordered_json{{"byteLength", file.binary.size()},
                                       {"uri", "data:application/octet-stream;base64," + base64_encode(file.binary)}}));
  PARSEL_ASSERT(index == file.home, "nobody else appends buffers");
  file.binary.clear();
}

/// Buffer 0 becomes the binary chunk.
void describe_home(File& file) {
  if (file.size("buffers") == 0 && !file.binary.empty()) {
    file.append("buffers", JsonText(ordered_json{{"byteLength", 0}}));
  }
  JsonText* buffer = file.find_item("buffers", 0);
  if (buffer == nullptr) return;
  buffer->erase("uri");
  // The chunk may be up to three bytes of padding longer than the buffer.
  const std::size_t length = buffer->get("byteLength").index().value_or(0);
  if (file.binary.size() < length || file.binary.size() - length > 3) {
    buffer->set("byteLength", JsonText(file.binary.size()));
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

Result<File> read_file(std::string_view bytes, const ExternalBuffers& external) {
  auto document = read_document(bytes, external);
  if (!document) return document.error();
  File file;
  file.original = std::move(document).value();
  auto json = JsonText::parse(file.original.container.json);
  PARSEL_ASSERT(json.ok(), "what the reader accepts is JSON of fewer levels");
  file.json = std::move(json).value();
  const std::vector<Buffer>& buffers = file.original.buffers;
  if (!buffers.empty() && !buffers[0].missing.empty()) {
    file.home = buffers.size();
  } else if (!buffers.empty()) {
    const bool is_chunk = !file.item("buffers", 0).has("uri");
    file.binary = is_chunk ? *file.original.container.binary : buffers[0].bytes;
  }
  return file;
}

void embed(File& file, const ExternalBuffers& external) {
  embed_images(file, external);
  embed_buffers(file);
}

Result<std::string> write_glb(File file) {
  if (file.home == 0) {
    describe_home(file);
  } else {
    append_home(file);
  }
  std::string body;
  write_chunk(body, json_chunk, file.json.text(), ' ');
  if (!file.binary.empty()) write_chunk(body, binary_chunk, std::move(file.binary), '\0');
  for (const Chunk& chunk : file.original.container.others)
    write_chunk(body, chunk.type, std::string(chunk.bytes), '\0');
  if (body.size() + 12 > 0xFFFFFFFFULL) {
    return Error{"export/apply_file", "", "the result is larger than the 4 GB that GLB allows", "edit a smaller model"};
  }
  std::string out;
  write_u32(out, glb_magic);
  write_u32(out, 2);
  write_u32(out, static_cast<std::uint32_t>(body.size() + 12));
  return out + body;
}

}  // namespace parsel::gltf
