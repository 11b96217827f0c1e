#include <fstream>  // tinygltf needs the type even without a filesystem

#define TINYGLTF_IMPLEMENTATION
#include "core/gltf/sections.h"

#include <exception>
#include <utility>

#include "core/base/text.h"
#include "core/gltf/checks.h"
#include "core/gltf/refusal.h"
#include "core/gltf/tinygltf.h"

namespace parsel::gltf {
namespace {

using nlohmann::json;

/// tinygltf says −1 for what is missing.
std::optional<std::size_t> index_of(int value) {
  return value < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(value));
}

std::vector<std::size_t> indices_of(const std::vector<int>& values) {
  return {values.begin(), values.end()};
}

/// The extension's object; null when there is none.
const json* extension(const json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end() || !extensions->is_object()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

BufferView view_of(const tinygltf::BufferView& view, const json& entry) {
  BufferView out;
  out.buffer = static_cast<std::size_t>(view.buffer);
  out.offset = view.byteOffset;
  out.length = view.byteLength;
  out.stride = view.byteStride;
  out.meshopt = extension(entry, "EXT_meshopt_compression") || extension(entry, "KHR_meshopt_compression");
  out.extended = entry.contains("extensions");
  return out;
}

Accessor accessor_of(const tinygltf::Accessor& accessor) {
  Accessor out;
  out.view = index_of(accessor.bufferView);
  out.offset = accessor.byteOffset;
  out.count = accessor.count;
  out.component_type = static_cast<std::size_t>(accessor.componentType);
  const bool is_matrix =
      accessor.type == TINYGLTF_TYPE_MAT2 || accessor.type == TINYGLTF_TYPE_MAT3 || accessor.type == TINYGLTF_TYPE_MAT4;
  if (!is_matrix) {
    const auto type = static_cast<std::uint32_t>(accessor.type);
    out.components = static_cast<std::size_t>(tinygltf::GetNumComponentsInType(type));
  }
  out.normalized = accessor.normalized;
  if (accessor.sparse.isSparse) {
    const auto size = [](int value) { return static_cast<std::size_t>(value); };
    const auto& sparse = accessor.sparse;
    out.sparse = Accessor::Sparse{size(sparse.count),
                                  size(sparse.indices.bufferView),
                                  size(sparse.indices.byteOffset),
                                  size(sparse.indices.componentType),
                                  size(sparse.values.bufferView),
                                  size(sparse.values.byteOffset)};
  }
  return out;
}

Attributes attributes_of(const std::map<std::string, int>& attributes) {
  return {attributes.begin(), attributes.end()};
}

Primitive primitive_of(const tinygltf::Primitive& primitive, const json& entry) {
  Primitive out;
  out.attributes = attributes_of(primitive.attributes);
  for (const auto& target : primitive.targets) out.targets.push_back(attributes_of(target));
  if (const auto indices = entry.find("indices"); indices != entry.end()) out.indices = indices->get<std::size_t>();
  out.material = index_of(primitive.material);
  out.mode = static_cast<std::size_t>(primitive.mode);
  out.has_draco = extension(entry, draco) != nullptr;
  return out;
}

Mesh mesh_of(const tinygltf::Mesh& mesh, const json& entry) {
  Mesh out;
  out.name = mesh.name;
  for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
    out.primitives.push_back(primitive_of(mesh.primitives[i], entry["primitives"][i]));
  }
  return out;
}

Node node_of(const tinygltf::Node& node, const json& entry) {
  Node out;
  out.name = node.name;
  out.mesh = index_of(node.mesh);
  out.skinned = node.skin >= 0;
  out.children = indices_of(node.children);
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
      if (ids[i].is_number_unsigned()) out.levels.push_back(ids[i].get<std::size_t>());
    }
  }
  return out;
}

Result<tinygltf::Model> parse(const json& sections) {
  const std::string text = sections.dump();
  tinygltf::Model model;
  tinygltf::TinyGLTF loader;
  std::string error, warning;
  try {
    if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned>(text.size()), "", 0)) {
      return refused("JSON", printable(error.substr(0, error.find('\n')), 200));
    }
  } catch (const std::exception& failure) {
    return refused("JSON", printable(failure.what(), 200));
  }
  return model;
}

}  // namespace

Result<Primitive> read_primitive(const json& entry, const std::string& place) {
  auto primitive = checked_primitive(entry, place);
  if (!primitive.ok()) return primitive.error();
  json sections = {{"asset", {{"version", "2.0"}}}};
  sections["meshes"] = json::array({{{"primitives", json::array({std::move(*primitive)})}}});
  const auto model = parse(sections);
  if (!model.ok()) return model.error();
  return primitive_of(model->meshes[0].primitives[0], entry);
}

Status read_sections(Document& document) {
  const json& file = document.json;
  const auto sections = checked_sections(file);
  if (!sections.ok()) return sections.error();
  const auto model = parse(*sections);
  if (!model.ok()) return model.error();
  for (std::size_t i = 0; i < model->bufferViews.size(); ++i) {
    document.views.push_back(view_of(model->bufferViews[i], file["bufferViews"][i]));
  }
  for (const tinygltf::Accessor& accessor : model->accessors) document.accessors.push_back(accessor_of(accessor));
  for (std::size_t i = 0; i < model->meshes.size(); ++i) {
    document.meshes.push_back(mesh_of(model->meshes[i], file["meshes"][i]));
  }
  for (std::size_t i = 0; i < model->nodes.size(); ++i) {
    document.nodes.push_back(node_of(model->nodes[i], file["nodes"][i]));
  }
  document.scene = index_of(model->defaultScene).value_or(0);
  if (model->scenes.empty()) return success();
  if (document.scene >= model->scenes.size()) {
    return refused("scene", "scene " + std::to_string(document.scene) + " does not exist");
  }
  document.roots = indices_of(model->scenes[document.scene].nodes);
  return success();
}

}  // namespace parsel::gltf
