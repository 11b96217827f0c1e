#include <fstream>  // tinygltf needs the type even without a filesystem

#define TINYGLTF_IMPLEMENTATION
#include "core/gltf/document.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <utility>

#include "core/base/json.h"
#include "core/base/text.h"
#include "core/base/uri.h"

namespace parsel {
namespace {

using nlohmann::json;

Error refused(std::string place, std::string cause, std::string fix = "export the model again") {
  return {"shape/gltf_import", std::move(place), std::move(cause), std::move(fix)};
}

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return value;
}

struct Container {
  std::string_view json;
  std::string_view binary;  ///< the BIN chunk
  bool has_binary = false;
};

/// Splits a GLB into its chunks (glTF 2.0 §4.4); a file that does not start with its magic is taken for JSON.
Result<Container> split_container(std::string_view bytes) {
  if (!bytes.starts_with("glTF")) return Container{bytes, {}, false};
  if (bytes.size() < 20) return refused("GLB header", "the file ends inside it");
  const std::uint32_t version = little_endian(bytes, 4);
  if (version != 2)
    return refused("GLB header", "version " + std::to_string(version) + " is not 2", "export it as glTF 2.0");
  const std::size_t length = little_endian(bytes, 8);
  if (length > bytes.size()) {
    return refused("GLB header",
                   "it promises " + std::to_string(length) + " bytes, the file has " + std::to_string(bytes.size()));
  }
  if (length < 20) return refused("GLB header", "it promises too few bytes");
  Container container;
  bool has_json = false;
  for (std::size_t at = 12; length - at >= 8;) {
    const std::size_t size = little_endian(bytes, at);
    const std::uint32_t type = little_endian(bytes, at + 4);
    if (size > length - at - 8) return refused("GLB chunk at byte " + std::to_string(at), "it reaches beyond the file");
    const std::string_view chunk = bytes.substr(at + 8, size);
    if (!has_json) {
      if (type != 0x4E4F534A) return refused("GLB chunk at byte 12", "the first chunk is not JSON");
      container.json = chunk;
      has_json = true;
    } else if (type == 0x004E4942 && !container.has_binary) {
      container.binary = chunk;
      container.has_binary = true;
    }
    at += 8 + size;
  }
  if (!has_json) return refused("GLB header", "there is no JSON chunk");
  return container;
}

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

/// tinygltf reads an optional number of the wrong type as if it were absent, which would change the mesh silently.
Status check_integers(const json& object, const std::string& place, std::initializer_list<const char*> names) {
  constexpr std::uint64_t limit = 0x7fffffff;
  for (const char* name : names) {
    const auto found = object.find(name);
    if (found == object.end()) continue;
    if (!found->is_number_unsigned() || found->get<std::uint64_t>() > limit) {
      return refused(place, std::string(name) + " is not an integer from 0 to 2147483647");
    }
  }
  return success();
}

/// An optional member that must be an array of numbers, of the given sizes.
Status check_numbers(const json& object, const std::string& place, const char* name, std::size_t size) {
  const auto found = object.find(name);
  if (found == object.end()) return success();
  const bool good = found->is_array() && found->size() == size &&
                    std::all_of(found->begin(), found->end(), [](const json& x) { return x.is_number(); });
  if (!good) return refused(place, std::string(name) + " is not an array of " + std::to_string(size) + " numbers");
  return success();
}

/// An optional member that must be an array of non-negative integers.
Status check_indices(const json& object, const std::string& place, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return success();
  const bool good = found->is_array() && std::all_of(found->begin(), found->end(), [](const json& x) {
                      return x.is_number_unsigned() && x.get<std::uint64_t>() <= 0x7fffffff;
                    });
  if (!good) return refused(place, std::string(name) + " is not an array of indices");
  return success();
}

Status check_primitive(const json& primitive, const std::string& place) {
  if (!primitive.is_object()) return refused(place, "it is not an object");
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object()) return refused(place, "it has no attributes");
  for (const auto& [name, value] : attributes->items()) {
    if (!value.is_number_unsigned())
      return refused(place, "attribute " + printable(name) + " is not an accessor index");
  }
  return check_integers(primitive, place, {"indices", "mode", "material"});
}

Status check_mesh(const json& mesh, const std::string& place) {
  const auto primitives = mesh.find("primitives");
  if (primitives == mesh.end() || !primitives->is_array()) return refused(place, "it has no primitives");
  for (std::size_t i = 0; i < primitives->size(); ++i) {
    if (Status s = check_primitive((*primitives)[i], place + ", primitive " + std::to_string(i)); !s.ok()) return s;
  }
  return success();
}

Status check_node(const json& node, const std::string& place) {
  if (Status s = check_integers(node, place, {"mesh", "skin"}); !s.ok()) return s;
  if (Status s = check_indices(node, place, "children"); !s.ok()) return s;
  constexpr std::array<std::pair<const char*, std::size_t>, 4> transforms = {
      {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
  for (const auto& [name, size] : transforms) {
    if (Status s = check_numbers(node, place, name, size); !s.ok()) return s;
  }
  return success();
}

Status check_accessor(const json& accessor, const std::string& place) {
  if (Status s = check_integers(accessor, place, {"bufferView", "byteOffset", "componentType", "count"}); !s.ok())
    return s;
  const auto sparse = accessor.find("sparse");
  if (sparse == accessor.end()) return success();
  if (!sparse->is_object()) return refused(place, "sparse is not an object");
  if (Status s = check_integers(*sparse, place, {"count"}); !s.ok()) return s;
  for (const char* name : {"indices", "values"}) {
    const auto part = sparse->find(name);
    if (part == sparse->end() || !part->is_object()) return refused(place, std::string("sparse has no ") + name);
    if (Status s = check_integers(*part, place, {"bufferView", "byteOffset", "componentType"}); !s.ok()) return s;
  }
  return success();
}

Status check_buffer_view(const json& view, const std::string& place) {
  return check_integers(view, place, {"buffer", "byteOffset", "byteLength", "byteStride"});
}
Status check_scene(const json& scene, const std::string& place) {
  return check_indices(scene, place, "nodes");
}
Status check_nothing(const json&, const std::string&) {
  return success();
}

/// Moves what the importer reads, checked, into a JSON of its own for tinygltf.
Result<json> checked_sections(const json& file) {
  struct Section {
    const char* name;
    const char* element;
    Status (*check)(const json&, const std::string&);
    std::vector<const char*> keys;  ///< copied to tinygltf
  };
  static const std::vector<Section> sections = {
      {"scenes", "scene", check_scene, {"nodes", "name"}},
      {"nodes", "node", check_node, {"name", "mesh", "skin", "children", "matrix", "translation", "rotation", "scale"}},
      {"meshes", "mesh", check_mesh, {"name", "primitives"}},
      {"accessors",
       "accessor",
       check_accessor,
       {"bufferView", "byteOffset", "normalized", "componentType", "count", "type", "sparse"}},
      {"bufferViews", "bufferView", check_buffer_view, {"buffer", "byteOffset", "byteLength", "byteStride"}},
      {"materials", "material", check_nothing, {"name"}},
  };
  json reduced = {{"asset", {{"version", "2.0"}}}};
  for (const Section& section : sections) {
    const auto found = file.find(section.name);
    if (found == file.end()) continue;
    if (!found->is_array()) return refused(section.name, "it is not an array");
    json& out = reduced[section.name] = json::array();
    for (std::size_t i = 0; i < found->size(); ++i) {
      const json& element = (*found)[i];
      const std::string place = std::string(section.element) + " " + std::to_string(i);
      if (!element.is_object()) return refused(place, "it is not an object");
      if (Status s = section.check(element, place); !s.ok()) return s.error();
      json& copy = out.emplace_back(json::object());
      for (const char* key : section.keys) {
        if (const auto value = element.find(key); value != element.end()) copy[key] = *value;
      }
    }
  }
  if (Status s = check_integers(file, "scene", {"scene"}); !s.ok()) return s.error();
  if (const auto scene = file.find("scene"); scene != file.end()) reduced["scene"] = *scene;
  return reduced;
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

Result<GltfBuffer> read_buffer(const json& entry, std::size_t index, const Container& container,
                               const ExternalBuffers& external) {
  const std::string place = "buffer " + std::to_string(index);
  if (!entry.is_object()) return refused(place, "it is not an object");
  const auto length = entry.find("byteLength");
  if (length == entry.end() || !length->is_number_unsigned()) return refused(place, "it has no byteLength");
  const std::uint64_t promised = length->get<std::uint64_t>();

  GltfBuffer buffer;
  const auto uri = entry.find("uri");
  if (uri == entry.end()) {
    if (index == 0 && container.has_binary) {
      buffer.bytes = container.binary;
    } else {
      buffer.missing = "the file holds no bytes for " + place;
      return buffer;
    }
  } else if (!uri->is_string()) {
    return refused(place, "its uri is not a string");
  } else if (const std::string& text = uri->get_ref<const std::string&>(); text.starts_with("data:")) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64")) {
      return refused(place, "its data URI is not base64");
    }
    std::optional<std::string> decoded = base64_decode(std::string_view(text).substr(comma + 1));
    if (!decoded) return refused(place, "its data URI holds a character that is not base64");
    buffer.decoded = std::move(*decoded);
    buffer.bytes = buffer.decoded;
  } else {
    const auto file = external.find(percent_decode(text));
    if (file == external.end()) {
      buffer.missing = "the file '" + printable(text) + "' is not there";
      return buffer;
    }
    buffer.bytes = file->second;
  }
  if (buffer.bytes.size() < promised) {
    return refused(place,
                   "it promises " + std::to_string(promised) + " bytes and has " + std::to_string(buffer.bytes.size()));
  }
  buffer.bytes = buffer.bytes.substr(0, static_cast<std::size_t>(promised));
  return buffer;
}

}  // namespace

std::vector<std::string> external_buffer_uris(std::string_view bytes) {
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
    if (!text.starts_with("data:")) uris.push_back(percent_decode(text));
  }
  return uris;
}

Result<GltfDocument> read_gltf_document(std::string_view bytes, const ExternalBuffers& external,
                                        const ImportLimits& limits) {
  if (bytes.empty()) return refused("file", "it is empty", "open a .glb or .gltf file");
  if (bytes.size() > limits.file_bytes) return refused("file", "it is larger than 1 GiB", "simplify the model");
  const Result<Container> container = split_container(bytes);
  if (!container.ok()) return container.error();
  Result<json> file = parse_json(container->json, limits);
  if (!file.ok()) return file.error();
  if (const Status asset = check_asset(*file); !asset.ok()) return asset.error();
  const Result<json> sections = checked_sections(*file);
  if (!sections.ok()) return sections.error();

  GltfDocument document;
  if (const auto buffers = file->find("buffers"); buffers != file->end()) {
    if (!buffers->is_array()) return refused("buffers", "it is not an array");
    document.buffers.reserve(buffers->size());  // views into `decoded` must not move
    for (std::size_t i = 0; i < buffers->size(); ++i) {
      Result<GltfBuffer> buffer = read_buffer((*buffers)[i], i, *container, external);
      if (!buffer.ok()) return buffer.error();
      document.buffers.push_back(std::move(*buffer));
      GltfBuffer& kept = document.buffers.back();
      // A short string moves its bytes along with itself.
      if (!kept.decoded.empty()) kept.bytes = std::string_view(kept.decoded).substr(0, kept.bytes.size());
    }
  }
  const std::string text = sections->dump();
  tinygltf::TinyGLTF loader;
  std::string error, warning;
  try {
    if (!loader.LoadASCIIFromString(&document.model, &error, &warning, text.data(), static_cast<unsigned>(text.size()),
                                    "", 0)) {
      return refused("JSON", printable(error.substr(0, error.find('\n')), 200));
    }
  } catch (const std::exception& failure) {
    return refused("JSON", printable(failure.what(), 200));
  }
  document.json = std::move(*file);
  return document;
}

}  // namespace parsel
