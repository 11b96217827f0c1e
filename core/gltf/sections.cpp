#include "core/gltf/sections.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "core/base/text.h"
#include "core/gltf/refusal.h"

namespace parsel::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t largest_integer = 0x7fffffff;

bool is_integer(const json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= largest_integer;
}

std::string text_of(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The extension's object; null when there is none.
const json* extension(const json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

/// Reads members into variables; the first that is malformed stays as the error.
class Members {
 public:
  Members(const json& object, std::string place) : object_(object), place_(std::move(place)) {}

  Members& optional(const char* name, std::optional<std::size_t>& out) {
    if (!status_.ok()) return *this;
    auto value = read_integer(object_, name, place_);
    if (value.ok()) {
      out = *value;
    } else {
      status_ = value.error();
    }
    return *this;
  }
  Members& defaulted(const char* name, std::size_t& out) {
    std::optional<std::size_t> value;
    optional(name, value);
    out = value.value_or(out);
    return *this;
  }
  Members& required(const char* name, std::size_t& out) {
    std::optional<std::size_t> value;
    optional(name, value);
    if (status_.ok() && !value) status_ = refused(place_, std::string("it has no ") + name);
    out = value.value_or(out);
    return *this;
  }
  /// An optional array of indices.
  Members& indices(const char* name, std::vector<std::size_t>& out) {
    const auto found = object_.find(name);
    if (!status_.ok() || found == object_.end()) return *this;
    if (!found->is_array() || !std::all_of(found->begin(), found->end(), is_integer)) {
      status_ = refused(place_, std::string(name) + " is not an array of indices");
      return *this;
    }
    out = found->get<std::vector<std::size_t>>();
    return *this;
  }
  /// An optional array of `size` numbers.
  Members& numbers(const char* name, std::size_t size) {
    const auto found = object_.find(name);
    if (!status_.ok() || found == object_.end()) return *this;
    const bool good = found->is_array() && found->size() == size &&
                      std::all_of(found->begin(), found->end(), [](const json& x) { return x.is_number(); });
    if (!good)
      status_ = refused(place_, std::string(name) + " is not an array of " + std::to_string(size) + " numbers");
    return *this;
  }
  const Status& status() const { return status_; }

 private:
  const json& object_;
  std::string place_;
  Status status_ = success();
};

std::size_t component_count(const std::string& type) {
  static constexpr std::array<const char*, 4> types{"SCALAR", "VEC2", "VEC3", "VEC4"};
  const auto found = std::find(types.begin(), types.end(), type);
  return found == types.end() ? 0 : static_cast<std::size_t>(found - types.begin()) + 1;
}

Status read_view(const json& entry, const std::string& place, BufferView& out) {
  const json* const meshopt = extension(entry, "EXT_meshopt_compression");
  out.meshopt = meshopt != nullptr || extension(entry, "KHR_meshopt_compression") != nullptr;
  out.extended = entry.contains("extensions");
  return Members(entry, place)
      .required("buffer", out.buffer)
      .defaulted("byteOffset", out.offset)
      .required("byteLength", out.length)
      .defaulted("byteStride", out.stride)
      .status();
}

Status read_sparse(const json& entry, const std::string& place, Accessor::Sparse& out) {
  if (!entry.is_object()) return refused(place, "sparse is not an object");
  if (Status s = Members(entry, place).required("count", out.count).status(); !s.ok()) return s;
  for (const char* name : {"indices", "values"}) {
    const auto part = entry.find(name);
    if (part == entry.end() || !part->is_object()) return refused(place, std::string("sparse has no ") + name);
  }
  const json &indices = entry["indices"], &values = entry["values"];
  Status read = Members(indices, place)
                    .required("bufferView", out.index_view)
                    .defaulted("byteOffset", out.index_offset)
                    .required("componentType", out.index_type)
                    .status();
  if (!read.ok()) return read;
  return Members(values, place)
      .required("bufferView", out.value_view)
      .defaulted("byteOffset", out.value_offset)
      .status();
}

Status read_accessor_entry(const json& entry, const std::string& place, Accessor& out) {
  Status read = Members(entry, place)
                    .optional("bufferView", out.view)
                    .defaulted("byteOffset", out.offset)
                    .required("componentType", out.component_type)
                    .required("count", out.count)
                    .status();
  if (!read.ok()) return read;
  out.components = component_count(text_of(entry, "type"));
  const auto normalized = entry.find("normalized");
  out.normalized = normalized != entry.end() && normalized->is_boolean() && normalized->get<bool>();
  const auto sparse = entry.find("sparse");
  return sparse == entry.end() ? success() : read_sparse(*sparse, place, out.sparse.emplace());
}

/// Of a morph target, what is no index is left out: it moves nothing that is read here.
Attributes target_attributes(const json& target) {
  Attributes out;
  if (!target.is_object()) return out;
  for (const auto& [name, value] : target.items()) {
    if (is_integer(value)) out[name] = value.get<std::size_t>();
  }
  return out;
}

Status read_primitive_entry(const json& entry, const std::string& place, Primitive& out) {
  if (!entry.is_object()) return refused(place, "it is not an object");
  const auto attributes = entry.find("attributes");
  if (attributes == entry.end() || !attributes->is_object()) return refused(place, "it has no attributes");
  for (const auto& [name, value] : attributes->items()) {
    if (!is_integer(value)) return refused(place, "attribute " + printable(name) + " is not an accessor index");
    out.attributes[name] = value.get<std::size_t>();
  }
  out.has_draco = extension(entry, draco) != nullptr;
  if (const auto targets = entry.find("targets"); targets != entry.end() && targets->is_array()) {
    for (const json& target : *targets) out.targets.push_back(target_attributes(target));
  }
  return Members(entry, place)
      .optional("indices", out.indices)
      .defaulted("mode", out.mode)
      .optional("material", out.material)
      .status();
}

Status read_mesh(const json& entry, const std::string& place, Mesh& out) {
  out.name = text_of(entry, "name");
  const auto primitives = entry.find("primitives");
  if (primitives == entry.end() || !primitives->is_array()) return refused(place, "it has no primitives");
  for (std::size_t i = 0; i < primitives->size(); ++i) {
    const std::string primitive = place + ", primitive " + std::to_string(i);
    const Status read = read_primitive_entry((*primitives)[i], primitive, out.primitives.emplace_back());
    if (!read.ok()) return read;
  }
  return success();
}

Status read_node(const json& entry, const std::string& place, Node& out) {
  std::optional<std::size_t> skin;
  Status read = Members(entry, place)
                    .optional("mesh", out.mesh)
                    .optional("skin", skin)
                    .indices("children", out.children)
                    .numbers("matrix", 16)
                    .numbers("translation", 3)
                    .numbers("rotation", 4)
                    .numbers("scale", 3)
                    .status();
  if (!read.ok()) return read;
  out.name = text_of(entry, "name");
  out.skinned = skin.has_value();
  out.transform = read_transform(entry);
  out.instanced = extension(entry, "EXT_mesh_gpu_instancing") != nullptr;
  if (const json* visibility = extension(entry, "KHR_node_visibility");
      visibility != nullptr && visibility->is_object()) {
    const auto visible = visibility->find("visible");
    out.visible = visible == visibility->end() || !visible->is_boolean() || visible->get<bool>();
  }
  if (const json* lod = extension(entry, "MSFT_lod"); lod != nullptr && lod->is_object() && lod->contains("ids")) {
    const json& ids = (*lod)["ids"];
    for (std::size_t i = 0; ids.is_array() && i < ids.size(); ++i) {
      if (is_integer(ids[i])) out.levels.push_back(ids[i].get<std::size_t>());
    }
  }
  return success();
}

/// Reads the entries of a top-level array, each with `read`.
template <class T>
Status read_section(const json& file, const char* section, const char* element, std::vector<T>& out,
                    Status (*read)(const json&, const std::string&, T&)) {
  const auto found = file.find(section);
  if (found == file.end()) return success();
  if (!found->is_array()) return refused(section, "it is not an array");
  out.reserve(found->size());
  for (std::size_t i = 0; i < found->size(); ++i) {
    const std::string place = std::string(element) + " " + std::to_string(i);
    if (!(*found)[i].is_object()) return refused(place, "it is not an object");
    if (Status s = read((*found)[i], place, out.emplace_back()); !s.ok()) return s;
  }
  return success();
}

Status read_scene_roots(const json& entry, const std::string& place, std::vector<std::size_t>& out) {
  return Members(entry, place).indices("nodes", out).status();
}

Status read_roots(Document& document) {
  std::vector<std::vector<std::size_t>> scenes;
  Status read = read_section(document.json, "scenes", "scene", scenes, read_scene_roots);
  if (!read.ok()) return read;
  const auto index = read_integer(document.json, "scene", "scene");
  if (!index.ok()) return index.error();
  document.scene = index->value_or(0);
  if (scenes.empty()) return success();
  if (document.scene >= scenes.size()) {
    return refused("scene", "scene " + std::to_string(document.scene) + " does not exist");
  }
  document.roots = std::move(scenes[document.scene]);
  return success();
}

}  // namespace

Result<std::optional<std::size_t>> read_integer(const json& object, const char* name, const std::string& place) {
  const auto found = object.find(name);
  if (found == object.end()) return std::optional<std::size_t>();
  if (!is_integer(*found)) return refused(place, std::string(name) + " is not an integer from 0 to 2147483647");
  return std::optional(found->get<std::size_t>());
}

Result<Primitive> read_primitive(const json& entry, const std::string& place) {
  Primitive out;
  if (Status s = read_primitive_entry(entry, place, out); !s.ok()) return s.error();
  return out;
}

Status read_sections(Document& document) {
  const json& file = document.json;
  if (Status s = read_section(file, "bufferViews", "bufferView", document.views, read_view); !s.ok()) return s;
  if (Status s = read_section(file, "accessors", "accessor", document.accessors, read_accessor_entry); !s.ok())
    return s;
  if (Status s = read_section(file, "meshes", "mesh", document.meshes, read_mesh); !s.ok()) return s;
  if (Status s = read_section(file, "nodes", "node", document.nodes, read_node); !s.ok()) return s;
  return read_roots(document);
}

}  // namespace parsel::gltf
