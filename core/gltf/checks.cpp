#include "core/gltf/checks.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "core/base/text.h"
#include "core/gltf/refusal.h"

namespace parsel::gltf {
namespace {

using nlohmann::json;

constexpr std::uint64_t largest_integer = 0x7fffffff;
/// glTF 2.0 §5.11.4; anything else is a damaged file, and the page's renderer would read something else than we do.
constexpr std::size_t largest_stride = 252, stride_unit = 4;

bool is_integer(const json& value) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= largest_integer;
}

/// Optional members that must be integers.
Status check_integers(const json& object, const std::string& place, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (const auto value = read_integer(object, name, place); !value.ok()) return value.error();
  }
  return success();
}

Status check_present(const json& object, const std::string& place, std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (!object.contains(name)) return refused(place, std::string("it has no ") + name);
  }
  return success();
}

/// An optional member that must be an array of numbers, of the given size.
Status check_numbers(const json& object, const std::string& place, const char* name, std::size_t size) {
  const auto found = object.find(name);
  if (found == object.end()) return success();
  const bool good = found->is_array() && found->size() == size &&
                    std::all_of(found->begin(), found->end(), [](const json& x) { return x.is_number(); });
  if (!good) return refused(place, std::string(name) + " is not an array of " + std::to_string(size) + " numbers");
  return success();
}

/// An optional member that must be an array of indices.
Status check_indices(const json& object, const std::string& place, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return success();
  if (!found->is_array() || !std::all_of(found->begin(), found->end(), is_integer)) {
    return refused(place, std::string(name) + " is not an array of indices");
  }
  return success();
}

Status check_primitive(const json& primitive, const std::string& place) {
  if (!primitive.is_object()) return refused(place, "it is not an object");
  const auto attributes = primitive.find("attributes");
  if (attributes == primitive.end() || !attributes->is_object()) return refused(place, "it has no attributes");
  for (const auto& [name, value] : attributes->items()) {
    if (!is_integer(value)) return refused(place, "attribute " + printable(name) + " is not an accessor index");
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

Status check_sparse(const json& sparse, const std::string& place) {
  if (!sparse.is_object()) return refused(place, "sparse is not an object");
  if (Status s = check_present(sparse, place, {"count"}); !s.ok()) return s;
  if (Status s = check_integers(sparse, place, {"count"}); !s.ok()) return s;
  for (const char* name : {"indices", "values"}) {
    const auto part = sparse.find(name);
    if (part == sparse.end() || !part->is_object()) return refused(place, std::string("sparse has no ") + name);
    if (Status s = check_integers(*part, place, {"bufferView", "byteOffset", "componentType"}); !s.ok()) return s;
    if (Status s = check_present(*part, place, {"bufferView"}); !s.ok()) return s;
  }
  return check_present(sparse["indices"], place, {"componentType"});
}

Status check_accessor(const json& accessor, const std::string& place) {
  if (Status s = check_present(accessor, place, {"componentType", "count", "type"}); !s.ok()) return s;
  if (Status s = check_integers(accessor, place, {"bufferView", "byteOffset", "componentType", "count"}); !s.ok())
    return s;
  static constexpr std::array<unsigned, 6> component_types{5120, 5121, 5122, 5123, 5125, 5126};
  const unsigned component_type = accessor["componentType"].get<unsigned>();
  if (std::find(component_types.begin(), component_types.end(), component_type) == component_types.end()) {
    return refused(place, "its component type " + std::to_string(component_type) + " is none of glTF's");
  }
  static constexpr std::array<const char*, 7> types{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  const json& type = accessor["type"];
  if (!type.is_string() || std::find(types.begin(), types.end(), type.get_ref<const std::string&>()) == types.end()) {
    return refused(place, "its type is none of glTF's");
  }
  const auto sparse = accessor.find("sparse");
  return sparse == accessor.end() ? success() : check_sparse(*sparse, place);
}

Status check_view(const json& view, const std::string& place) {
  if (Status s = check_present(view, place, {"buffer", "byteLength"}); !s.ok()) return s;
  if (Status s = check_integers(view, place, {"buffer", "byteOffset", "byteLength", "byteStride"}); !s.ok()) return s;
  const std::size_t stride = view.value("byteStride", std::size_t{0});
  if (stride > largest_stride || stride % stride_unit != 0) {
    return refused(place, "its byteStride is not a multiple of 4 up to 252");
  }
  return success();
}

Status check_scene(const json& scene, const std::string& place) {
  return check_indices(scene, place, "nodes");
}

/// Only what is a number of an accessor: the rest of a morph target moves nothing that is read here.
json plain_target(const json& target) {
  json out = json::object();
  if (!target.is_object()) return out;
  for (const auto& [name, value] : target.items()) {
    if (is_integer(value)) out[name] = value;
  }
  return out;
}

json plain_primitive(const json& primitive) {
  json out = {{"attributes", primitive["attributes"]}};
  for (const char* key : {"mode", "material"}) {
    if (const auto value = primitive.find(key); value != primitive.end()) out[key] = *value;
  }
  if (const auto targets = primitive.find("targets"); targets != primitive.end() && targets->is_array()) {
    json& plain = out["targets"] = json::array();
    for (const json& target : *targets) plain.push_back(plain_target(target));
  }
  return out;
}

json plain_primitives(const json& primitives) {
  json out = json::array();
  for (const json& primitive : primitives) out.push_back(plain_primitive(primitive));
  return out;
}

}  // namespace

Result<std::optional<std::size_t>> read_integer(const json& object, const char* name, const std::string& place) {
  const auto found = object.find(name);
  if (found == object.end()) return std::optional<std::size_t>();
  if (!is_integer(*found)) return refused(place, std::string(name) + " is not an integer from 0 to 2147483647");
  return std::optional(found->get<std::size_t>());
}

Result<json> checked_primitive(const json& entry, const std::string& place) {
  if (Status s = check_primitive(entry, place); !s.ok()) return s.error();
  return plain_primitive(entry);
}

Result<json> checked_sections(const json& file) {
  struct Section {
    const char* name;
    const char* element;
    Status (*check)(const json&, const std::string&);
    std::vector<const char*> keys;  ///< copied to tinygltf
  };
  static const std::vector<Section> sections = {
      {"bufferViews", "bufferView", check_view, {"buffer", "byteOffset", "byteLength", "byteStride"}},
      {"accessors",
       "accessor",
       check_accessor,
       {"bufferView", "byteOffset", "normalized", "componentType", "count", "type", "sparse"}},
      {"meshes", "mesh", check_mesh, {"name", "primitives"}},
      {"nodes", "node", check_node, {"name", "mesh", "skin", "children"}},
      {"scenes", "scene", check_scene, {"nodes"}},
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
      for (const std::string key : section.keys) {
        const auto value = element.find(key);
        if (value != element.end()) copy[key] = key == "primitives" ? plain_primitives(*value) : *value;
      }
    }
  }
  const auto scene = read_integer(file, "scene", "scene");
  if (!scene.ok()) return scene.error();
  if (*scene) reduced["scene"] = **scene;
  return reduced;
}

}  // namespace parsel::gltf
