#include "core/shape/gltf_import.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/base/text.h"
#include "core/gltf/accessor.h"
#include "core/shape/label.h"

namespace parsel {
namespace {

using nlohmann::json;

Error refused(std::string place, std::string cause, std::string fix = "export the model again") {
  return {"shape/gltf_import", std::move(place), std::move(cause), std::move(fix)};
}

/// A node of the scene with its world transform.
struct PlacedNode {
  int node;
  Mat4 world;
};

/// Half-diagonals from the origin to the model's centre. A float has 24 bits: from 10,000 on a step of it is 0.001
/// half-diagonals, a tenth of the distance within which parts touch; nearer nothing is lost that could be seen.
constexpr double far_away = 1e4;

class Importer {
 public:
  Importer(const GltfDocument& document, const ImportLimits& limits) : document_(document), limits_(limits) {}

  Result<ImportedModel> run() {
    note_extensions();
    const Result<std::vector<PlacedNode>> nodes = place_nodes();
    if (!nodes.ok()) return nodes.error();
    for (const PlacedNode& placed : *nodes) {
      if (Status s = read_node(placed); !s.ok()) return s.error();
    }
    if (model_.meshes.empty()) {
      std::string why = "it shows no triangle mesh";
      if (!model_.warnings.empty()) why += ": " + model_.warnings[0].place + ": " + model_.warnings[0].text;
      return refused("file", why, "open a model with triangle meshes, without compression");
    }
    if (Status s = normalise(); !s.ok()) return s.error();
    return std::move(model_);
  }

 private:
  void warn(std::string place, std::string text) { model_.warnings.push_back({std::move(place), std::move(text)}); }

  /// Extensions that the file requires and that could change what the shape is.
  void note_extensions() {
    static const std::set<std::string> harmless = {
        "KHR_mesh_quantization", "KHR_texture_transform", "KHR_texture_basisu", "KHR_lights_punctual",
        "EXT_texture_webp",      "EXT_texture_avif",      "MSFT_texture_dds",   "KHR_node_visibility"};
    static const std::set<std::string> named_elsewhere = {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                          "KHR_meshopt_compression"};
    const auto required = document_.json.find("extensionsRequired");
    if (required == document_.json.end() || !required->is_array()) return;
    for (const json& entry : *required) {
      if (!entry.is_string()) continue;
      const std::string& name = entry.get_ref<const std::string&>();
      if (name.starts_with("KHR_materials_") || harmless.count(name) || named_elsewhere.count(name)) continue;
      warn("extensionsRequired", "the file requires " + printable(name) + ", which is not read");
    }
  }

  Result<Mat4> local_transform(int index) const {
    const tinygltf::Node& node = document_.model.nodes[static_cast<std::size_t>(index)];
    Mat4 local = Mat4::Identity();
    if (node.matrix.size() == 16) {
      local = Eigen::Map<const Mat4>(node.matrix.data());  // column-major, as Eigen's
    } else {
      Eigen::Affine3d transform = Eigen::Affine3d::Identity();
      if (node.translation.size() == 3) transform.translate(Eigen::Map<const Vec3>(node.translation.data()));
      if (node.rotation.size() == 4) {
        const Eigen::Quaterniond q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (!(q.norm() > 1e-6) || !std::isfinite(q.norm())) {
          return refused("node " + std::to_string(index), "its rotation is not a quaternion of length 1");
        }
        transform.rotate(q.normalized());
      }
      if (node.scale.size() == 3) transform.scale(Eigen::Map<const Vec3>(node.scale.data()));
      local = transform.matrix();
    }
    if (!local.allFinite()) return refused("node " + std::to_string(index), "its transform is not finite");
    return local;
  }

  /// KHR_node_visibility: a node that is not visible hides all below it.
  bool is_hidden(int index) const {
    const json& raw = document_.json["nodes"][static_cast<std::size_t>(index)];
    const auto extensions = raw.find("extensions");
    if (extensions == raw.end() || !extensions->is_object()) return false;
    const auto visibility = extensions->find("KHR_node_visibility");
    if (visibility == extensions->end() || !visibility->is_object()) return false;
    const auto visible = visibility->find("visible");
    return visible != visibility->end() && visible->is_boolean() && !visible->get<bool>();
  }

  /// Depth first, without recursion: the depth of the graph is the file's to choose.
  Result<std::vector<PlacedNode>> place_nodes() {
    const auto& nodes = document_.model.nodes;
    const Result<std::vector<int>> roots = scene_roots();
    if (!roots.ok()) return roots.error();
    std::vector<PlacedNode> stack, placed;
    std::vector<bool> seen(nodes.size(), false);
    const auto push = [&](const std::vector<int>& children, const Mat4& parent) -> Status {
      for (auto child = children.rbegin(); child != children.rend(); ++child) {
        if (*child < 0 || static_cast<std::size_t>(*child) >= nodes.size()) {
          return refused("node " + std::to_string(*child), "it does not exist but is referred to");
        }
        if (seen[static_cast<std::size_t>(*child)]) {
          return refused("node " + std::to_string(*child), "it occurs twice in the scene, or contains itself");
        }
        seen[static_cast<std::size_t>(*child)] = true;
        const Result<Mat4> local = local_transform(*child);
        if (!local.ok()) return local.error();
        stack.push_back({*child, parent * *local});
      }
      return success();
    };
    if (Status s = push(*roots, Mat4::Identity()); !s.ok()) return s.error();
    while (!stack.empty()) {
      const PlacedNode next = stack.back();
      stack.pop_back();
      if (is_hidden(next.node)) {
        warn("node " + std::to_string(next.node),
             "it and what is below it are hidden (KHR_node_visibility): they are no parts");
        continue;
      }
      placed.push_back(next);
      if (Status s = push(nodes[static_cast<std::size_t>(next.node)].children, next.world); !s.ok()) return s.error();
    }
    return placed;
  }

  Result<std::vector<int>> scene_roots() const {
    const tinygltf::Model& model = document_.model;
    if (model.scenes.empty()) {
      std::vector<bool> is_child(model.nodes.size(), false);
      for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) {
          if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
            is_child[static_cast<std::size_t>(child)] = true;
        }
      }
      std::vector<int> roots;
      for (std::size_t i = 0; i < is_child.size(); ++i) {
        if (!is_child[i]) roots.push_back(static_cast<int>(i));
      }
      return roots;
    }
    const int scene = std::max(model.defaultScene, 0);
    if (static_cast<std::size_t>(scene) >= model.scenes.size()) {
      return refused("scene", "scene " + std::to_string(scene) + " does not exist");
    }
    return model.scenes[static_cast<std::size_t>(scene)].nodes;
  }

  Status read_node(const PlacedNode& placed) {
    const tinygltf::Node& node = document_.model.nodes[static_cast<std::size_t>(placed.node)];
    const json& raw = document_.json["nodes"][static_cast<std::size_t>(placed.node)];
    const std::string place = "node " + std::to_string(placed.node);
    if (node.mesh < 0) return success();
    if (static_cast<std::size_t>(node.mesh) >= document_.model.meshes.size()) {
      return refused(place, "mesh " + std::to_string(node.mesh) + " does not exist");
    }
    if (node.skin >= 0) warn(place, "its skin is not read: the mesh is taken in its rest pose");
    if (const auto extensions = raw.find("extensions"); extensions != raw.end() && extensions->is_object()) {
      if (extensions->contains("EXT_mesh_gpu_instancing")) {
        warn(place, "EXT_mesh_gpu_instancing is not read: the mesh is taken once");
      }
    }
    if (!placed.world.allFinite()) {
      warn(place, "it was left out: its place in the scene is not finite");
      return success();
    }
    const tinygltf::Mesh& mesh = document_.model.meshes[static_cast<std::size_t>(node.mesh)];
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      if (Status s = read_primitive(placed, node, mesh, static_cast<int>(i)); !s.ok()) return s;
    }
    return success();
  }

  std::string name_of(int node_index, const tinygltf::Node& node, const tinygltf::Mesh& mesh, int material) const {
    const json& raw = document_.json["nodes"][static_cast<std::size_t>(node_index)];
    if (const auto extras = raw.find("extras"); extras != raw.end() && extras->is_object()) {
      const auto label = extras->find("label");
      if (label != extras->end() && label->is_string() && !label->get_ref<const std::string&>().empty()) {
        return label->get_ref<const std::string&>();
      }
    }
    if (!node.name.empty()) return node.name;
    if (!mesh.name.empty()) return mesh.name;
    const auto& materials = document_.model.materials;
    if (material >= 0 && static_cast<std::size_t>(material) < materials.size()) {
      return materials[static_cast<std::size_t>(material)].name;
    }
    return "";
  }

  Status read_primitive(const PlacedNode& placed, const tinygltf::Node& node, const tinygltf::Mesh& mesh, int index) {
    const tinygltf::Primitive& primitive = mesh.primitives[static_cast<std::size_t>(index)];
    const json& raw =
        document_.json["meshes"][static_cast<std::size_t>(node.mesh)]["primitives"][static_cast<std::size_t>(index)];
    std::string place = "node " + std::to_string(placed.node);
    if (mesh.primitives.size() > 1) place += ", primitive " + std::to_string(index);
    const auto leave_out = [&](const std::string& why) {
      warn(place, "it was left out: " + why);
      return success();
    };

    static const char* const modes[] = {"points", "lines", "a line loop", "a line strip"};
    if (primitive.mode >= 0 && primitive.mode < TINYGLTF_MODE_TRIANGLES) {
      return leave_out(std::string("it is made of ") + modes[primitive.mode]);
    }
    if (primitive.mode > TINYGLTF_MODE_TRIANGLE_FAN) return refused(place, "its mode is none of glTF's");
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) return leave_out("it has no POSITION");
    if (is_draco(raw) && !has_plain_data(position->second)) {
      return leave_out("it is compressed with KHR_draco_mesh_compression, which is not read here");
    }
    for (const int accessor : {position->second, primitive.indices}) {
      const std::string why = out_of_reach(document_, accessor);
      if (!why.empty()) return leave_out(why);
    }
    if (raw.contains("targets")) warn(place, "its morph targets are not read: the mesh is taken at rest");

    const std::size_t vertices = accessor_count(document_, position->second);
    const std::size_t corners = primitive.indices >= 0 ? accessor_count(document_, primitive.indices) : vertices;
    const bool is_list = primitive.mode == TINYGLTF_MODE_TRIANGLES;
    const std::size_t triangles = is_list ? corners / 3 : corners < 3 ? 0 : corners - 2;
    if (vertices > limits_.vertices - vertices_ || triangles > limits_.triangles - triangles_ ||
        model_.meshes.size() >= limits_.parts) {
      return refused(place,
                     "the model has more than " + std::to_string(limits_.parts) + " parts, " +
                         std::to_string(limits_.vertices) + " vertices or " + std::to_string(limits_.triangles) +
                         " triangles",
                     "simplify the model or join its small parts");
    }
    vertices_ += vertices;
    triangles_ += triangles;

    Result<std::vector<Vec3>> positions = read_positions(document_, position->second);
    if (!positions.ok()) return positions.error();
    std::vector<std::uint32_t> indices;
    if (primitive.indices >= 0) {
      Result<std::vector<std::uint32_t>> read = read_indices(document_, primitive.indices);
      if (!read.ok()) return read.error();
      indices = std::move(*read);
    } else {
      indices.resize(vertices);
      for (std::size_t i = 0; i < vertices; ++i) indices[i] = static_cast<std::uint32_t>(i);
    }

    PartMesh part;
    part.name = name_of(placed.node, node, mesh, primitive.material);
    part.label = clean_label(part.name);
    part.node = placed.node;
    part.primitive = index;
    part.world = placed.world;
    part.positions = std::move(*positions);
    const Mat3 linear = placed.world.topLeftCorner<3, 3>();
    const Vec3 offset = placed.world.topRightCorner<3, 1>();
    for (Vec3& p : part.positions) {
      p = linear * p + offset;
      if (!p.allFinite()) p.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
    if (Status s = collect_triangles(part, indices, primitive.mode, place); !s.ok()) return s;
    if (part.triangles.empty()) return leave_out("it has no triangle");
    model_.meshes.push_back(std::move(part));
    return success();
  }

  Status collect_triangles(PartMesh& part, const std::vector<std::uint32_t>& indices, int mode,
                           const std::string& place) {
    std::size_t broken = 0;
    for (const std::uint32_t index : indices) {
      if (index >= part.positions.size()) {
        return refused(place, "index " + std::to_string(index) + " is out of range: there are " +
                                  std::to_string(part.positions.size()) + " vertices");
      }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      if (a == b || b == c || c == a) return;
      if (part.positions[a].hasNaN() || part.positions[b].hasNaN() || part.positions[c].hasNaN()) {
        ++broken;
      } else {
        part.triangles.push_back({a, b, c});
      }
    };
    const std::size_t n = indices.size();
    if (mode == TINYGLTF_MODE_TRIANGLES) {
      part.triangles.reserve(n / 3);
      for (std::size_t i = 0; i + 3 <= n; i += 3) add(indices[i], indices[i + 1], indices[i + 2]);
    } else if (n >= 3) {
      part.triangles.reserve(n - 2);
      for (std::size_t i = 0; i + 2 < n; ++i) {
        if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
          add(indices[0], indices[i + 1], indices[i + 2]);
        } else {
          add(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);  // every other one is wound the other way
        }
      }
    }
    if (broken > 0) warn(place, std::to_string(broken) + " triangles were left out: a position is not a finite number");
    return success();
  }

  static bool is_draco(const json& primitive) {
    const auto extensions = primitive.find("extensions");
    return extensions != primitive.end() && extensions->is_object() &&
           extensions->contains("KHR_draco_mesh_compression");
  }

  /// Draco files may carry the mesh uncompressed as well.
  bool has_plain_data(int accessor) const {
    const auto& accessors = document_.model.accessors;
    return accessor >= 0 && static_cast<std::size_t>(accessor) < accessors.size() &&
           accessors[static_cast<std::size_t>(accessor)].bufferView >= 0;
  }

  /// Puts all parts into the normalised frame: the box of what the triangles use is centred, half-diagonal 1.
  Status normalise() {
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (const PartMesh& mesh : model_.meshes) {
      for (const Triangle& triangle : mesh.triangles) {
        for (const std::uint32_t v : triangle) {
          low = low.cwiseMin(mesh.positions[v]);
          high = high.cwiseMax(mesh.positions[v]);
        }
      }
    }
    model_.frame.centre = low / 2 + high / 2;
    model_.frame.scale = (high / 2 - low / 2).norm();
    if (!model_.frame.centre.allFinite() || !(model_.frame.scale > 1e-30) || !(model_.frame.scale < 1e30)) {
      return refused("file", "its size is zero, or too small or too large to compute with",
                     "scale the model to metres");
    }
    if (model_.frame.centre.norm() > far_away * model_.frame.scale) {
      warn("file", "the model lies so far from its origin that single-precision coordinates blur it: move it there");
    }
    if (model_.meshes.size() == 1) {
      warn("file", "the model is one part, so that nothing can follow an edit of it: split it into named parts");
    }
    for (PartMesh& mesh : model_.meshes) {
      for (Vec3& p : mesh.positions) p = model_.frame.to_normalised(p);
    }
    return success();
  }

  const GltfDocument& document_;
  const ImportLimits& limits_;
  ImportedModel model_;
  std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

Result<ImportedModel> import_gltf(std::string_view bytes, const ExternalBuffers& buffers, const ImportLimits& limits) {
  const Result<GltfDocument> document = read_gltf_document(bytes, buffers, limits);
  if (!document.ok()) return document.error();
  return Importer(*document, limits).run();
}

}  // namespace parsel
